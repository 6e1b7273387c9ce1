# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The function object morphMetric. Sources of truth: the optimal metric of a
quadratic in closed form, the integral that the complexity is, one rank."""

import re

import numpy as np
import pytest

from boxCase import box

FLAT = {
    "xMin": "patch",
    "xMax": "patch",
    "yMin": "patch",
    "yMax": "patch",
    "sides": ("empty", "zMin zMax"),
}
CUBE = {
    side: "patch" for side in ("xMin", "xMax", "yMin", "yMax", "zMin", "zMax")
}
SCHEMES = """
ddtSchemes { default none; }
gradSchemes { default none; }
divSchemes { default none; }
laplacianSchemes { default none; }
interpolationSchemes { default none; }
snGradSchemes { default none; }
"""


def centres(cells):
    """Of a unit box, as blockMesh counts them."""
    x, y, z = ((np.arange(n) + 0.5) / n for n in cells)
    z, y, x = np.meshgrid(z, y, x, indexing="ij")
    return np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)


def metric_case(path, cells, values, entries, patches=FLAT):
    case = box(path, patches, cells=cells)
    case.write("system/fvSchemes", "dictionary", SCHEMES)
    case.write("system/fvSolution", "dictionary", "")
    boundary = " ".join(
        f"{name} {{ type {'empty' if name == 'sides' else 'zeroGradient'}; }}"
        for name in patches
    )
    numbers = " ".join(f"{v!r}" for v in np.asarray(values, float).tolist())
    case.write(
        "0/f",
        "volScalarField",
        "dimensions [0 0 0 0 0 0 0];\n"
        f"internalField nonuniform List<scalar> {len(values)} ({numbers});\n"
        f"boundaryField {{ {boundary} }}",
    )
    case.write(
        "system/metric",
        "dictionary",
        f"type morphMetric; libs (morphMotionSolvers); {entries}",
    )
    return case


def run(case, status=0, ranks=1):
    return case.run(
        "postProcess",
        "-func",
        "metric",
        "-fields",
        "(f)",
        ranks=ranks,
        status=status,
    )


def metrics(case, name="metric"):
    """n x 3 x 3"""
    text = (case.path / "0" / name).read_text()
    if uniform := re.search(r"internalField\s+uniform \((.*?)\)", text):
        rows = np.array([uniform[1].split()], float)
        return rows[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)
    body = re.search(
        r"internalField\s+nonuniform List<symmTensor>\s*\d+\s*\((.*?)\n\)",
        text,
        re.DOTALL,
    )[1]
    rows = np.array(
        body.replace("(", " ").replace(")", " ").split(), float
    ).reshape(-1, 6)
    return rows[:, [0, 1, 2, 1, 3, 4, 2, 4, 5]].reshape(-1, 3, 3)


def interior(x, cells):
    """Cells whose Hessian no patch has to do with."""
    i = np.rint(x * cells - 0.5)
    inside = (i > 2) & (i < np.array(cells) - 3)
    return inside[:, 0] & inside[:, 1]


def complexity(m, d):
    return np.sqrt(np.linalg.det(m[:, :d, :d])).mean()


@pytest.mark.parametrize("norm", [1, 2])
def test_a_quadratic_wants_cells_of_one_shape(tmp_path, norm):
    """hx : hy = sqrt(|f_yy|/|f_xx|) whatever the norm."""
    cells = (30, 30, 1)
    x = centres(cells)
    f = 9 * x[:, 0] ** 2 - x[:, 1] ** 2
    case = metric_case(
        tmp_path,
        cells,
        f,
        f"field f; cells 400; norm {norm}; gradation none;",
    )
    output = run(case)
    m = metrics(case)
    inside = interior(x, cells)
    assert inside.sum() == 24 * 24
    ratio = np.sqrt(m[inside, 0, 0] / m[inside, 1, 1])
    np.testing.assert_allclose(ratio, 3, rtol=1e-10)
    assert np.abs(m[inside, 0, 1]).max() < 1e-8 * m[inside, 0, 0].max()
    assert abs(complexity(m, 2) / 400 - 1) < 0.0101
    told = float(re.search(r"complexity (\S+),", output)[1])
    assert abs(told / complexity(m, 2) - 1) < 1e-2
    np.testing.assert_allclose(m[:, 2, 2], 1, rtol=1e-12)

    # What ParaView draws as ellipsoids is its inverse root
    h = metrics(case, "metricSize")
    np.testing.assert_allclose(
        np.einsum("nij,njk,nkl->nil", h, m, h)[inside],
        np.broadcast_to(np.eye(3), (inside.sum(), 3, 3)),
        atol=1e-5,
    )


def shear_layer(x):
    return np.tanh(20 * (x[:, 0] - 0.5 + 0.1 * (x[:, 1] - 0.5)))


def test_sizes_are_bounded_and_grow_by_the_gradation(tmp_path):
    cells = (40, 40, 1)
    x = centres(cells)
    case = metric_case(
        tmp_path,
        cells,
        shear_layer(x),
        "field f; cells 600; hMin 0.01; hMax 0.2; gradation 1.3;",
    )
    run(case)
    m = metrics(case)[:, :2, :2]
    sizes = 1 / np.sqrt(np.linalg.eigvalsh(m))
    assert sizes.min() > 0.01 * (1 - 1e-5)
    assert sizes.max() < 0.2 * (1 + 1e-5)
    assert sizes.max() / sizes.min() > 3
    assert abs(complexity(m, 2) / 600 - 1) < 0.0101

    # Along the axes, between neighbours
    for axis, step in ((0, 1), (1, 40)):
        h = 1 / np.sqrt(m[:, axis, axis])
        here = np.flatnonzero(np.rint(x[:, axis] * 40 - 0.5) < 39)
        a, b = h[here], h[here + step]
        grown = np.minimum(a, b) + np.log(1.3) / 40
        assert (np.maximum(a, b) <= grown * (1 + 1e-4)).all()


def test_fields_are_intersected(tmp_path):
    cells = (30, 30, 1)
    x = centres(cells)
    results = {}
    for name, entry in (
        ("one", "field f;"),
        ("twice", "fields (f f);"),
    ):
        case = metric_case(
            tmp_path / name,
            cells,
            shear_layer(x),
            entry + "cells 500; hMax 0.3; gradation none;",
        )
        run(case)
        results[name] = metrics(case)
    np.testing.assert_allclose(
        results["one"], results["twice"], rtol=1e-6, atol=1e-3
    )


def test_ranks_do_not_matter(tmp_path):
    cells = (16, 12, 6)
    x = centres(cells)
    results = []
    for ranks, split in ((1, None), (3, (3, 1, 1))):
        case = metric_case(
            tmp_path / str(ranks),
            cells,
            shear_layer(x) + x[:, 2] ** 2,
            "field f; cells 800; hMin 0.01; hMax 0.5;",
            patches=CUBE,
        )
        if split:
            case.decompose(split)
        run(case, ranks=ranks)
        if split:
            case.run("reconstructPar", "-withZero", "-fields", "(metric)")
        results.append(metrics(case))
    np.testing.assert_allclose(*results, rtol=1e-6, atol=1e-4)
    assert abs(complexity(results[0], 3) / 800 - 1) < 0.0101


def test_a_uniform_field_wants_cells_as_large_as_they_may_be(tmp_path):
    cells = (8, 8, 1)
    case = metric_case(
        tmp_path, cells, np.ones(64), "field f; cells 100; hMax 0.5;"
    )
    output = run(case)
    m = metrics(case)
    # As many as are asked for, of one size
    np.testing.assert_allclose(m[:, 0, 0], 100, rtol=0.02)
    assert "FOAM Warning" not in output.replace("keyword", "")


@pytest.mark.parametrize(
    "entries, said",
    [
        ("cells 100;", "Neither entry 'field' and 'fields'"),
        ("field f; cells -1;", "Entry 'cells' is -1"),
        ("field f; norm 0.5;", "Entry 'norm' is 0.5"),
        ("field f; hMin 2; hMax 1;", "Entry 'hMin', 2 m, is larger"),
        ("field f; gradation 0.9;", "neither none nor a number above 1"),
    ],
)
def test_wrong_entries_are_errors(tmp_path, entries, said):
    cells = (4, 4, 1)
    case = metric_case(tmp_path, cells, np.ones(16), entries)
    assert said in run(case, status=1)


def test_a_field_that_is_not_there_is_named(tmp_path):
    """postProcess goes on after it, as after every error of a function."""
    case = metric_case(tmp_path, (4, 4, 1), np.ones(16), "field g;")
    output = run(case)
    assert "There is no volume field of scalars or vectors 'g'" in output
    assert not (case.path / "0/metric").exists()


def test_bounds_that_do_not_allow_so_many_cells(tmp_path):
    cells = (20, 20, 1)
    case = metric_case(
        tmp_path,
        cells,
        shear_layer(centres(cells)),
        "field f; cells 1e6; hMin 0.1;",
    )
    output = run(case)
    assert "hMin, hMax or gradation do not allow it" in output
