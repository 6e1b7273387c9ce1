# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Where designs are put. Sources of truth: the definitions of the methods
(python/morphfoam/study/sampling.py names them), scipy's own sequences."""

import itertools

import numpy as np
import pytest
from scipy.stats import qmc

from study_case import make_study, read

from morphfoam.study import case_folder, designs, sample, sampling
from morphfoam.study.errors import StudyError

CUBE = """
template: case
parametersFile: parameters
parameters:
  h: {bounds: [0.045, 0.3], baseline: 0.15}
  e: {bounds: [0.09, 1.26], baseline: 0.61}
  E: {bounds: [0.081, 1.44], baseline: 0.87}
constraints: []
sampling: {method: latinHypercube, designs: 30, seed: 3}
strategies:
  morph: {start: template, steps: {solve: cat parameters}}
responses:
  h1: {file: log.solve, regex: '^h +(\\S+);'}
"""
# Those of the rib in Mastrippolito et al. 2019, (36) and (37), on 2H
RIB = ("constraints: []", "constraints: [E >= 0.9*e, E <= 0.9*e + 0.35]")


def study(tmp_path, *changes):
    return read(make_study(tmp_path, *changes, text=CUBE))


def unit(study, points):
    return (points - study.lows) / (study.highs - study.lows)


def sampled(study, existing=()):
    return sampling.sample(study, np.reshape(existing, (-1, 3)))


def strata(study, points):
    """How many designs are in each stratum of each parameter."""
    n = len(points)
    return [
        np.bincount((unit(study, points)[:, j] * n).astype(int), minlength=n)
        for j in range(3)
    ]


def test_latin_hypercube_has_one_design_in_each_stratum(tmp_path):
    one = study(tmp_path)
    for counts in strata(one, sampled(one)):
        assert (counts == 1).all()


def test_latin_hypercube_is_farther_apart_than_random_ones(tmp_path):
    one = study(tmp_path)
    random = [
        sampling.smallest_distance(
            one,
            one.lows
            + qmc.LatinHypercube(3, seed=s).random(30)
            * (one.highs - one.lows),
        )
        for s in range(100)
    ]
    assert sampling.smallest_distance(one, sampled(one)) > 1.3 * max(random)


def test_latin_hypercube_under_constraints_fills_the_feasible_strata(tmp_path):
    one = study(tmp_path, RIB)
    points = sampled(one)
    assert len(points) == 30 and one.feasible(points).all()
    # Strata of equal share of the feasible set, found here from other points
    random = np.random.default_rng(99)
    probes = one.lows + random.random((200000, 3)) * (one.highs - one.lows)
    probes = probes[one.feasible(probes)]
    for j in range(3):
        share = np.searchsorted(np.sort(probes[:, j]), points[:, j]) / len(
            probes
        )
        # A stratum is 1/30 wide; its edges are known to some 0.004
        assert np.abs(np.sort(share) - (np.arange(30) + 0.5) / 30).max() < (
            0.5 / 30 + 0.01
        )


@pytest.mark.parametrize("method", ["latinHypercube", "sobol"])
@pytest.mark.parametrize("constraint", [(), (RIB,)])
def test_more_designs_leave_those_there_are_where_they_are(
    tmp_path, method, constraint
):
    few = study(
        tmp_path,
        *constraint,
        ("latinHypercube", method),
        ("designs: 30", "designs: 10"),
    )
    sample.sample(few)
    before = designs.path(few).read_text()
    more = study(tmp_path, *constraint, ("latinHypercube", method))
    sample.sample(more)
    table = designs.read(more)
    assert designs.path(few).read_text().startswith(before)
    assert [d.number for d in table] == list(range(1, 31))
    points = designs.points(more, table)
    assert more.feasible(points).all()
    assert sampling.smallest_distance(more, points) > 0.02
    if method == "latinHypercube" and not constraint:
        # The first ten may share strata of the thirty; the others fill up
        assert max(counts.max() for counts in strata(more, points)) <= 2
        assert min((counts > 0).sum() for counts in strata(more, points)) >= 28


def test_sampling_again_adds_nothing(tmp_path):
    one = study(tmp_path, ("designs: 30", "designs: 6"))
    sample.sample(one)
    before = designs.path(one).read_text()
    sample.sample(one)
    assert designs.path(one).read_text() == before


