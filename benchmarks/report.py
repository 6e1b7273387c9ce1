# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Tables and pictures from what measure.py collected."""

import csv
import json

import matplotlib
import numpy as np
from matplotlib import pyplot as plt

import measure

matplotlib.use("Agg")

COLOURS = {
    "standard": "tab:red",
    "schur": "tab:orange",
    "one point": "tab:blue",
    "blocks": "tab:green",
}
LABELS = {
    "standard": "standard (Aubert 2017)",
    "schur": "schur (the paper's)",
    "one point": "incremental, one point",
    "blocks": "incremental, blocks",
}
SETS = {
    "rib": "rib, 3,225 candidates",
    "fan": "fan tip, 13,096",
    "box": "box, 100,000",
}


def seconds(value):
    """A time to three digits."""
    return (
        "–"
        if value is None
        else (
            f"{1000*value:.3g} ms"
            if value < 1
            else f"{value:.3g} s"
            if value < 100
            else f"{value:.0f} s"
        )
    )


def table(header, rows):
    """Markdown."""
    lines = [header, ["---"] * len(header)] + rows
    return "".join(
        "| " + " | ".join(map(str, line)) + " |\n" for line in lines
    )


def points_and_seconds(comparison, algorithm):
    """Both arrays, of the tolerances where the algorithm was run."""
    cells = [
        cell[algorithm] for cell in comparison["cells"] if algorithm in cell
    ]
    return (
        np.array([cell["selected"] for cell in cells], float),
        np.array([cell["total"] for cell in cells]),
    )


def exponent(n, t, least=0):
    """Slope in double logarithms of what has at least so many points."""
    use = n >= least
    if use.sum() < 2:
        return None
    return np.polyfit(np.log(n[use]), np.log(t[use]), 1)[0]


def figure_1a(data, folder):
    """Normalised time against N_res."""
    rows, sizes = data["restart"], data["plan"]["sizes"]
    percent = [100 * row["fraction"] for row in rows]
    figure, axes = plt.subplots(figsize=(6.4, 4.4))
    for n, marker in zip(sizes, "osD^"):
        times = np.array([row[str(n)] for row in rows])
        axes.plot(
            percent,
            times / times[-1],
            marker=marker,
            ms=5,
            label=f"{n} points ({times[-1]:.3g} s at " f"{percent[-1]:.0f} %)",
        )
    axes.set_xscale("log")
    ticks = [1, 2, 5, 10, 20, 60]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.minorticks_off()
    axes.set_ylim(bottom=0)
    axes.set_xlabel("$N_{res}$ [% of the selected subset]")
    axes.set_ylabel("time / time at 60 % [-]")
    axes.set_title(
        "Algorithm schur on fan13k, assembly of $\\Phi^c$ apart", fontsize=11
    )
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(folder / "figure1a.png", dpi=130)
    plt.close(figure)


