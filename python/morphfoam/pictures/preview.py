# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""One sheet with every parameter at both bounds, from the folder that
morphSurface -lattice and morphMesh -lattice write.

    $(python3With numpy matplotlib) -m morphfoam.pictures.preview
        FOLDER [OUTPUT.png] [-direction X Y Z] [-most N]

Colours tell how far the surface moves from where it is now, up to the largest
move of that parameter, which the title gives. Needs neither ParaView nor a
display.
"""

import argparse
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection  # noqa: E402

from morphfoam.pictures.vtk_files import (  # noqa: E402
    read_lattice,
    read_surface,
)

# Surfaces with more of them are drawn as points: faces would take minutes
MANY_FACES = 40000


def view_axes(direction):
    """To the right, upwards, and towards the one who looks"""
    towards = np.array(direction, float)
    towards /= np.linalg.norm(towards)
    up = np.array([0.0, 0, 1])
    if abs(towards @ up) > 0.95:
        up = np.array([0.0, 1, 0])
    right = np.cross(up, towards)
    right /= np.linalg.norm(right)
    return right, np.cross(towards, right), towards


class Picture:
    """Surfaces and lattices, seen from a direction"""

    def __init__(self, direction):
        self.right, self.up, self.towards = view_axes(direction)

    def flat(self, points):
        return np.stack([points @ self.right, points @ self.up], axis=-1)

    def draw(self, ax, points, faces, moved, largest, lattices):
        if len(faces) > MANY_FACES:
            self.draw_points(ax, points, moved, largest)
        else:
            self.draw_faces(ax, points, faces, moved, largest)
        ax.add_collection(
            LineCollection(
                [self.flat(line) for line in lattices],
                colors=[(0.8, 0.25, 0.1, 0.5)],
                linewidths=0.4,
            )
        )
        ax.set_aspect("equal")
        ax.axis("off")

    def draw_points(self, ax, points, moved, largest):
        order = np.argsort(points @ self.towards, kind="stable")
        x, y = self.flat(points[order]).T
        colours = plt.get_cmap("viridis")(moved[order] / largest)
        ax.scatter(x, y, s=0.15, c=colours, linewidths=0, rasterized=True)

    def draw_faces(self, ax, points, faces, moved, largest):
        corners = [points[face] for face in faces]
        depth = np.array([c.mean(axis=0) @ self.towards for c in corners])
        normals = np.array(
            [np.cross(c[1] - c[0], c[2] - c[0]) for c in corners]
        )
        length = np.linalg.norm(normals, axis=1)
        length[length == 0] = 1
        light = np.abs(normals @ self.towards) / length
        reach = np.array([moved[face].mean() for face in faces])
        colours = plt.get_cmap("viridis")(reach / largest)[:, :3]
        still = reach < 1e-9 * largest
        colours[still] = [0.8, 0.82, 0.86]
        colours *= (0.45 + 0.55 * light)[:, None]
        order = np.argsort(depth, kind="stable")
        ax.add_collection(
            PolyCollection(
                [self.flat(corners[i]) for i in order],
                facecolors=colours[order],
                edgecolors=colours[order],
                linewidths=0.2,
            )
        )


def pages(folder):
    """(parameter, {"min": path, "max": path}) in the order of their files"""
    found = {}
    for path in sorted(folder.glob("*.vtp")):
        match = re.fullmatch(r"(.+)\.(min|max)\.vtp", path.name)
        if match:
            found.setdefault(match[1], {})[match[2]] = path
    return sorted(found.items())


def sheet(folder, output, direction=(-2, -3, 1.5), most=60):
    """Write the sheet; the number of parameters in it"""
    folder = Path(folder)
    shown = pages(folder)
    if not shown:
        raise SystemExit(
            f"preview: no parameter has bounds in {folder}: give them 'min'"
            " and 'max', and use -lattice"
        )
    left_out = len(shown) - most
    shown = shown[:most]
    rest, faces = read_surface(folder / "surface.vtp")
    lattices = [
        line
        for path in sorted(folder.glob("*AtRest.vtk"))
        for line in read_lattice(path)
    ]
    surfaces = {
        path: read_surface(path)[0]
        for _, bounds in shown
        for path in bounds.values()
    }
    moved = {
        path: np.linalg.norm(points - rest, axis=1)
        for path, points in surfaces.items()
    }
    picture = Picture(direction)
    everything = np.concatenate(
        [picture.flat(points) for points in surfaces.values()]
        + [picture.flat(line) for line in lattices]
    )
    low, high = everything.min(axis=0), everything.max(axis=0)
    margin = 0.03 * (high - low).max()

    pairs = min(3, len(shown))
    rows = -(-len(shown) // pairs)
    shape = high - low + 2 * margin
    width = 2.6
    height = min(max(width * shape[1] / shape[0], 0.8), 3.5) + 0.3
    figure, axes = plt.subplots(
        rows,
        2 * pairs,
        figsize=(2 * pairs * width, rows * height + 0.3),
        squeeze=False,
    )
    for ax in axes.flat:
        ax.axis("off")
    for i, (name, bounds) in enumerate(shown):
        largest = max(moved[path].max() for path in bounds.values()) or 1.0
        for side, bound in enumerate(("min", "max")):
            ax = axes[i // pairs, 2 * (i % pairs) + side]
            ax.set_title(f"{name}, {bound} ({largest:.3g} m)", fontsize=7)
            if bound not in bounds:
                ax.text(
                    0.5,
                    0.5,
                    "no bound,\nor it folds",
                    ha="center",
                    va="center",
                    fontsize=7,
                    transform=ax.transAxes,
                )
                continue
            path = bounds[bound]
            picture.draw(
                ax, surfaces[path], faces, moved[path], largest, lattices
            )
            ax.set_xlim(low[0] - margin, high[0] + margin)
            ax.set_ylim(low[1] - margin, high[1] + margin)
    figure.subplots_adjust(
        left=0.01,
        right=0.99,
        top=1 - 0.35 / figure.get_figheight(),
        bottom=0.02,
        hspace=0.15,
        wspace=0.03,
    )
    figure.savefig(output, dpi=120)
    plt.close(figure)
    if left_out > 0:
        print(f"preview: {left_out} parameters are left out (-most)")
    return len(shown)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("output", type=Path, nargs="?")
    parser.add_argument(
        "-direction", type=float, nargs=3, default=(-2, -3, 1.5)
    )
    parser.add_argument("-most", type=int, default=60)
    arguments = parser.parse_args()
    if not arguments.folder.is_dir():
        sys.exit(f"preview: there is no folder {arguments.folder}")
    output = arguments.output or arguments.folder / "preview.png"
    n = sheet(arguments.folder, output, arguments.direction, arguments.most)
    print(f"Wrote {output}: {n} parameters")


if __name__ == "__main__":
    main()
