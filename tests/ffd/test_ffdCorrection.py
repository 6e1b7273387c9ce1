# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Numbers of a surface that free-form deformation keeps: the entry keep.

Sources of truth: the least correction of control points under linear
constraints, delta = F A^T (A F A^T)^-1 r (Sieger, Menzel, Botsch 2014, as
PyGeM's CFFD and BFFD have it for functions of one coordinate), made here from
Bernstein polynomials; PyGeM's VFFD, which keeps a volume by x, y and z in turn,
for the size of the correction; closed forms; central differences.
"""

import numpy as np
import pytest

from ffdCase import bernstein, ffd_box, ffd_case, move, parameter, reference
from rbfCase import groups, rbf_case
from surfaceCase import cube_surface, morphed, table

ORDER = 2
LOW, SPAN = -0.1, 1.2
MOVES = {
    "a": [((1, 1, 1), (0.4, 0.3, 0.5)), ((2, 1, 2), (0.1, 0.2, 0.3))],
    "b": [((0, 1, 2), (0.3, -0.2, 0.6))],
}
VALUES = {"a": 0.2, "b": -0.1}


def box(values=None, extra=""):
    values = values or VALUES
    return ffd_box(
        "box",
        "".join(parameter(n, MOVES[n], repr(values[n])) for n in MOVES),
        extra=extra,
    )


def basis(points):
    """Values of the 27 polynomials at points, first index fastest."""
    xi = (points - LOW) / SPAN
    one = [
        [bernstein(ORDER, i, xi[:, d]) for i in range(ORDER + 1)]
        for d in range(3)
    ]
    return np.stack(
        [
            one[0][i] * one[1][j] * one[2][k]
            for k in range(3)
            for j in range(3)
            for i in range(3)
        ],
        axis=1,
    )


def told(values=None):
    """Displacements of the control points by the parameters [m]."""
    values = values or VALUES
    control = np.zeros((27, 3))
    for name, moves in MOVES.items():
        for (i, j, k), v in moves:
            control[i + 3 * (j + 3 * k)] += values[name] * SPAN * np.array(v)
    return control


def volume(points, faces):
    x = points[np.array(faces)]
    return np.einsum("ij,ij->", x[:, 0], np.cross(x[:, 1], x[:, 2])) / 6


def volume_gradient(points, faces):
    g = np.zeros_like(points)
    for f in faces:
        a, b, c = points[f]
        g[f[0]] += np.cross(b, c) / 6
        g[f[1]] += np.cross(c, a) / 6
        g[f[2]] += np.cross(a, b) / 6
    return g


def test_a_mean_is_that_of_the_least_correction(tmp_path):
    """PyGeM's BFFD: each component of the mean of the points by itself."""
    points, faces = cube_surface()
    value = (0.53, 0.48, 0.55)
    moved = morphed(
        tmp_path,
        points,
        faces,
        box(),
        f"keep {{ middle {{ type mean; value {'(%r %r %r)' % value}; }} }}",
    )
    B, control = basis(points), told()
    A = B.mean(axis=0)
    open_ = np.array(value) - (points + B @ control).mean(axis=0)
    expected = points + B @ (control + np.outer(A, open_) / (A @ A))
    np.testing.assert_allclose(moved, expected, rtol=0, atol=1e-13)
    np.testing.assert_allclose(moved.mean(axis=0), value, atol=1e-14)


@pytest.mark.parametrize("masked", [False, True])
def test_linear_functions_are_those_of_the_least_correction(tmp_path, masked):
    """PyGeM's CFFD, with its mask, here also with weights."""
    points, faces = cube_surface()
    rng = np.random.default_rng(3)
    chosen = [rng.choice(len(points), 4, replace=False) for _ in range(2)]
    factors = rng.uniform(-1, 1, (2, 4))
    before = points + basis(points) @ told()
    targets = [
        float(factors[n] @ before[chosen[n], 2]) + change
        for n, change in enumerate((0.02, -0.01))
    ]
    entries = "".join(
        f"f{n} {{ type linear; value {targets[n]!r}; points ("
        + " ".join(
            "(%r %r %r)" % tuple(map(float, points[i])) for i in chosen[n]
        )
        + ") coefficients ("
        + " ".join(f"(0 0 {float(c)!r})" for c in factors[n])
        + "); }"
        for n in range(2)
    ).replace(") coefficients", "); coefficients")
    freedom = np.ones(27)
    free = ""
    if masked:
        freedom = np.zeros(27)
        places = [(1, 0, 1), (2, 2, 2), (1, 1, 2), (0, 2, 1)]
        for n, (i, j, k) in enumerate(places):
            freedom[i + 3 * (j + 3 * k)] = 1 + n
        free = (
            "free ("
            + " ".join(
                f"(({i} {j} {k}) (1 1 {1 + n}))"
                for n, (i, j, k) in enumerate(places)
            )
            + ");"
        )
    moved = morphed(
        tmp_path, points, faces, box(), f"keep {{ {free} {entries} }}"
    )
    B, control = basis(points), told()
    A = np.stack([factors[n] @ B[chosen[n]] for n in range(2)])
    open_ = np.array(
        [
            targets[n] - factors[n] @ (points + B @ control)[chosen[n], 2]
            for n in range(2)
        ]
    )
    FA = freedom[:, None] * A.T
    control[:, 2] += FA @ np.linalg.solve(A @ FA, open_)
    np.testing.assert_allclose(moved, points + B @ control, rtol=0, atol=1e-12)


def by_turns(points, faces, B, control, target):
    """PyGeM's VFFD: x, y and z in turn, each a third of what is missing."""
    control = control.copy()
    missing = target - volume(points + B @ control, faces)
    for d in range(3):
        g = B.T @ volume_gradient(points + B @ control, faces)[:, d]
        control[:, d] += g * missing / 3 / (g @ g)
    return control


@pytest.mark.parametrize("value", [None, 1.3])
def test_a_volume_stays(tmp_path, value):
    """To round-off, by a correction as small as that of PyGeM's VFFD."""
    points, faces = cube_surface()
    entry = "" if value is None else f"value {value};"
    moved = morphed(
        tmp_path,
        points,
        faces,
        box(),
        f"keep {{ tank {{ type volume; {entry} }} }}",
    )
    target = value or 1
    assert volume(moved, faces) == pytest.approx(target, abs=1e-13)
    B, control = basis(points), told()
    assert abs(volume(points + B @ control, faces) - target) > 1e-3
    others = by_turns(points, faces, B, control, target)
    assert volume(points + B @ others, faces) == pytest.approx(
        target, abs=1e-12
    )
    size = np.linalg.norm(moved - (points + B @ control))
    assert 0 < size <= 1.1 * np.linalg.norm(B @ (others - control))


KEEP = (
    "keep { tank { type volume; } middle { type barycentre; direction (1 0 0);"
    " value 0.5; } }"
)


def test_derivatives_are_those_of_what_is_kept(tmp_path):
    """Of kept numbers none; of others central differences of the program's own
    values."""
    points, faces = cube_surface()

    def evaluated(name, values):
        morphed(
            tmp_path / name,
            points,
            faces,
            box(values),
            KEEP
            + "constraints { tank { type volume; } middle { type barycentre; }"
            " skin { type wettedArea; } bend { type curvature; } }",
            ["-constraints"],
        )
        return (
            table(tmp_path / name / "out.constraints.dat"),
            table(tmp_path / name / "out.constraintDerivatives.dat"),
        )

    values, slopes = evaluated("at", VALUES)
    assert float(values["tank"][0]) == pytest.approx(1, abs=1e-13)
    assert float(
        values["middlex"][0] if "middlex" in values else values["middle.x"][0]
    ) == pytest.approx(0.5, abs=1e-13)
    h = 1e-5
    for column, name in enumerate(MOVES):
        up, _ = evaluated("up", {**VALUES, name: VALUES[name] + h})
        down, _ = evaluated("down", {**VALUES, name: VALUES[name] - h})
        for number in slopes:
            exact = float(slopes[number][column])
            difference = (float(up[number][0]) - float(down[number][0])) / (
                2 * h
            )
            assert exact == pytest.approx(difference, rel=1e-8, abs=2e-9)
        assert float(slopes["tank"][column]) == pytest.approx(0, abs=1e-13)
        assert abs(float(slopes["skin"][column])) > 1e-3


def boundary_volume(case, points):
    """Of the whole boundary of a box of cells, by its faces."""
    import re

    text = (case.path / "constant/polyMesh/faces").read_text()
    faces = [
        [int(i) for i in f.split()] for f in re.findall(r"4\(([^)]*)\)", text)
    ]
    owner_text = (case.path / "constant/polyMesh/neighbour").read_text()
    n = int(re.search(r"\n(\d+)\s*\n\(", owner_text).group(1))
    triangles = [
        t for f in faces[n:] for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))
    ]
    return volume(points, triangles)


