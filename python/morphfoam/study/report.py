# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The verb report: one HTML page with what there is so far, pictures within."""

import base64
import csv
import html
import statistics
import tempfile
from pathlib import Path

from . import designs, failures, outcomes, plots, results

STYLE = """
body { font: 15px/1.5 sans-serif; max-width: 70em; margin: 2em auto;
       padding: 0 1em; color: #222; }
h1, h2, h3 { line-height: 1.2; } h2 { margin-top: 2em; }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0; }
th, td { padding: .2em .7em; text-align: right; border-bottom: 1px solid #ddd;
         font-variant-numeric: tabular-nums; }
th { border-bottom: 2px solid #888; }
td.text { text-align: left; min-width: 18em; overflow-wrap: anywhere; }
.wide { overflow-x: auto; } img { max-width: 100%; }
figure { display: inline-block; margin: 0 1em 1em 0; width: 20em;
         vertical-align: top; } figcaption { font-size: 13px; color: #555; }
tr.failed td { background: #fdecea; }
"""


# Columns of words
TEXTS = (
    "reason",
    "where",
    "expression",
    "class",
    "the first says",
    "note",
    "why",
    "which",
)


def text(value):
    """A value as a reader wants it."""
    try:
        number = float(value)
    except (TypeError, ValueError):
        return html.escape("" if value is None else str(value))
    return f"{number:.5g}"


def table(rows, columns=None):
    """An HTML table of dictionaries."""
    if not rows:
        return "<p>None.</p>"
    columns = columns or list(dict.fromkeys(k for row in rows for k in row))
    head = "".join(f"<th>{html.escape(c)}</th>" for c in columns)
    body = ""
    for row in rows:
        # A design's number is a name
        cells = "".join(
            f"<td>{html.escape(str(row[c]))}</td>"
            if c == "design"
            else "<td{}>{}</td>".format(
                ' class="text"' if c in TEXTS else "",
                text(row.get(c, "")),
            )
            for c in columns
        )
        failed = ' class="failed"' if row.get("status") == "failed" else ""
        body += f"<tr{failed}>{cells}</tr>\n"
    return f'<div class="wide"><table><tr>{head}</tr>\n{body}</table></div>'


def image(path, alt=""):
    data = base64.b64encode(Path(path).read_bytes()).decode()
    return f'<img alt="{html.escape(alt)}" src="data:image/png;base64,{data}">'


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
        self.picture(plots.sampled, study, name)
        if failed:
            self.add(
                "<h3>Failed</h3>",
                table(self.classes(name)),
                table(failed, ["design", *study.names, "reason"]),
            )
        if done:
            self.add("<h3>Responses</h3>")
            self.picture(plots.trends, study, done)
        self.models(name)
        self.optima(name, rows)
        self.descent(name)
        self.importance(name)
        self.add("<h3>All designs</h3>", table(rows))
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

    def write(self):
        path = self.study.folder / "report.html"
        title = html.escape(self.study.path.stem)
        path.write_text(
            '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
            f"<title>{title}</title><style>{STYLE}</style></head><body>\n"
            + "\n".join(self.parts)
            + "\n</body></html>\n"
        )
        return path


def counts(study, rows):
    """How many designs there are, of which origin, and what became of them."""
    origins = [d.origin for d in designs.read(study)]
    kinds = [f"{origins.count(designs.SAMPLED)} sampled"]
    for origin, words in (
        (designs.VERIFICATION, ("verification", "verifications")),
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
    return f"They are fitted to {len(numbers)} designs."


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


def report(study):
    page = Report(study)
    page.problem()
    page.comparison()
    for name in study.strategies:
        if results.rows(study, name, baseline=False):
            page.strategy(name)
    path = page.write()
    print(path)
    return path