def test_the_seed_alone_decides(tmp_path):
    few = ("designs: 30", "designs: 8")
    first, again = (sampled(study(tmp_path, few)) for _ in range(2))
    other = sampled(study(tmp_path, few, ("seed: 3", "seed: 4")))
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


def test_sobol_is_the_sequence_without_what_is_infeasible(tmp_path):
    one = study(tmp_path, RIB, ("latinHypercube", "sobol"))
    sequence = one.lows + qmc.Sobol(3, seed=3).random(256) * (
        one.highs - one.lows
    )
    np.testing.assert_array_equal(
        sampled(one), sequence[one.feasible(sequence)][:30]
    )


def test_factorial_is_the_grid_without_what_is_infeasible(tmp_path):
    one = study(
        tmp_path,
        RIB,
        (
            "latinHypercube, designs: 30, seed: 3",
            "factorial, levels: {h: 1, e: 4, E: 3}",
        ),
    )
    grid = [
        (0.1725, e, E)
        for e, E in itertools.product(
            np.linspace(0.09, 1.26, 4), np.linspace(0.081, 1.44, 3)
        )
        if 0.9 * e <= E + 1e-12 and E <= 0.9 * e + 0.35
    ]
    # e = 0.09, E = 0.081 lies on the constraint, but for rounding
    assert (0.1725, 0.09, 0.081) in grid
    np.testing.assert_allclose(sampled(one), grid)


def test_finer_levels_add_to_a_grid(tmp_path):
    coarse = study(
        tmp_path,
        ("latinHypercube, designs: 30, seed: 3", "factorial, levels: 2"),
    )
    fine = study(
        tmp_path,
        ("latinHypercube, designs: 30, seed: 3", "factorial, levels: 3"),
    )
    assert len(sampled(fine, sampled(coarse))) == 27 - 8


def test_a_grid_that_misses_the_feasible_set_is_an_error(tmp_path):
    one = study(
        tmp_path,
        ("constraints: []", "constraints: [0.1 < h < 0.12]"),
        ("latinHypercube, designs: 30, seed: 3", "factorial, levels: 2"),
    )
    with pytest.raises(StudyError, match="no point of the grid"):
        sampled(one)


def test_verifications_are_no_part_of_the_sampling(tmp_path):
    one = study(tmp_path, ("designs: 30", "designs: 4"))
    sample.sample(one)
    designs.add(one, [one.lows], designs.VERIFICATION)
    sample.sample(study(tmp_path, ("designs: 30", "designs: 6")))
    assert [d.origin for d in designs.read(one)] == [
        *["sample"] * 4,
        "verification",
        *["sample"] * 2,
    ]


def test_designs_of_other_parameters_are_not_taken(tmp_path):
    sample.sample(study(tmp_path, ("designs: 30", "designs: 4")))
    with pytest.raises(StudyError, match="Use another folder"):
        designs.read(study(tmp_path, ("  h: {", "  k: {")))


def test_designs_of_ones_own_come_from_a_table(tmp_path):
    (tmp_path / "own.csv").write_text("y,note,x\n0.25,first,0.5\n1,,0\n")
    study = read(
        make_study(
            tmp_path,
            (
                "{method: latinHypercube, designs: 4}",
                "{method: table, file: own.csv}",
            ),
        )
    )
    points = sampling.sample(study, [])
    assert points.tolist() == [[0.5, 0.25], [0, 1]]
    assert len(sampling.sample(study, points)) == 0


@pytest.mark.parametrize(
    "text, said",
    [
        (None, "cannot be read"),
        ("x\n1\n", "a column of numbers for each of x y"),
        ("x,y\n1,a\n", "a column of numbers for each of x y"),
        ("x,y\n0.5,0.5\n1,1\n", "row 2 .* breaks x <= 0.9"),
    ],
)
def test_a_table_that_will_not_do_is_named(tmp_path, text, said):
    if text:
        (tmp_path / "own.csv").write_text(text)
    study = read(
        make_study(
            tmp_path,
            (
                "sampling: {method: latinHypercube, designs: 4}",
                "constraints: [x <= 0.9]\nsampling: {method: table, file: own.csv}",
            ),
        )
    )
    with pytest.raises(StudyError, match=said):
        sampling.sample(study, [])