def test_meshes_keep_them_on_any_number_of_ranks(tmp_path):
    keep = 'keep { patches (".*"); tank { type volume; } }'
    one = None
    for ranks in (1, 3):
        case = ffd_case(tmp_path / str(ranks), box(), keep, cells=(4, 3, 3))
        if ranks > 1:
            case.decompose((1, 1, ranks))
        points = move(case, ranks=ranks)
        assert (
            boundary_volume(case, points) == pytest.approx(1, abs=1e-13)
            if ranks == 1
            else True
        )
        if one is None:
            one = points
            assert np.abs(points - reference(case)).max() > 0.02
        np.testing.assert_array_equal(points, one)


def test_bodies_that_radial_basis_functions_carry_keep_them(tmp_path):
    case = rbf_case(
        tmp_path,
        coeffs=groups(
            body='type moving; patches (".*"); displacement { type ffd; boxes {'
            + box()
            + '} keep { patches (".*"); tank { type volume; } } }'
        )
        + "supportRadius 2; selection all;",
        cells=(4, 3, 3),
    )
    case.run("morphMesh", "-time", "1", "-derivatives", '(".*")')
    folder = tmp_path / "postProcessing/morphMesh/1"
    after = (folder / "measures.dat").read_text().splitlines()[2].split()
    assert float(after[2]) == pytest.approx(1, abs=1e-13)
    for row in (folder / "derivatives.dat").read_text().splitlines()[1:]:
        assert float(row.split()[3]) == pytest.approx(0, abs=1e-12)
        assert abs(float(row.split()[2])) > 1e-3


