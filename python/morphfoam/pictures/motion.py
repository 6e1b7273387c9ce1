# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""One sheet of a motion, from the folder that morphMesh -pictures writes.

    $(python3With numpy matplotlib) -m morphfoam.pictures.motion
        FOLDER [OUTPUT.png] [-direction X Y Z]

Control points by kind with what they do, those that are selected; the mesh
where the motion changed it most, before and after; the worst cells; the
histograms of quality. Needs neither ParaView nor a display.
"""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

from morphfoam.pictures.preview import view_axes  # noqa: E402
from morphfoam.pictures.vtk_files import (  # noqa: E402
    read_lattice,
    read_points,
    read_surface_data,
)

KINDS = {
    "prescribed": ("#1f5fbf", "o"),
    "at rest": ("#8a8f98", "o"),
    "on an edge": ("#e07b00", "^"),
    "on a surface": ("#1e9e57", "s"),
    "off the mesh": ("#8b1fbf", "D"),
}
COLOURS = "YlOrRd"
MOST_ARROWS = 30  # of a row of the view
MANY_FACES = 40000
TITLES = {
    "nonOrthogonality": "non-orthogonality [deg]",
    "volumeRatio": "ratio of volumes",
}


class View:
    """Seen along a direction, onto a plane"""

    def __init__(self, direction):
        self.right, self.up, self.towards = view_axes(direction)

    def flat(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)


def table(path):
    """Rows of a file as dictionaries by the words of its first line"""
    lines = path.read_text().splitlines()
    names = lines[0].split()[1:]
    return [dict(zip(names, line.split())) for line in lines[1:]]


def vector_of(row, suffix):
    return np.array([float(row[axis + suffix]) for axis in "xyz"])


def control_points(folder):
    """(place now, displacement, kind, selected) of all control points"""
    found = []
    for path in sorted(folder.glob("*controlPoints.vtk")):
        points, data = read_points(path)
        if len(points):
            found.append((points, data))
    if not found:
        return None
    points = np.concatenate([x for x, _ in found])
    data = {
        name: np.concatenate([values[name] for _, values in found])
        for name in found[0][1]
    }
    return points, data


def kinds_of(data, dimensions):
    moves = np.linalg.norm(data["displacement"], axis=1)
    still = moves <= 1e-9 * (moves.max() if len(moves) else 0)
    kinds = np.full(len(moves), "on a surface", dtype=object)
    kinds[(data["conditions"] == 2) & (dimensions == 3)] = "on an edge"
    told = data["conditions"] >= dimensions
    kinds[told] = "prescribed"
    kinds[told & still] = "at rest"
    kinds[told & ~still & (data["offMesh"] > 0)] = "off the mesh"
    return kinds


def rounded_factor(enlargement):
    """1, 2 or 5 times a power of ten"""
    power = 10.0 ** np.floor(np.log10(enlargement))
    return max(f * power for f in (1, 2, 5) if f * power <= enlargement)


def thinned(places, length, low, high):
    """Of arrows at places the longest in each field of a grid"""
    size = (high - low).max() / MOST_ARROWS
    fields = np.floor((places - low) / size).astype(int)
    order = np.argsort(-length, kind="stable")
    _, first = np.unique(fields[order], axis=0, return_index=True)
    return order[first]


def draw_surface(ax, view, points, faces, colours, edges, width, alpha=1.0):
    corners = [points[face] for face in faces]
    depth = np.array([c.mean(axis=0) @ view.towards for c in corners])
    order = np.argsort(depth, kind="stable")
    ax.add_collection(
        PolyCollection(
            [view.flat(corners[i]) for i in order],
            facecolors=colours[order] if len(colours) else colours,
            edgecolors=edges,
            linewidths=width,
            alpha=alpha,
        )
    )


def shade(view, points, faces):
    """How much light falls on each face"""
    light = np.ones(len(faces))
    for i, face in enumerate(faces):
        c = points[face]
        normal = np.cross(c[1] - c[0], c[2] - c[0])
        length = np.linalg.norm(normal)
        if length > 0:
            light[i] = abs(normal @ view.towards) / length
    return 0.55 + 0.45 * light


def draw_boundary(ax, view, folder, dimensions):
    points, faces, data = read_surface_data(folder / "boundary.vtp")
    by = data["displacement"].reshape(-1, 3)
    reach = np.linalg.norm(by, axis=1)
    largest = reach.max() if len(reach) else 0.0
    if dimensions == 2:
        for where, colour in ((points, "0.75"), (points + by, "0.1")):
            ax.add_collection(
                LineCollection(
                    [view.flat(where[face]) for face in faces],
                    colors=colour,
                    linewidths=0.8,
                )
            )
        return
    moving = [f for f in faces if reach[f].max() > 1e-9 * largest]
    now = points + by
    if len(moving) > MANY_FACES:
        x, y = view.flat(now[np.unique(np.concatenate(moving))]).T
        ax.scatter(x, y, s=0.1, c="0.7", linewidths=0, rasterized=True)
    elif moving:
        light = shade(view, now, moving)
        colours = np.stack([0.86 * light, 0.88 * light, 0.92 * light], 1)
        draw_surface(ax, view, now, moving, colours, "0.6", 0.15, 0.45)


def limits_of(places):
    low, high = places.min(axis=0), places.max(axis=0)
    size = max((high - low).max(), 1e-300)
    middle = (low + high) / 2
    half = np.maximum((high - low) / 2, 0.3 * size) + 0.25 * size
    return middle - half, middle + half


def draw_arrows(ax, view, before, by, kinds, low, high):
    """By how much arrows are enlarged"""
    flat_before, flat_by = view.flat(before), view.flat(by)
    length = np.linalg.norm(flat_by, axis=1)
    seen = (length > 1e-3 * length.max()) & (
        (flat_before >= low) & (flat_before <= high)
    ).all(axis=1)
    if not seen.any():
        return 1.0
    share = length[seen].max() / (high - low).max()
    scale = rounded_factor(0.1 / share) if share < 0.03 else 1.0
    which = np.flatnonzero(seen)
    which = which[thinned(flat_before[which], length[which], low, high)]
    for kind, (colour, _) in KINDS.items():
        mine = which[kinds[which] == kind]
        if len(mine):
            ax.quiver(
                *flat_before[mine].T,
                *(scale * flat_by[mine]).T,
                angles="xy",
                scale_units="xy",
                scale=1,
                color=colour,
                alpha=0.7,
                width=0.0025,
                zorder=4,
            )
    return scale


def draw_controls(ax, view, folder, dimensions, worst):
    controls = control_points(folder)
    draw_boundary(ax, view, folder, dimensions)
    lattices = [
        line
        for path in sorted(folder.glob("*.vtk"))
        if not path.name.endswith(("controlPoints.vtk", "AtRest.vtk"))
        for line in read_lattice(path)
    ]
    ax.add_collection(
        LineCollection(
            [view.flat(line) for line in lattices],
            colors=[(0.8, 0.25, 0.1, 0.5)],
            linewidths=0.5,
        )
    )
    ax.set_aspect("equal")
    ax.set_xticks([])
    ax.set_yticks([])
    if controls is None:
        ax.set_title("boundary and lattices", fontsize=9)
        points, _, data = read_surface_data(folder / "boundary.vtp")
        shown = [view.flat(points), view.flat(points + data["displacement"])]
        shown += [view.flat(line) for line in lattices]
        low, high = limits_of(np.concatenate(shown))
        set_limits(ax, low, high)
        return
    now, data = controls
    by = data["displacement"]
    kinds = kinds_of(data, dimensions)
    told = np.isin(kinds, ("prescribed", "off the mesh"))
    shown = told if told.any() else np.ones(len(now), bool)
    flat = view.flat(now)
    low, high = limits_of(
        np.concatenate([flat[shown], view.flat(now - by)[shown]])
    )
    scale = draw_arrows(ax, view, now - by, by, kinds, low, high)
    inside = ((flat >= low) & (flat <= high)).all(axis=1)
    selected = data["selected"] > 0
    size = 12 if inside.sum() < 800 else 4
    for kind, (colour, marker) in KINDS.items():
        mine = kinds == kind
        if mine.any():
            ax.scatter(
                *flat[mine].T,
                s=size,
                c=colour,
                marker=marker,
                linewidths=0,
                zorder=5,
                label=f"{kind} ({mine.sum():,})",
            )
    ax.scatter(
        *flat[selected].T,
        s=26,
        facecolors="none",
        edgecolors="black",
        linewidths=0.7,
        zorder=6,
        label=f"selected ({selected.sum():,})",
    )
    places = view.flat(np.array([vector_of(cell, "After") for cell in worst]))
    near = ((places >= low) & (places <= high)).all(axis=1)
    if near.any():
        ax.scatter(
            *places[near].T,
            s=45,
            c="red",
            marker="x",
            linewidths=1.2,
            zorder=7,
            label=f"worst cells ({near.sum()} of {len(worst)} in view)",
        )
    set_limits(ax, low, high)
    regions = len(np.unique(data["region"]))
    title = f"{len(now):,} control points"
    if regions > 1:
        title += f" of {regions} regions"
    if not inside.all():
        title += f", {inside.sum():,} in view"
    if scale != 1:
        title += f"; arrows x {scale:g}"
    ax.set_title(title, fontsize=9)
    ax.legend(
        fontsize=7,
        loc="upper center",
        bbox_to_anchor=(0.5, -0.01),
        ncol=2,
        frameon=False,
        handletextpad=0.3,
    )


def set_limits(ax, low, high):
    """A square around them, so that the sheet is filled"""
    middle, half = (low + high) / 2, (high - low).max() / 2
    ax.set_xlim(middle[0] - half, middle[0] + half)
    ax.set_ylim(middle[1] - half, middle[1] + half)


class Window:
    """The mesh around a place, before and after"""

    def __init__(self, folder, row):
        self.reach = float(row["reach"])
        self.value = float(row["value"])
        normal = vector_of(row, "Normal")
        self.view = View(-normal if normal[1] else normal)
        self.before = vector_of(row, "Before")
        self.after = vector_of(row, "After")
        self.points, self.faces, self.data = read_surface_data(
            folder / f"{row['window']}.vtp"
        )
        self.by = self.data["displacement"].reshape(-1, 3)

    def largest(self):
        values = [
            self.data[f"nonOrthogonality{when}"]
            for when in ("Before", "After")
        ]
        return max([1.0] + [float(v.max()) for v in values if v.size])

    def draw(self, ax, when, title, largest, worst):
        points = self.points + (self.by if when == "After" else 0)
        colours = plt.get_cmap(COLOURS)(
            np.atleast_1d(self.data[f"nonOrthogonality{when}"]) / largest
        )[:, :3]
        if self.faces:
            colours *= shade(self.view, points, self.faces)[:, None]
            draw_surface(
                ax, self.view, points, self.faces, colours, "0.25", 0.4
            )
        centre = self.after if when == "After" else self.before
        places = np.array([vector_of(cell, when) - centre for cell in worst])
        depth = np.abs(places @ self.view.towards)
        places = self.view.flat(places)[depth <= self.reach]
        ax.scatter(*places.T, s=40, c="blue", marker="x", linewidths=1.2)
        ax.scatter(0, 0, s=150, facecolors="none", edgecolors="k", zorder=5)
        ax.set_xlim(-self.reach, self.reach)
        ax.set_ylim(-self.reach, self.reach)
        ax.set_aspect("equal")
        ax.set_xticks([])
        ax.set_yticks([])
        ax.set_title(title, fontsize=9)
        ax.set_xlabel(
            f"{2 * self.reach:.3g} m wide, at"
            f" ({', '.join(f'{x:.4g}' for x in centre)})",
            fontsize=7,
        )


def draw_histogram(ax, name, rows):
    before = np.array([float(row["before"]) for row in rows])
    after = np.array([float(row["after"]) for row in rows])
    last = max(np.flatnonzero(before + after), default=0) + 1
    first = min(np.flatnonzero(before + after), default=0)
    place = np.arange(first, last)
    ax.bar(place - 0.2, before[first:last], 0.4, color="0.7", label="before")
    ax.bar(place + 0.2, after[first:last], 0.4, color="#1f5fbf", label="after")
    ax.set_yscale("log")
    ax.set_ylim(bottom=0.7)
    ticks = place[:: max(1, len(place) // 8)]
    ax.set_xticks(ticks - 0.5)
    ax.set_xticklabels(
        [f"{float(rows[i]['from']):g}" for i in ticks], fontsize=7
    )
    ax.tick_params(axis="y", labelsize=7)
    ax.set_title(f"faces by {TITLES.get(name, name)}", fontsize=9)
    ax.legend(fontsize=7, frameon=False)
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)


def histograms(folder):
    found = {}
    for row in table(folder / "histogram.dat"):
        found.setdefault(row["figure"], []).append(row)
    return found


def changed_by(value):
    """The logarithm of a factor, in words"""
    return (
        f"a length changed by a factor of {np.exp(value):.3g}"
        if value > 1e-6
        else "no face changed its shape"
    )


def sheet(folder, output, direction=(-2, -3, 1.5)):
    """Write the sheet"""
    folder = Path(folder)
    rows = {row["window"]: row for row in table(folder / "windows.dat")}
    windows = {name: Window(folder, row) for name, row in rows.items()}
    worst = table(folder / "worstCells.dat")
    dimensions = int(rows["change"]["dimensions"])
    overview = windows["change"].view if dimensions == 2 else View(direction)

    figure = plt.figure(figsize=(14, 9.2))
    grid = figure.add_gridspec(
        2,
        12,
        left=0.015,
        right=0.99,
        top=0.95,
        bottom=0.05,
        wspace=0.9,
        hspace=0.28,
        height_ratios=(1.5, 1),
    )
    draw_controls(
        figure.add_subplot(grid[0, :4]), overview, folder, dimensions, worst
    )
    change, bad = windows["change"], windows["worst"]
    largest = max(change.largest(), bad.largest())
    change.draw(
        figure.add_subplot(grid[0, 4:8]),
        "Before",
        f"before: {changed_by(change.value)}",
        largest,
        worst,
    )
    change.draw(
        figure.add_subplot(grid[0, 8:]), "After", "after", largest, worst
    )
    ax = figure.add_subplot(grid[1, :3])
    cell = worst[0]
    bad.draw(
        ax,
        "After",
        f"worst cell: {float(cell['nonOrthogonality']):.3g} degrees,"
        f" skewness {float(cell['skewness']):.3g}",
        largest,
        worst,
    )
    bar = figure.colorbar(
        plt.cm.ScalarMappable(plt.Normalize(0, largest), COLOURS),
        ax=ax,
        fraction=0.05,
        pad=0.02,
    )
    bar.ax.set_title("non-orth. [deg]", fontsize=7, loc="left")
    bar.ax.tick_params(labelsize=7)
    for i, (name, counts) in enumerate(histograms(folder).items()):
        left = 3 + 3 * i
        draw_histogram(
            figure.add_subplot(grid[1, left : left + 3]), name, counts
        )
    figure.savefig(output, dpi=110)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("output", type=Path, nargs="?")
    parser.add_argument(
        "-direction", type=float, nargs=3, default=(-2, -3, 1.5)
    )
    arguments = parser.parse_args()
    if not (arguments.folder / "windows.dat").is_file():
        sys.exit(
            f"motion: there is no windows.dat in {arguments.folder}:"
            " morphMesh -pictures writes it"
        )
    output = arguments.output or arguments.folder / "motion.png"
    sheet(arguments.folder, output, arguments.direction)
    print(f"Wrote {output}")


if __name__ == "__main__":
    main()