WHOLE = (
    "e: {bounds: [0.09, 1.26], baseline: 0.61}",
    "e: {bounds: [1, 5], step: 1, baseline: 3}",
)
SOME = (
    "E: {bounds: [0.081, 1.44], baseline: 0.87}",
    "E: {values: [1.44, 0.2, 0.87], baseline: 0.87}",
)


@pytest.mark.parametrize("method", ["latinHypercube", "sobol"])
def test_parameters_with_certain_values_have_no_others(tmp_path, method):
    """Each as often as the others, to one, in a Latin hypercube."""
    one = study(tmp_path, WHOLE, SOME, ("latinHypercube", method))
    points = sampled(one)
    assert len(np.unique(points, axis=0)) == 30
    for column, values in ((1, [1, 2, 3, 4, 5]), (2, [0.2, 0.87, 1.44])):
        found, counts = np.unique(points[:, column], return_counts=True)
        assert found.tolist() == values
        if method == "latinHypercube":
            assert np.ptp(counts) <= 1
    assert len(np.unique(points[:, 0])) == 30
    more = study(
        tmp_path,
        WHOLE,
        SOME,
        ("designs: 30", "designs: 45"),
        ("latinHypercube", method),
    )
    added = sampled(more, points)
    assert len(added) == 15
    assert np.isin(added[:, 1], [1, 2, 3, 4, 5]).all()


def test_designs_of_certain_values_alone_are_all_different(tmp_path):
    all_of_them = [
        (
            "h: {bounds: [0.045, 0.3], baseline: 0.15}",
            "h: {values: [1, 2], baseline: 1}",
        ),
        WHOLE,
        SOME,
        ("constraints: []", "constraints: [e <= 4]"),
    ]
    one = study(tmp_path, *all_of_them, ("designs: 30", "designs: 24"))
    points = sampled(one)
    assert len(np.unique(points, axis=0)) == 24
    assert one.feasible(points).all()
    with pytest.raises(StudyError, match="make 24 designs"):
        sampled(study(tmp_path, *all_of_them, ("designs: 30", "designs: 25")))
    grid = study(
        tmp_path,
        *all_of_them,
        (
            "{method: latinHypercube, designs: 30, seed: 3}",
            "{method: factorial, levels: 9}",
        ),
    )
    assert len(np.unique(sampled(grid), axis=0)) == 24


@pytest.mark.parametrize(
    "range_, said",
    [
        ("values: [1], baseline: 1", "two numbers or more"),
        ("values: [1, 2], bounds: [1, 2], baseline: 1", "values and bounds"),
        ("values: [1, 2], baseline: 1.5", "none of the values 1 2"),
        ("bounds: [0, 1], step: 0.3, baseline: 0", "must divide the bounds"),
        ("bounds: [0, 1], step: 0, baseline: 0", "must divide the bounds"),
        ("bounds: [0, 1], step: 0.5, baseline: 0.4", "none of the values"),
    ],
)
def test_values_that_will_not_do_are_errors(tmp_path, range_, said):
    with pytest.raises(StudyError, match=said):
        study(tmp_path, ("bounds: [0.045, 0.3], baseline: 0.15", range_))


def test_whole_numbers_are_written_without_a_point(tmp_path):
    one = study(tmp_path, WHOLE, SOME)
    case_folder.write_parameters(one, tmp_path, {"h": 0.1, "e": 4.0, "E": 0.2})
    words = (tmp_path / "parameters").read_text().split()
    assert words[words.index("e") + 1] == "4;"
    assert words[words.index("E") + 1] == "0.2;"


def test_a_descent_leaves_them_at_the_baseline(tmp_path):
    head = "responses:"
    descend = "descend: {objective: {h1: minimise}%s}\nresponses:"
    one = study(tmp_path, WHOLE, (head, descend % ""))
    assert one.descend.parameters == ["h", "E"]
    with pytest.raises(StudyError, match="e has certain values only"):
        study(tmp_path, WHOLE, (head, descend % ", parameters: [h, e]"))