@pytest.mark.parametrize(
    "keep, message",
    [
        ("skin { type wettedArea; value -1; }", "cannot be met: as near"),
        ("tank { type volume; value -1; }", "that 'keep' moves further"),
        ("tank { type volume; min 1; }", "A number to keep has a 'value'"),
        ("middle { type mean; value (1 2); }", "lists 2 numbers, but"),
        ("", "There is nothing to keep"),
        ("tank 1;", "has to be the"),
        (
            "free (((1 1 1) (0 0 1))); m { type mean; direction (1 0 0); }",
            "no free control point of box 'box' changes 'm'",
        ),
        (
            "m { type mean; direction (0 0 1); } n { type mean;"
            " direction (0 0 1); }",
            "apart from each other",
        ),
        (
            "free (((1 1 9) (0 0 1))); tank { type volume; }",
            "there is no point (1 1 9)",
        ),
    ],
)
def test_what_cannot_be_kept_says_so(tmp_path, keep, message):
    points, faces = cube_surface()
    log = morphed(
        tmp_path, points, faces, box(), f"keep {{ {keep} }}", status=1
    )
    assert message in log
    if "cannot be met" in message:
        assert "in place of -1, off by" in log


def test_several_boxes_keep_nothing(tmp_path):
    points, faces = cube_surface()
    log = morphed(
        tmp_path,
        points,
        faces,
        box() + box().replace("box", "other", 1),
        "keep { tank { type volume; } }",
        status=1,
    )
    assert "Entry 'keep' is for one box with a lattice" in log
