# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb report: one HTML page with what there is so far, pictures within,
and a page for each design."""

import contextlib
import csv
import fcntl
import html
import statistics
import tempfile
import time
from pathlib import Path

from . import design_page, designs, failures, outcomes, plots, results
from .page import document, image, table, text

# [s] between two reports of a sweep that is watched, and so many times what one
# takes
PAUSE, SHARE = 10, 20


def read_table(path):
    with path.open() as file:
        return list(csv.DictReader(file))


class Report:
    """Collects the page's parts."""

    def __init__(self, study):
        self.study, self.parts = study, []
        self.scratch = tempfile.TemporaryDirectory()

    def add(self, *parts):
        self.parts += parts

    def picture(self, make, *arguments):
        """A picture that only the page needs."""
        path = Path(self.scratch.name) / "picture.png"
        make(*arguments, path)
        self.add(f"<p>{image(path, make.__name__)}</p>")

    def problem(self):
        study = self.study
        self.add(
            f"<h1>{html.escape(study.path.stem)}</h1>",
            "<h2>What was varied</h2>",
            table(
                [
                    {
                        "parameter": p.name,
                        "lowest": p.low,
                        "highest": p.high,
                        "baseline": p.baseline,
                        "where": f"{p.target.file}: {p.target.entry}"
                        if p.target
                        else study.parameters_file,
                    }
                    for p in study.parameters
                ]
            ),
        )
        if study.derived:
            self.add(
                table(
                    [
                        {
                            "derived": d.name,
                            "expression": d.expression.text,
                            "baseline": study.baseline_values[d.name],
                        }
                        for d in study.derived
                    ]
                )
            )
        for condition in study.constraints:
            self.add(f"<p><code>{html.escape(condition.text)}</code></p>")

    def strategy(self, name):
        """One strategy's designs, responses, models and optima."""
        study = self.study
        rows = results.rows(study, name)
        done = [r for r in rows if r["status"] == outcomes.DONE]
        failed = [r for r in rows if r["status"] == outcomes.FAILED]
        self.add(
            f"<h2>Strategy {name}</h2>",
            f"<p>Starts from the {study.strategies[name].start}."
            f" {counts(study, rows)}</p>",
        )
        links = self.pages(name)
        self.picture(plots.sampled, study, name)
        if failed:
            self.add(
                "<h3>Failed</h3>",
                table(self.classes(name)),
                table(failed, ["design", *study.names, "reason"], links),
            )
        if done:
            self.add("<h3>Responses</h3>")
            self.picture(plots.trends, study, done)
        self.models(name)
        self.optima(name, rows)
        self.descent(name)
        self.importance(name)
        self.add("<h3>All designs</h3>", table(rows, links=links))
        self.gallery(name, done)

    def classes(self, name):
        """One row per class of failures."""
        found = [
            outcomes.read(self.study, name, d.number)
            for d in designs.read(self.study)
        ]
        return [
            {
                "class": group.kind,
                "number": len(group.outcomes),
                "designs": group.names,
                "the first says": group.sentence,
            }
            for group in failures.groups(o for o in found if o and not o.done)
        ]

    def models(self, name):
        path = self.study.folder / f"fit.{name}"
        if (path / "models.csv").exists():
            self.add(
                "<h3>Metamodels</h3>",
                f"<p>{fitted_to(path)}</p>",
                table(read_table(path / "models.csv")),
                "<p>Each design predicted by the model"
                " without it; bars are two standard deviations.</p>",
                image(path / "leaveOneOut.png"),
            )

    def optima(self, name, rows):
        path = self.study.folder / f"optimise.{name}"
        if not (path / "representatives.csv").exists():
            return
        chosen = read_table(path / "representatives.csv")
        self.add(
            "<h3>Optima</h3>",
            image(path / "front.png"),
            "<p>The same" " front in the space of the parameters.</p>",
            image(path / "shapes.png"),
            table(chosen),
        )
        numbers = {row["design"] for row in chosen}
        self.gallery(name, [r for r in rows if r["design"] in numbers])

    def descent(self, name):
        path = self.study.folder / f"descend.{name}"
        if not (path / "optima.csv").exists():
            return
        history = read_table(path / "history.csv")
        shown = [
            key
            for key in history[0]
            if key not in self.study.names and key != "note"
        ]
        self.add(
            "<h3>Descent</h3>",
            image(path / "history.png"),
            "<p>Where it ended, the best start first:</p>",
            table(read_table(path / "optima.csv")),
            "<p>Its iterations; those that were not taken are trials that"
            " gained too little, or failed:</p>",
            table(history, [*shown, "note"]),
        )

    def importance(self, name):
        folder = self.study.folder / f"importance.{name}"
        if (folder / "importance.png").exists():
            self.add(
                "<h3>Importance</h3>",
                "<p>Each parameter's share of the gain, and what few of them"
                " reach.</p>",
                image(folder / "importance.png"),
                table(read_table(folder / "parameters.csv")),
            )
            if (folder / "elimination.csv").exists():
                self.add(table(read_table(folder / "elimination.csv")))

    def gallery(self, name, rows):
        for row in rows:
            path = self.study.folder / row["picture"]
            if row["picture"] and path.is_file():
                self.add(
                    f"<figure>{image(path)}<figcaption>{row['design']}: "
                    + ", ".join(
                        f"{n} {text(row[n])}"
                        for n in [*self.study.names, *self.study.responses]
                    )
                    + "</figcaption></figure>"
                )

    def comparison(self):
        """Strategies on the designs that each of them has done."""
        study = self.study
        tables = {
            name: {
                r["design"]: r
                for r in results.rows(study, name, baseline=False)
                if r["status"] == outcomes.DONE
                and r["origin"] == designs.SAMPLED
            }
            for name in study.strategies
        }
        tables = {name: rows for name, rows in tables.items() if rows}
        common = (
            sorted(set.intersection(*map(set, tables.values())))
            if (tables)
            else []
        )
        if len(tables) < 2 or not common:
            return
        tables = {
            name: [rows[d] for d in common] for name, rows in tables.items()
        }
        self.add(
            "<h2>Strategies compared</h2>",
            f"<p>On the {len(common)} designs that all have done: means,"
            " and the differences of responses from the first"
            " strategy.</p>",
            table(compare(study, tables)),
        )
        self.picture(plots.strategies, tables)

    def pages(self, name):
        """{design: its page} of a strategy."""
        study, found = self.study, {}
        own = [outcomes.read(study, outcomes.BASELINE)] + [
            outcomes.read(study, name, d.number) for d in designs.read(study)
        ]
        for outcome in own:
            if outcome:
                found[outcome.name] = design_page.write(study, name, outcome)
        return found

    def write(self, reload=None):
        """reload: after so many seconds, in a browser."""
        path = self.study.folder / "report.html"
        title = html.escape(self.study.path.stem)
        head = (
            f'<meta http-equiv="refresh" content="{reload}">' if reload else ""
        )
        new = path.with_suffix(".new")
        new.write_text(document(title, self.parts, head))
        new.replace(path)
        return path


