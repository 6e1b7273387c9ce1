# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pages per design, and a report that follows a sweep.

Source of truth: the study's README.
"""

from test_study_optimum import computed, write

from morphfoam.study import (
    design_page,
    designs,
    fit,
    outcomes,
    report,
    sweep,
)


def test_each_design_has_a_page_with_how_it_converged(tmp_path):
    """A log of OpenFOAM's form: residuals fall by ten in each iteration."""
    study = computed(tmp_path, "objectives: {f: minimise}")
    outcome = outcomes.read(study, "morph", 2)
    case = outcomes.case(study, "morph", 2)
    case.mkdir(parents=True)
    (case / "log.solve").write_text(
        "".join(
            f"Time = {i}\n"
            f"PCG:  Solving for p, Initial residual = {10.0**-i}, Final\n"
            f"PCG:  Solving for p, Initial residual = 0.5, Final\n"
            f"f = {1 + 0.1**i}\n"
            for i in range(1, 6)
        )
    )
    found = design_page.residuals(study, "solve", case / "log.solve")
    assert found == {"p": [(i, 10.0**-i) for i in range(1, 6)]}
    assert design_page.histories(study, case) == {
        "f": [(i, 1 + 0.1**i) for i in range(1, 6)]
    }
    report.report(study)
    page = study.folder / "pages/morph/0002.html"
    text = page.read_text()
    assert "Convergence" in text and "0.875" not in text
    for link in ('href="../../report.html"', 'src="0002.png"'):
        assert link in text
    assert (page.parent / "0002.png").read_bytes()[:4] == b"\x89PNG"
    whole = (study.folder / "report.html").read_text()
    assert '<a href="pages/morph/0002.html">0002</a>' in whole
    # Only what is new is made again
    made = page.stat().st_mtime_ns
    report.report(study)
    assert page.stat().st_mtime_ns == made
    outcomes.write(study, outcome)
    report.report(study)
    assert page.stat().st_mtime_ns > made


def test_a_report_that_is_watched_reloads_itself_until_the_sweep_ends(
    tmp_path, monkeypatch
):
    """As if another process swept: the lock is held, a design finishes, the
    lock is free."""
    study = computed(tmp_path, "objectives: {f: minimise}")
    seen = []

    def wait(seconds):
        page = (study.folder / "report.html").read_text()
        seen.append(page)
        if len(seen) == 2:
            (added,) = designs.add(study, [(0.1, 0.2)], designs.VERIFICATION)
            write(study, "morph", added, 1, {"f": 0.21, "g": 0.98})
        if len(seen) == 4:
            held.__exit__(None, None, None)

    monkeypatch.setattr(report.time, "sleep", wait)
    held = sweep.only_one(study)
    held.__enter__()
    report.report(study, watch=True)
    assert all('http-equiv="refresh"' in page for page in seen)
    assert "25 of 25 designs" in seen[0] and "26 of 26 designs" in seen[3]
    assert "refresh" not in (study.folder / "report.html").read_text()


def test_watching_where_nothing_is_at_work_says_so(tmp_path, capsys):
    study = computed(tmp_path, "objectives: {f: minimise}")
    report.report(study, watch=True)
    assert "No sweep is at work" in capsys.readouterr().out


def test_the_report_says_how_many_designs_succeed(tmp_path):
    """25 designs on a grid, and one that failed far from the others."""
    study = computed(tmp_path, "objectives: {f: minimise}")
    (added,) = designs.add(study, [(1.0, 0.9)], designs.SAMPLED)
    write(study, "morph", added, 1, {}, "solve: diverged")
    fit.fit(study, "morph")
    report.report(study)
    page = (study.folder / "report.html").read_text()
    assert "25 of 26 designs succeeded" in page
