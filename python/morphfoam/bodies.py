# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Closed surfaces that tutorials put into a flow, written as STL.

    python3 -m morphfoam.bodies ellipsoid|bulb|rudder OUTPUT.stl

Lengths in metres; a body is a grid of rings of points, from one end to the
other, closed by a fan at either end.
"""

import argparse
from pathlib import Path

import numpy as np

# NACA 63(1)-012, in per cent of the chord: Abbott, I. H., von Doenhoff, A. E.
# (1959). Theory of wing sections. Dover, appendix III.
STATION = [
    0,
    0.5,
    0.75,
    1.25,
    2.5,
    5,
    7.5,
    10,
    15,
    20,
    25,
    30,
    35,
    40,
    45,
    50,
    55,
    60,
    65,
    70,
    75,
    80,
    85,
    90,
    95,
    100,
]
ORDINATE = [
    0,
    0.985,
    1.194,
    1.519,
    2.102,
    2.925,
    3.542,
    4.039,
    4.799,
    5.342,
    5.712,
    5.930,
    6.000,
    5.920,
    5.704,
    5.370,
    4.935,
    4.420,
    3.840,
    3.210,
    2.556,
    1.902,
    1.274,
    0.707,
    0.250,
    0,
]


def half_thickness(x):
    """Of the NACA 63-012 at x = 0..1, in chords. A curve through sqrt(x)
    keeps the nose round."""
    return np.interp(
        np.sqrt(x), np.sqrt(np.array(STATION) / 100), np.array(ORDINATE) / 100
    )


def triangles(rings):
    """Of a body of m rings of n points (m x n x 3): k x 3 x 3."""
    m, n, _ = rings.shape
    result = []
    for end, ring, order in ((0, rings[0], 1), (-1, rings[-1], -1)):
        tip = ring.mean(axis=0)
        for j in range(n):
            result.append([tip, *[ring[(j + 1) % n], ring[j]][::order]])
    for i in range(m - 1):
        for j in range(n):
            a, b = rings[i, j], rings[i, (j + 1) % n]
            c, d = rings[i + 1, (j + 1) % n], rings[i + 1, j]
            result += [[a, b, c], [a, c, d]]
    result = np.array(result)
    area = np.linalg.norm(
        np.cross(result[:, 1] - result[:, 0], result[:, 2] - result[:, 0]),
        axis=1,
    )
    return result[area > 1e-14 * area.max()]


def revolution(x, radius_y, radius_z, n):
    """Rings of elliptic sections along x."""
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack(
        [
            np.stack([np.full(n, a), b * np.cos(angle), c * np.sin(angle)], 1)
            for a, b, c in zip(x, radius_y, radius_z)
        ]
    )


def ellipsoid(diameters=(1, 0.5, 0.3), n=80):
    """The ellipsoid of Koshakji (2011), figure 2.13."""
    angle = np.pi * np.arange(n + 1) / n
    a, b, c = np.array(diameters) / 2
    return triangles(
        revolution(-a * np.cos(angle), b * np.sin(angle), c * np.sin(angle), n)
    )


def bulb(length=3, volume=0.7156, n=80):
    """A body of revolution with the meridian of a NACA 63-012, thickened to
    the volume of Koshakji (2011), table 5.1."""
    x = (1 - np.cos(np.pi * np.arange(n + 1) / n)) / 2
    r = half_thickness(x)
    # Of the faceted body
    section = n / 2 * np.sin(2 * np.pi / n)
    cones = (
        np.diff(x) * (r[1:] ** 2 + r[1:] * r[:-1] + r[:-1] ** 2) / 3
    ).sum()
    r = r * np.sqrt(volume / (section * length * cones))
    return triangles(revolution(length * (x - 0.5), r, r, n))


def rudder(chord=0.5, span=3.02, volume=0.0298, n=60, layers=30):
    """A NACA 63-012, tapered about its quarter chord to the volume of Koshakji
    (2011), table 5.3, at 5 degrees to x; root at z = span."""
    x = (1 - np.cos(np.pi * np.arange(n + 1) / n)) / 2
    upper = np.stack([x, half_thickness(x)], 1)
    section = np.concatenate([upper, (upper * [1, -1])[-2:0:-1]])
    area = np.trapz(2 * half_thickness(x), x)
    # chord^2 + chord tip + tip^2 = 3 volume/(area span)
    tip = (
        np.sqrt(4 * 3 * volume / (area * span) - 3 * chord**2) - chord
    ) / 2
    turn = np.radians(5)
    rotation = np.array(
        [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
    )
    rings = []
    for z in np.linspace(0, 1, layers + 1):
        c = tip + (chord - tip) * z
        points = (section - [0.25, 0]) * c @ rotation.T
        rings.append(np.column_stack([points, np.full(len(points), span * z)]))
    return triangles(np.array(rings)[:, ::-1])


def wing(chord=1.0, tip=0.6, span=3.0, n=40, layers=24):
    """Half a wing of NACA 63-012 sections, its axis, the quarter chords, along
    z from the root on."""
    x = (1 - np.cos(np.pi * np.arange(n + 1) / n)) / 2
    upper = np.stack([x, half_thickness(x)], 1)
    section = np.concatenate([upper, (upper * [1, -1])[-2:0:-1]])
    rings = []
    for z in np.linspace(0, 1, layers + 1):
        points = (section - [0.25, 0]) * (chord + (tip - chord) * z)
        rings.append(np.column_stack([points, np.full(len(points), span * z)]))
    return triangles(np.array(rings)[:, ::-1])


def nozzle(n=72, m=40):
    """The wall of a nozzle about x, 0.1 m thick: radius 0.5 m, in its throat
    0.35 m."""
    x = np.linspace(0, 2, m + 1)
    radius = 0.5 - 0.15 * np.sin(np.pi * x / 2) ** 2
    outline = np.concatenate(
        [
            np.stack([x, radius], 1),
            np.stack([x, radius + 0.1], 1)[::-1],
        ]
    )
    angle = 2 * np.pi * np.arange(n) / n
    rings = np.stack(
        [
            np.stack([np.full(n, a), r * np.cos(angle), r * np.sin(angle)], 1)
            for a, r in outline
        ]
    )
    faces = []
    for i in range(len(rings)):
        ring, following = rings[i], rings[(i + 1) % len(rings)]
        for j in range(n):
            a, b = ring[j], ring[(j + 1) % n]
            c, d = following[(j + 1) % n], following[j]
            faces += [[a, c, b], [a, d, c]]
    return np.array(faces)


def volume(faces):
    """Enclosed by triangles whose normals point outwards."""
    return (
        np.einsum("ij,ij->", faces[:, 0], np.cross(faces[:, 1], faces[:, 2]))
        / 6
    )


def write(faces, path, name):
    """As ASCII STL."""
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w") as file:
        print("solid", name, file=file)
        for face in faces:
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            normal = normal / np.linalg.norm(normal)
            print(
                "facet normal {:.9g} {:.9g} {:.9g}".format(*normal),
                "\n  outer loop",
                file=file,
            )
            for point in face:
                print(
                    "    vertex {:.9g} {:.9g} {:.9g}".format(*point), file=file
                )
            print("  endloop\nendfacet", file=file)
        print("endsolid", name, file=file)


BODIES = {
    "ellipsoid": ellipsoid,
    "bulb": bulb,
    "rudder": rudder,
    "wing": wing,
    "nozzle": nozzle,
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("body", choices=BODIES)
    parser.add_argument("output")
    arguments = parser.parse_args()
    write(BODIES[arguments.body](), arguments.output, arguments.body)


if __name__ == "__main__":
    main()