def counts(study, rows):
    """How many designs there are, of which origin, and what became of them."""
    origins = [d.origin for d in designs.read(study)]
    kinds = [f"{origins.count(designs.SAMPLED)} sampled"]
    for origin, words in (
        (designs.VERIFICATION, ("verification", "verifications")),
        (designs.INFILL, ("of infill", "of infill")),
        (designs.DESCENT, ("of descents", "of descents")),
        (designs.GRADIENT, ("for differences", "for differences")),
    ):
        count = origins.count(origin)
        if count:
            kinds.append(f"{count} {words[count > 1]}")
    kinds = " and ".join(kinds)
    own = [r["status"] for r in rows if r["origin"] != "baseline"]
    return (
        f"Of {len(origins)} designs ({kinds})"
        f" {own.count(outcomes.DONE)} are done and"
        f" {own.count(outcomes.FAILED)} failed."
    )


def fitted_to(path):
    numbers = {r["design"] for r in read_table(path / "leaveOneOut.csv")}
    said = f"They are fitted to {len(numbers)} designs."
    if (path / "feasibility.csv").exists():
        rows = read_table(path / "feasibility.csv")
        done = [r["succeeded"] == "1" for r in rows]
        right = sum(
            (float(r["probability"]) >= 0.5) == d for r, d in zip(rows, done)
        )
        said += (
            f" {sum(done)} of {len(rows)} designs succeeded; whether one does"
            f" is told right for {right} by the model without it."
        )
    return said


def compare(study, tables):
    """One row per strategy: mean iterations, times, mesh figures, and how far
    its responses are from the first strategy's."""
    first = next(iter(tables.values()))
    rows = []
    for name, found in tables.items():
        row = {"strategy": name}
        row.update(
            means(found, lambda k: k in ("iterations", "time", "cpuTime"))
        )
        for response in study.responses:
            off = [
                100 * abs(a[response] - b[response]) / abs(b[response])
                for a, b in zip(found, first)
                if b[response]
            ]
            if off:
                row[f"{response}: mean difference %"] = statistics.mean(off)
                row[f"{response}: largest %"] = max(off)
        row.update(
            means(
                found, lambda k: k.startswith(("time.", "cpuTime.", "mesh."))
            )
        )
        rows.append(row)
    return rows


def means(rows, wanted):
    """Of the columns that are wanted, over the rows that have them."""
    values = {
        k: [r[k] for r in rows if r.get(k) not in (None, "")]
        for k in rows[0]
        if wanted(k)
    }
    return {k: statistics.mean(v) for k, v in values.items() if v}


def at_work(study):
    """Whether a sweep is, on any machine that shares the folder."""
    lock = study.folder / ".lock"
    if not lock.exists():
        return False
    with lock.open() as file, contextlib.suppress(OSError):
        fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
        return False
    return True


def report(study, watch=False):
    """watch: writes it again as designs finish, until no sweep is at work; in a
    browser it reloads itself meanwhile."""
    if watch:
        follow(study)
    path = make(study)
    print(path)
    return path


def make(study, reload=None):
    page = Report(study)
    page.problem()
    if reload:
        page.add(f"<p>{progress(study)} This page reloads itself.</p>")
    page.comparison()
    for name in study.strategies:
        if results.rows(study, name, baseline=False):
            page.strategy(name)
    return page.write(reload)


def progress(study):
    """How far the strategies are that have been begun."""
    total = len(designs.read(study))
    found = []
    for name in study.strategies:
        rows = results.rows(study, name, baseline=False)
        if rows:
            found.append(f"{name}: {len(rows)} of {total} designs.")
    return " ".join(found) or "No design is finished yet."


def follow(study):
    """As long as a sweep is at work."""
    written, before = 0, None
    while at_work(study):
        state = {
            file: file.stat().st_mtime_ns
            for file in (study.folder / "outcomes").rglob("*.json")
        }
        if state != before:
            start = time.monotonic()
            path = make(study, PAUSE)
            before, written = state, written + 1
            if written == 1:
                print(f"{path} is written as designs finish", flush=True)
            time.sleep((SHARE - 1) * (time.monotonic() - start))
        time.sleep(1)
    if not written:
        print(f"No sweep is at work in {study.folder}", flush=True)