def figure_1b(data, folder):
    """Time of the four algorithms against the number selected."""
    figure, axes = plt.subplots(figsize=(6.4, 4.8))
    for algorithm, colour in COLOURS.items():
        n, t = points_and_seconds(data["fan"], algorithm)
        axes.loglog(
            n,
            t,
            "o",
            ms=5,
            color=colour,
            label=f"{LABELS[algorithm]}: $n^{{{exponent(n, t):.2f}}}$",
        )
        fit = np.polyfit(np.log(n), np.log(t), 1)
        axes.loglog(
            n,
            np.exp(np.polyval(fit, np.log(n))),
            "-",
            lw=1,
            color=colour,
            alpha=0.6,
        )
    axes.set_xlabel("control points selected of 13,096 [-]")
    axes.set_ylabel("time of the selection [s]")
    ticks = [t for t in (50, 100, 200, 500, 1000) if t < 1.1 * n.max()]
    axes.set_xticks(ticks, [str(tick) for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.grid(alpha=0.3)
    # Room for the legend, above schur and left of standard
    axes.set_ylim(top=30 * axes.get_ylim()[1])
    axes.legend(title="fitted over all sizes", loc="upper left")
    figure.tight_layout()
    figure.savefig(folder / "figure1b.png", dpi=130)
    plt.close(figure)


def figure_propagation(data, folder):
    """Time per pair of the kernels beside the limits."""
    best = data["kernels"]["best"]
    names = [name[4:] for name in best if name.startswith("sum/")]
    y = np.arange(len(names))
    figure, axes = plt.subplots(figsize=(6.4, 4.2))
    for kind, label, marker in (
        ("sum", "addKernelSum", "o"),
        ("interpolant", "RbfInterpolant", "d"),
    ):
        axes.plot(
            [1e9 * best[f"{kind}/{name}"]["pair"] for name in names],
            y,
            marker,
            ms=7,
            alpha=0.8,
            label=label,
        )
    for name, label, style in (
        ("squareRoot", "square root", "--"),
        ("multiplyAdds", "15 multiply-adds", ":"),
    ):
        axes.axvline(
            1e9 * best["limit/" + name]["pair"],
            color="k",
            ls=style,
            label="limit: " + label,
        )
    axes.set_yticks(y, names)
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xticks([0.2, 0.5, 1, 2, 5], ["0.2", "0.5", "1", "2", "5"])
    axes.set_xticks([], minor=True)
    axes.grid(alpha=0.3)
    axes.set_xlabel("time per pair of point and centre [ns]")
    axes.legend()
    figure.tight_layout()
    figure.savefig(folder / "propagation.png", dpi=130)
    plt.close(figure)


def write_csv(path, header, rows):
    with open(path, "w", newline="") as out:
        csv.writer(out).writerows([header, *rows])


def tables_csv(data, folder):
    """What the tables and pictures show, for other programs."""
    sizes = data["plan"]["sizes"]
    write_csv(
        folder / "figure1a.csv",
        ["fraction", "assembly[s]"] + [f"{n} points[s]" for n in sizes],
        [
            [row["fraction"], row["assembly"]] + [row[str(n)] for n in sizes]
            for row in data["restart"]
        ],
    )
    write_csv(
        folder / "selection.csv",
        ["set", "tolerance", "algorithm", "selected", "time[s]"],
        [
            [
                name,
                cell["tolerance"],
                algorithm,
                cell[algorithm]["selected"],
                cell[algorithm]["total"],
            ]
            for name in SETS
            for cell in data[name]["cells"]
            for algorithm in COLOURS
            if algorithm in cell
        ],
    )
    write_csv(
        folder / "kernels.csv",
        ["instructions", "benchmark", "pair[s]", "reached"],
        [
            [level, name, run["pair"], run["reached"]]
            for level, runs in data["kernels"].items()
            for name, run in runs.items()
        ],
    )


def selection_table(data):
    """The table of the four algorithms."""
    rows = []
    for name, title in SETS.items():
        for cell in data[name]["cells"]:
            if cell["tolerance"] not in data["plan"][name + "Rows"]:
                continue
            t = {a: cell[a]["total"] if a in cell else None for a in COLOURS}
            ratio = {
                a: f"**{t[a]/t['blocks']:.0f}**" if t[a] else "–"
                for a in ("standard", "schur")
            }
            one = (
                f"{t['standard']/t['one point']:.0f}" if t["standard"] else "–"
            )
            rows.append(
                [
                    title,
                    f"{cell['tolerance']:g}",
                    f"{cell['blocks']['selected']} "
                    f"({cell['one point']['selected']})",
                    *(seconds(t[a]) for a in COLOURS),
                    ratio["standard"],
                    ratio["schur"],
                    one,
                ]
            )
    return table(
        [
            "set",
            "tolerance",
            "points, blocks (strict)",
            "standard",
            "schur",
            "one point",
            "blocks",
            "standard / blocks",
            "schur / blocks",
            "standard / one point",
        ],
        rows,
    )


def growth_table(data):
    """Exponents of the time, by least squares in logarithms."""
    rows = []
    for algorithm, label in LABELS.items():
        n, t = points_and_seconds(data["fan"], algorithm)
        upper = exponent(n, t, 400)
        rows.append(
            [
                label,
                f"{n.min():.0f} … {n.max():.0f}",
                f"{exponent(n, t):.2f}",
                "–" if upper is None else f"{upper:.2f}",
            ]
        )
    return table(
        ["algorithm", "points", "exponent", "from 400 points on"], rows
    )


def phase_table(data):
    """Where the time of the block form goes, and its memory."""
    rows = []
    for name, title in SETS.items():
        end = data[name]["ends"]["blocks"]
        rows.append(
            [
                title,
                end["selected"],
                end["sweeps"],
                *(seconds(end[p]) for p in ("sweep", "list", "solve")),
                seconds(end["total"]),
                f"{100*(end['spread'] - 1):.0f} %",
                f"{end['evaluationError']:.1e}",
            ]
        )
    return table(
        [
            "set",
            "points",
            "sweeps",
            "sweeps' time",
            "list and choice",
            "append and solve",
            "total",
            "slowest over fastest run",
            "sum against long double",
        ],
        rows,
    )


def memory_table(data):
    """Growth of memory by the longest run of each algorithm."""
    rows = []
    for name, title in SETS.items():
        ends = data[name]["ends"]
        rows.append(
            [title]
            + [
                f"{ends[a]['peakMB']:.1f} / {ends[a]['keptMB']:.1f} MB "
                f"({ends[a]['selected']})"
                if a in ends
                else "–"
                for a in COLOURS
            ]
        )
    return table(
        ["memory: peak / kept afterwards (points)"] + list(COLOURS), rows
    )


def count_text(data):
    """Points selected by blocks relative to one by one."""
    rows, excess = [], []
    for name, title in SETS.items():
        ratios = [
            100
            * (cell["blocks"]["selected"] / cell["one point"]["selected"] - 1)
            for cell in data[name]["cells"]
        ]
        excess += ratios
        rows.append(
            [
                title,
                " ".join(f"{t['tolerance']:g}" for t in data[name]["cells"]),
                " ".join(f"{r:+.1f}" for r in ratios),
            ]
        )
    worst = max(excess)
    return (
        table(["set", "tolerances", "points more than one by one [%]"], rows)
        + f"\nMean {np.mean(excess):+.1f} %, worst {worst:+.1f} %.\n"
    )


def same_text(data):
    """Whether the sets selected are identical."""
    said = []
    for name in ("rib", "fan"):
        n = data[name]["ends"]["one point"]["selected"]
        for other, key in (
            ("standard", "onePointIsStandard"),
            ("schur", "onePointIsSchur"),
        ):
            said.append(
                f"{name}, {n} points: one point selects "
                + (
                    "the same set as "
                    if data[name][key]
                    else "NOT the set of "
                )
                + other
            )
    return "; ".join(said) + ".\n"


def propagation_table(data):
    """Section 3 of the mathematics."""
    rows = []
    words = {
        "best": data["machine"]["instructions"],
        "v3": "AVX2",
        "baseline": "SSE2",
    }
    for level, runs in data["kernels"].items():

        def ns(name):
            return f"{1e9*runs[name]['pair']:.3f}"

        rows.append(
            [
                words[level],
                ns("naive/powers"),
                ns("naive/products"),
                ns("sum/wendlandC2"),
                ns("interpolant/wendlandC2"),
                ns("matrix/wendlandC2"),
                ns("limit/squareRoot"),
                ns("limit/multiplyAdds"),
                "{:.0f} %".format(
                    100
                    * runs["limit/squareRoot"]["pair"]
                    / runs["sum/wendlandC2"]["pair"]
                ),
            ]
        )
    return table(
        [
            "instructions",
            "naive, `pow`",
            "naive, products",
            "addKernelSum",
            "RbfInterpolant",
            "kernelMatrix",
            "limit: square root",
            "limit: 15 multiply-adds",
            "addKernelSum at",
        ],
        rows,
    )


def runs_named(prefix, runs):
    """What a program measured under names with this prefix: (rest, run)."""
    return [
        (name[len(prefix) :], run)
        for name, run in runs.items()
        if name.startswith(prefix)
    ]


def kernel_table(data):
    """All kernels, with the best instruction set."""
    best = data["kernels"]["best"]
    root = best["limit/squareRoot"]["pair"]
    columns = [
        "kernel",
        "addKernelSum [ns]",
        "RbfInterpolant [ns]",
        "square-root limit / addKernelSum",
    ]
    rows = []
    for name, run in runs_named("sum/", best):
        whole = best["interpolant/" + name]["pair"]
        rows.append(
            [
                name,
                f"{1e9*run['pair']:.3f}",
                f"{1e9*whole:.3f}",
                f"{100*root/run['pair']:.0f} %",
            ]
        )
    return table(columns, rows)


def culling_table(data):
    best = data["kernels"]["best"]
    whole = best["interpolant/wendlandC2"]["pair"]
    columns = [
        "r0 / span",
        "pairs in reach of their leaf",
        "ns per pair, all counted",
        "times faster",
    ]
    rows = [
        [
            name,
            f"{100*run['reached']:.0f} %",
            f"{1e9*run['pair']:.3f}",
            f"{whole/run['pair']:.1f}",
        ]
        for name, run in runs_named("culled/", best)
    ]
    return table(columns, rows)


def restart_table(data):
    sizes = data["plan"]["sizes"]
    rows = [
        [f"{100*row['fraction']:.0f} %"]
        + [seconds(row[str(n)]) for n in sizes]
        for row in data["restart"]
    ]
    return table(["N_res"] + [f"{n} points" for n in sizes], rows)


def figures(data):
    """What the README repeats."""
    m = data["machine"]
    return (
        f"{m['date']}, one core of {m['cpu']}, {m['instructions']}, "
        f"{m['compiler']}, BLAS: {m['blas']}; commit {m['commit']}.\n\n"
        + selection_table(data)
        + "\n"
        + growth_table(data)
        + "\n"
        + same_text(data)
        + "\n"
        + memory_table(data)
        + "\nPropagation, Wendland C2, ns per pair of point and centre:\n\n"
        + propagation_table(data)
    )


def markdown(data):
    """The dated report."""
    pictures = data["machine"]["date"]
    return f"""# Benchmarks, {data['machine']['date']}

{'Quick run: few repetitions, small sizes. ' if data.get('quick') else ''}\
Medians of repeated runs where a run takes less than some 20 s;
{data.get('minutes', 0):.0f} minutes in all; load of the machine at the start:
{data['machine']['load']}.

## Selection

{figures(data)}
![Figure 1(b)]({pictures}/figure1b.png)

Standard, schur and one point: one run each to the smallest tolerance, and the
time at which it had met the others. Blocks: a run for each tolerance.

## Where the time of the blocks goes

{phase_table(data)}
## How many points blocks select

{count_text(data)}
## N_res of algorithm schur (Figure 1(a))

The loop alone; assembling the matrix of all pairs takes \
{seconds(measure.median([row['assembly'] for row in data['restart']]))} more.

{restart_table(data)}
![Figure 1(a)]({pictures}/figure1a.png)

## Kernels

{kernel_table(data)}
![Propagation]({pictures}/propagation.png)

Centres out of reach of a leaf of 512 points are skipped:

{culling_table(data)}"""


def fill_readme(data):
    """The figures between two marks of the README."""
    path = measure.HERE / "README.md"
    text = path.read_text()
    begin, end = "<!-- figures -->\n", "<!-- end of figures -->"
    head, rest = text.split(begin)
    path.write_text(head + begin + figures(data) + end + rest.split(end, 1)[1])


def write(data, where):
    """Everything into a folder; returns the report."""
    date = data["machine"]["date"]
    folder = where / date
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "data.json").write_text(json.dumps(data, indent=1))
    figure_1a(data, folder)
    figure_1b(data, folder)
    figure_propagation(data, folder)
    tables_csv(data, folder)
    (where / (date + ".md")).write_text(markdown(data))
    if not data.get("quick"):
        fill_readme(data)
    return where / (date + ".md")
