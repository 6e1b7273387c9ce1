#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""pictures.py [TUTORIAL ...]: the pictures of README and documentation, in
docs/pictures, from those that the tutorials have drawn. Runs a tutorial that
has not been run. Needs PIL (python3-pil).
"""

import pathlib
import subprocess
import sys

from PIL import Image, ImageChops

ROOT = pathlib.Path(__file__).resolve().parents[1]
OUTPUT = ROOT / "docs/pictures"
GREATEST = 150_000  # bytes

# Where a tutorial's pictures do not come from its Allrun alone
COMMANDS = {
    "airFoil2D": "Allrun.angles -motions rbf",
    "bulb": "Allrun; Allrun.descent",
}

# (name, tutorial, pictures of its results, width): side by side, or flat ones
# below each other
PICTURES = [
    ("front.rest", "airFoil2D", ["angle0.whole"], 700),
    ("front.turned", "airFoil2D", ["angle90.whole"], 700),
    ("airFoil2D.wide", "airFoil2D", ["angle0.wide", "angle90.wide"], 1000),
    (
        "bladeTip.blade",
        "bladeTip",
        ["blade.before", "blade.images.auto"],
        1000,
    ),
    (
        "bladeTip.middle",
        "bladeTip",
        ["middle.before", "middle.images.auto"],
        900,
    ),
    ("bladeTip.motion", "bladeTip", ["motion"], 1150),
    ("bulb.lattice", "bulb", ["bulb.before"], 700),
    ("bulb.mesh", "bulb", ["mesh.before", "mesh.after"], 900),
    ("bulb.pressure", "bulb", ["pressure.before", "pressure.after"], 900),
    ("bulb.descent", "bulb", ["history", "importance"], 1000),
    ("carBody.body", "carBody", ["body.before", "body.after"], 900),
    ("ffd2D.boxes", "ffd2D", ["inside", "boundary", "rotated"], 900),
    (
        "ffdEllipsoid.lattice",
        "ffdEllipsoid",
        ["ellipsoid.before", "ellipsoid.after"],
        900,
    ),
    ("flexiblePlate.film", "flexiblePlate", ["plate"], 900),
    ("floatingBody.film", "floatingBody", ["floating"], 900),
    ("hingedFloats.film", "hingedFloats", ["floats"], 900),
    (
        "motorBikeSurface.lattice",
        "motorBikeSurface",
        ["motorBike.before", "motorBike.after"],
        900,
    ),
    ("movingCone.mesh", "movingCone", ["cone"], 900),
    ("oscillatingCylinder.film", "oscillatingCylinder", ["wake"], 900),
    (
        "pistonBowl.side",
        "pistonBowl",
        ["side.before", "side.offset", "side.reentrant"],
        900,
    ),
    ("pitchingAerofoil.film", "pitchingAerofoil", ["pitching"], 900),
    (
        "pitchingAerofoilInSitu.sheet",
        "pitchingAerofoilInSitu",
        ["contactSheet"],
        1000,
    ),
    ("ribChannel.mesh", "ribChannel", ["mesh.lowest", "mesh.highest"], 800),
    ("ribChannel.T", "ribChannel", ["T.lowestCf", "T.highestNu"], 900),
    ("rudder.lattice", "rudder", ["rudder.before", "rudder.after"], 900),
    (
        "slidingCylinder.mesh",
        "slidingCylinder",
        ["laplacianUniform.sliding", "rbfSubSteps.sliding"],
        800,
    ),
    (
        "turningAerofoil.mesh",
        "turningAerofoil",
        ["fixed", "movingOptimised"],
        900,
    ),
    ("twistingColumn.film", "twistingColumn", ["twist"], 800),
    (
        "wigleyHull.water",
        "wigleyHull",
        ["water.before", "water.images.auto"],
        900,
    ),
    ("wingMotion.mesh", "wingMotion", ["wing"], 900),
]


def trimmed(picture):
    """Without the white around it."""
    white = Image.new("RGB", picture.size, "white")
    box = ImageChops.difference(picture, white).getbbox()
    return picture.crop(box) if box else picture


def together(pictures, gap=24):
    flat = all(p.width > 3 * p.height for p in pictures)
    width = [p.width for p in pictures]
    height = [p.height for p in pictures]
    between = gap * (len(pictures) - 1)
    whole = Image.new(
        "RGB",
        (max(width), sum(height) + between)
        if flat
        else (sum(width) + between, max(height)),
        "white",
    )
    at = 0
    for picture in pictures:
        whole.paste(
            picture,
            (0, at) if flat else (at, (whole.height - picture.height) // 2),
        )
        at += gap + (picture.height if flat else picture.width)
    return whole


def write(picture, path, width):
    """As large as it may be: fewer colours, then fewer pixels."""
    while True:
        height = round(width * picture.height / picture.width)
        small = picture.resize((width, height), Image.LANCZOS)
        for colours in (128, 64, 32, 16):
            small.quantize(colours, dither=Image.Dither.NONE).save(
                path, optimize=True
            )
            if path.stat().st_size <= GREATEST:
                return
        width = round(0.9 * width)


def main():
    wanted = sys.argv[1:] or sorted({tutorial for _, tutorial, *_ in PICTURES})
    OUTPUT.mkdir(exist_ok=True)
    for tutorial in wanted:
        results = ROOT / "tutorials" / tutorial / "results"
        mine = [p for p in PICTURES if p[1] == tutorial]
        if not all(
            (results / f"{name}.png").exists()
            for _, _, names, _ in mine
            for name in names
        ):
            for words in COMMANDS.get(tutorial, "Allrun").split(";"):
                command, *options = words.split()
                subprocess.run(
                    [ROOT / "tutorials" / tutorial / command, *options],
                    check=True,
                )
        for output, _, names, width in mine:
            parts = [
                trimmed(Image.open(results / f"{name}.png").convert("RGB"))
                for name in names
            ]
            path = OUTPUT / f"{output}.png"
            write(together(parts), path, width)
            print(path.relative_to(ROOT), path.stat().st_size)


if __name__ == "__main__":
    main()
