# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The VTK files that morphMesh and morphSurface write, read without VTK."""

import base64
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

TYPES = {
    "Float32": "f4",
    "Float64": "f8",
    "Int32": "i4",
    "Int64": "i8",
    "UInt8": "u1",
}


def read_array(element):
    """A DataArray of a VTK XML file, inline, as text or base64"""
    kind = TYPES[element.get("type")]
    text = (element.text or "").strip()
    if element.get("format") == "ascii":
        values = np.array(text.split(), kind)
    else:
        # The number of bytes stands before the values
        raw = base64.b64decode("".join(text.split()))
        size = int(np.frombuffer(raw[:8], "u8")[0])
        values = np.frombuffer(raw[8 : 8 + size], kind)
    n = int(element.get("NumberOfComponents", 1))
    return values.reshape(-1, n) if n > 1 else values


def read_surface(path):
    """Points and faces of a vtp file"""
    points, faces, _ = read_surface_data(path)
    return points, faces


def read_surface_data(path):
    """Points, faces, and the values at points and faces of a vtp file"""
    piece = ElementTree.parse(path).getroot().find(".//Piece")
    points = read_array(piece.find("Points/DataArray")).astype(float)
    polys = {
        array.get("Name"): read_array(array)
        for array in piece.findall("Polys/DataArray")
    }
    ends = polys["offsets"]
    starts = np.concatenate([[0], ends[:-1]])
    faces = [polys["connectivity"][a:b] for a, b in zip(starts, ends)]
    data = {
        array.get("Name"): read_array(array).astype(float)
        for place in ("PointData", "CellData")
        for array in piece.findall(f"{place}/DataArray")
    }
    return points.reshape(-1, 3), faces, data


def read_lattice(path):
    """The lines of a lattice, each an n x 3 array"""
    text = Path(path).read_text()
    points = re.search(r"POINTS (\d+) double\n", text)
    numbers = text[points.end() :].split(None, 3 * int(points[1]))
    points = np.array(numbers[: 3 * int(points[1])], float).reshape(-1, 3)
    lines = re.search(r"LINES (\d+) \d+\n", text)
    if not lines:
        return []
    rows = text[lines.end() :].splitlines()[: int(lines[1])]
    return [points[np.array(row.split()[1:], int)] for row in rows]


def read_points(path):
    """Points of a legacy file and the values at them, by name"""
    words = Path(path).read_text().split()
    at = words.index("POINTS")
    n = int(words[at + 1])
    points = np.array(words[at + 3 : at + 3 + 3 * n], float).reshape(n, 3)
    at = words.index("FIELD", at)
    count = int(words[at + 2])
    at += 3
    data = {}
    for _ in range(count):
        name, width = words[at], int(words[at + 1])
        values = np.array(words[at + 4 : at + 4 + width * n], float)
        data[name] = values.reshape(n, width) if width > 1 else values
        at += 4 + width * n
    return points, data
