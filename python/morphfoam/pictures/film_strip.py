# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures side by side, as frames of a film.

    film_strip([first.png, second.png, ...], strip.png, columns=4)

Needs numpy and matplotlib. Pictures of one column have to be as wide as those
of the others, and of one row as high.
"""

import matplotlib.image
import numpy as np


def film_strip(pictures, output, columns, gap=8):
    frames = [matplotlib.image.imread(str(path))[..., :3] for path in pictures]
    height, width = frames[0].shape[:2]
    if any(frame.shape[:2] != (height, width) for frame in frames):
        raise ValueError("the pictures differ in size")
    rows = -(-len(frames) // columns)
    strip = np.ones(
        (rows * (height + gap) - gap, columns * (width + gap) - gap, 3)
    )
    for i, frame in enumerate(frames):
        y = i // columns * (height + gap)
        x = i % columns * (width + gap)
        strip[y : y + height, x : x + width] = frame
    matplotlib.image.imsave(str(output), strip)
