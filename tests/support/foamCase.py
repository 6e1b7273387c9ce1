# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Small OpenFOAM cases for tests: make one, run commands in it, read points.

    case = FoamCase(tmp_path)
    case.write("system/controlDict", "dictionary", "startTime 0; ...")
    run = case.run("blockMesh")             # asserts success, see run()
    case.decompose((2, 1, 1))
    case.run("morphMesh", ranks=2)
    points = case.points("0/polyMesh/points")
"""

import functools
import hashlib
import pathlib
import re
import subprocess

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]


@functools.lru_cache(maxsize=None)
def environment():
    """The environment that etc/bashrc makes of ours."""
    out = subprocess.run(
        ["bash", "-c", ". etc/bashrc && env -0"],
        cwd=ROOT,
        check=True,
        stdout=subprocess.PIPE,
    ).stdout.decode()
    return dict(item.split("=", 1) for item in out.split("\0") if "=" in item)


def build_program(name):
    """Build a program of tests/programs."""
    subprocess.run(
        ["wmake", ROOT / "tests/programs" / name],
        cwd=ROOT,
        check=True,
        env=environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.STDOUT,
    )


def read_vectors(path):
    """The n x 3 array of an ascii points file (or any vectorField)."""
    text = pathlib.Path(path).read_text()
    assert re.search(r"format\s+ascii", text), f"{path} is not ascii"
    body = re.search(r"\n(\d+)\s*\n?\((.*)\)", text, re.DOTALL)
    numbers = body.group(2).replace("(", " ").replace(")", " ").split()
    vectors = np.array(numbers, dtype=float).reshape(-1, 3)
    assert len(vectors) == int(body.group(1))
    return vectors


def read_labels(path):
    """The array of an ascii labelList file."""
    text = pathlib.Path(path).read_text()
    body = re.search(r"\n(\d+)\s*\n?\((.*)\)", text, re.DOTALL)
    return np.array(body.group(2).split(), dtype=int)


class FoamCase:
    """A case folder, made of dictionaries, that runs OpenFOAM commands."""

    def __init__(self, path):
        self.path = pathlib.Path(path)

    def write(self, file, class_name, body):
        """Write a file with its FoamFile header."""
        path = self.path / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(
            "FoamFile\n{\n    version 2.0;\n    format ascii;\n"
            f"    class {class_name};\n    object {path.name};\n}}\n\n{body}\n"
        )

    def run(self, *command, ranks=1, status=0, before=None):
        """Run a command here, on so many ranks; return what it printed.

        Fails with the output unless the command exits with the given status.
        before: called in the new process before the command starts.
        """
        command = [str(word) for word in command]
        if ranks > 1:
            command = [
                "mpirun",
                "--oversubscribe",
                "-np",
                str(ranks),
                *command,
                "-parallel",
            ]
        result = subprocess.run(
            command,
            cwd=self.path,
            timeout=300,
            env={**environment(), "PWD": str(self.path)},
            preexec_fn=before,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        output = result.stdout.decode(errors="replace")
        assert (
            result.returncode == status
        ), f"{command} exits with {result.returncode}\n{output[-4000:]}"
        return output

    def decompose(self, n, *options):
        """Decompose into n = (nx, ny, nz) parts."""
        self.write(
            "system/decomposeParDict",
            "dictionary",
            f"numberOfSubdomains {int(np.prod(n))};\nmethod simple;\n"
            f"simpleCoeffs {{ n ({n[0]} {n[1]} {n[2]}); "
            "delta 0.001; }",
        )
        self.run("decomposePar", *options)

    def decompose_cells(self, ranks):
        """Decompose so that each cell goes to the rank given for it."""
        ranks = [int(rank) for rank in ranks]
        self.write(
            "system/decomposeParDict",
            "dictionary",
            f"numberOfSubdomains {max(ranks) + 1};\nmethod manual;\n"
            'manualCoeffs { dataFile "cellDecomposition"; }',
        )
        self.write(
            "constant/cellDecomposition",
            "labelList",
            f"{len(ranks)}\n({' '.join(map(str, ranks))})",
        )
        self.run("decomposePar")

    def points(self, file):
        """The points of an ascii file of the case."""
        return read_vectors(self.path / file)

    def decomposed_points(self, file, mesh="constant/polyMesh"):
        """The points of a decomposed case, in the order of the whole mesh.

        Also checks that ranks agree on the points they share.
        """
        parts = [
            (
                read_labels(rank / mesh / "pointProcAddressing"),
                read_vectors(rank / file),
            )
            for rank in sorted(self.path.glob("processor[0-9]*"))
        ]
        whole = np.full((1 + max(a.max() for a, _ in parts), 3), np.nan)
        for labels, values in parts:
            shared = ~np.isnan(whole[labels, 0])
            np.testing.assert_allclose(
                whole[labels][shared], values[shared], rtol=0, atol=1e-12
            )
            whole[labels] = values
        assert not np.isnan(whole).any()
        return whole

    def tree(self):
        """Every file of the case with a hash of what is in it."""
        return {
            str(path.relative_to(self.path)): hashlib.sha1(
                path.read_bytes()
            ).hexdigest()
            if path.is_file()
            else "folder"
            for path in self.path.rglob("*")
        }

    def tree_without_reports(self):
        """The same without what a refused motion reports: no mesh file."""
        reports = ("/polyMesh/sets", "postProcessing", "/invalidMotionCells")
        return {
            file: content
            for file, content in self.tree().items()
            if not any(report in file for report in reports)
        }
