# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""A copy of a tutorial, made small, and runs of it: what a run says, where its
points are, what its motion costs.
"""

import pathlib
import re
import resource
import shutil
import subprocess

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from foamCase import environment, read_vectors

HERE = pathlib.Path(__file__).resolve().parent
TIMEOUT = 600

FREE = (
    "zeroGradient",
    "calculated",
    "slip",
    "fixedNormalSlip",
    "empty",
    "wedge",
    "symmetry",
    "symmetryPlane",
    "overset",
)


def run_environment(folder):
    """Of the programs, with the clock before them."""
    env = dict(environment())
    clock = pathlib.Path(env["MORPHFOAM_LIBBIN"]) / "libmotionClock.so"
    env["LD_PRELOAD"] = ":".join(
        part for part in (str(clock), env.get("LD_PRELOAD")) if part
    )
    env["PWD"] = str(folder)
    env["MOTION_CLOCK"] = str(folder / "motionClock")
    env["OMP_NUM_THREADS"] = env["OPENBLAS_NUM_THREADS"] = "1"
    return env


class TutorialCase:
    """The tutorial's copy in a folder; see movingTutorials.py."""

    def __init__(self, tutorial, source, folder):
        self.tutorial = tutorial
        self.folder = pathlib.Path(folder)
        origin = pathlib.Path(source) / tutorial.path
        top = origin.parent if tutorial.root else origin
        self.base = self.folder / "mesh"
        self.inner = origin.relative_to(top)
        scripts = sorted(top.glob("Allrun*")) if not tutorial.script else []
        if not scripts and not tutorial.script and not tutorial.root:
            # Folders beside it make its mesh
            above = origin.parent
            if (above / "Allrun").exists() and len(list(above.iterdir())) < 12:
                if any(
                    (above / "Allrun").read_text().count(c.name)
                    for c in [origin]
                ):
                    top = above
                    self.inner = origin.relative_to(top)
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(top, self.base, symlinks=False)
        self.case = self.base / self.inner

    # Making it

    def prepare(self):
        """The mesh and the fields of time 0."""
        self._control()
        self._coarsen()
        for file, pattern, replacement in self.tutorial.edits:
            path = self.base / file
            text, n = re.subn(
                pattern, replacement, path.read_text(), flags=re.S
            )
            assert n, f"{path} has no {pattern}"
            path.write_text(text)
        self._make()
        wanted = self.case / "constant" / self.tutorial.dict
        if self.tutorial.dict != "dynamicMeshDict":
            shutil.copy(wanted, self.case / "constant/dynamicMeshDict")

    def _control(self):
        for path in self.base.rglob("system/controlDict*"):
            text = path.read_text()
            path.write_text(
                text
                + "\n#remove functions\nwriteFormat ascii;\n"
                + "writeCompression off;\n"
            )
        path = self.case / "system/controlDict"
        text = path.read_text()

        def number(key):
            found = re.findall(rf"^\s*{key}\s+([^;]+);", text, re.M)
            return float(found[-1]) if found else 0

        step = self.tutorial.deltaT or (
            number("deltaT") if self.tutorial.own else number("endTime") / 200
        )
        self.deltaT = step
        n = self.tutorial.steps
        path.write_text(
            text + f"startFrom startTime; startTime 0; stopAt endTime;\n"
            f"deltaT {step!r}; endTime {n * step!r};\n"
            f"adjustTimeStep no; writeControl timeStep;\n"
            f"writeInterval {max(1, n // 2)}; purgeWrite 0;\n"
            "writePrecision 17; timePrecision 12; runTimeModifiable no;\n"
            + self.tutorial.libs
        )
        self.application = re.findall(r"^\s*application\s+(\w+)", text, re.M)[
            -1
        ]

    def _coarsen(self):
        tutorial = self.tutorial

        def fewer(match):
            n = [
                str(max(1, round(int(x) * tutorial.scale)))
                if int(x) > 1
                else x
                for x in (match[2] or match[3]).split()
            ]
            text = " ".join(n)
            return match[1] + (f"({text})" if match[2] else text)

        def lower(match):
            return re.sub(
                r"\d+",
                lambda d: str(max(0, int(d[0]) - tutorial.levels)),
                match[0],
            )

        for path in self.base.rglob("system/blockMeshDict*"):
            if tutorial.scale != 1:
                text = path.read_text()
                for pattern in (
                    r"(hex\s*\([^)]*\)\s*\w*\s*)"
                    r"\(\s*(\d+\s+\d+\s+\d+)\s*(\))",
                    # Numbers that m4 or macros put there
                    r"(define\(N\w*,\s*)()(\d+)",
                    r"(^n[RZ]\s+)()(\d+)",
                ):
                    text = re.sub(pattern, fewer, text, flags=re.M)
                path.write_text(text)
        for path in self.base.rglob("system/snappyHexMeshDict*"):
            if tutorial.levels:
                text = re.sub(
                    r"\blevel\s+(\d+|\(\s*\d+\s+\d+\s*\))",
                    lower,
                    path.read_text(),
                )
                text = re.sub(
                    r"(levels\s*\(\(\s*\S+\s+)(\d+)",
                    lambda m: m[1] + str(max(0, int(m[2]) - tutorial.levels)),
                    text,
                )
                path.write_text(text)

    def _make(self):
        for path in self.base.rglob("*"):
            if path.is_file() and re.match(
                r"(Allrun|Allmesh|make)", path.name
            ):
                text = re.sub(
                    r"^\..*bin/tools/RunFunctions.*$",
                    f". {HERE / 'runFunctions'}",
                    path.read_text(),
                    flags=re.M,
                )
                text = re.sub(
                    r"^\..*bin/tools/CleanFunctions.*$", "", text, flags=re.M
                )
                path.write_text(text)
        script = self.tutorial.script or next(
            (
                name
                for name in ("Allrun.pre", "Allrun")
                if (self.base / name).exists()
            ),
            "",
        )
        if script:
            command = ["bash", "./" + pathlib.Path(script).name]
            folder = (self.base / script).parent
        else:
            command, folder = ["blockMesh"], self.case
        env = dict(environment(), PWD=str(folder))
        for packed in self.base.rglob("files/*.gz"):
            subprocess.run(["gunzip", "-k", packed], check=True)
        env["FOAM_USER_APPBIN"] = str(self.folder / "bin")
        env["PATH"] = f"{self.folder / 'bin'}:{env['PATH']}"
        (self.folder / "bin").mkdir()
        done = subprocess.run(
            command,
            cwd=folder,
            env=env,
            timeout=TIMEOUT,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        log = done.stdout.decode(errors="replace")
        (self.folder / "log.mesh").write_text(log)
        mesh = self.case / "constant/polyMesh"
        if not (mesh / "points").exists() or "nCells:1 " in (
            mesh / "owner"
        ).read_text(errors="replace"):
            raise RuntimeError("no mesh: " + first_error(log))
        if "FAILED:" in log:
            raise RuntimeError(
                "its mesh failed: " + re.findall("FAILED: (.*)", log)[0]
            )
        if not (self.case / "0").exists() and (self.case / "0.orig").exists():
            shutil.copytree(self.case / "0.orig", self.case / "0")

    # Running it

    def run(self, name, dictionary=None):
        """A run of a copy, with another dynamicMeshDict if one is given."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.case, folder)
        if dictionary is not None:
            (folder / "constant/dynamicMeshDict").write_text(dictionary)
        program = self.application if self.tutorial.own else "moveDynamicMesh"
        beside = (
            subprocess.Popen(
                self.tutorial.beside.split(),
                cwd=folder,
                env=dict(environment(), PWD=str(folder)),
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            if self.tutorial.beside
            else None
        )
        with open(folder / "log.run", "wb") as log:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            try:
                status = subprocess.run(
                    [program],
                    cwd=folder,
                    env=run_environment(folder),
                    timeout=TIMEOUT,
                    stdout=log,
                    stderr=subprocess.STDOUT,
                ).returncode
            except subprocess.TimeoutExpired:
                status = -1
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
        if beside:
            beside.terminate()
            beside.wait()
        result = Run(folder, status, self.tutorial.steps)
        result.cpu = after.ru_utime - before.ru_utime
        return result

    @property
    def dictionary(self):
        return (self.case / "constant/dynamicMeshDict").read_text()

    def others(self):
        """Patches of no constraint type that are not of a body."""
        text = (self.case / "constant/polyMesh/boundary").read_text()
        return [
            name
            for name, kind in re.findall(
                r"\n\s*([^\s{}()]+)\s*\{\s*type\s+(\w+);", text
            )
            if kind in ("patch", "wall") and name not in self.tutorial.bodies
        ]

    def two_lines(self, coefficients=""):
        """The dictionary with the two lines of the README changed, and
        coefficients at its end."""
        text = self.dictionary
        found = re.search(
            rf"^([ \t]*)(motionSolver|solver)([ \t]+){self.tutorial.solver};",
            text,
            re.M,
        )
        assert found, "no line selects a motion solver"
        # The library's line is in the same dictionary
        start = text.rfind("{", 0, found.start()) if found[1] else 0
        libs = r"^[ \t]*motionSolverLibs\s*\([^)]*\);\n?"
        head = re.sub(libs, "", text[start : found.start()], flags=re.M)
        rest = text[found.end() :]
        end = rest.find("}") if found[1] else len(rest)
        rest = re.sub(libs, "", rest[:end], flags=re.M) + rest[end:]
        line = (
            f"{found[1]}motionSolverLibs (morphMotionSolvers);\n"
            f"{found[1]}{found[2]}{found[3]}rbfMotionSolver;"
        )
        if coefficients:
            line += f"\nrbfMotionSolverCoeffs\n{{\n{coefficients}\n}}\n"
        return text[:start] + head + line + rest


def first_error(log):
    """The message that ended a run: without where in the source."""
    found = re.search(
        r"--> FOAM FATAL.*?:\s*\n(.*?)(?:\n\s*(?:From|file:) |\Z)", log, re.S
    )
    if found:
        return found[1].strip()
    signal = re.search(r"sigFpe|sigSegv|terminate called", log)
    if signal:
        return "signal: " + signal[0]
    return "\n".join(log.strip().splitlines()[-2:]) or "no word"


def warnings(log):
    """Of ours: what warns about the motion of the mesh."""
    found = re.findall(r"--> FOAM Warning :(.*?)(?=\n\n|\Z)", log, re.S)
    return [text for text in found if "otion" in text or "mesh" in text]


class Run:
    """What came of it."""

    def __init__(self, folder, status, steps):
        self.folder = folder
        self.status = status
        self.steps = steps
        self.log = (folder / "log.run").read_text(errors="replace")

    @property
    def good(self):
        return self.status == 0

    @property
    def message(self):
        return "time limit" if self.status == -1 else first_error(self.log)

    def times(self):
        """The folders of times after the start."""
        found = []
        for path in self.folder.iterdir():
            if re.fullmatch(r"[0-9.e+-]+", path.name) and float(path.name) > 0:
                found.append(path)
        return sorted(found, key=lambda path: float(path.name))

    def points(self, time=None):
        file = "polyMesh/points"
        moved = time is not None and (time / file).exists()
        return read_vectors(
            (time if moved else self.folder / "constant") / file
        )

    def conditions(self, field):
        """The types of the field's conditions at the end, by patch."""
        path = (self.times() or [self.folder / "0"])[-1] / field
        if not path.exists():
            return {}
        text = path.read_text().split("boundaryField", 1)[1]
        return {
            name: kind
            for name, kind in re.findall(
                r"\n    \"?([^\s\"{]+)\"?\s*\{\s*(?:patchType\s+\w+;\s*)?"
                r"type\s+(\w+);",
                text,
            )
        }

    def motion_seconds(self):
        """CPU seconds of the motion in each step."""
        path = self.folder / "motionClock"
        if not path.exists():
            return np.zeros(0)
        calls = np.array(
            [float(line) for line in path.read_text().splitlines()]
        )
        n = len(calls) // self.steps
        return calls[: n * self.steps].reshape(self.steps, -1).sum(axis=1)

    def quality(self):
        """Of the last mesh: largest non-orthogonality and skewness."""
        log = subprocess.run(
            ["checkMesh", "-latestTime", "-noTopology"],
            cwd=self.folder,
            env=dict(environment(), PWD=str(self.folder)),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        ).stdout.decode(errors="replace")
        angle = re.findall(r"non-orthogonality Max: ([\d.e+-]+)", log)
        skewness = re.findall(r"[Mm]ax skewness = ([\d.e+-]+)", log)
        return [float(x[-1]) if x else float("nan") for x in (angle, skewness)]


class Mesh:
    """Patches and unconnected parts of a run's mesh, as sets of points."""

    def __init__(self, folder):
        mesh = pathlib.Path(folder) / "constant/polyMesh"
        text = (mesh / "faces").read_text()
        body = text[text.index("\n(") :]
        sizes, labels = [], []
        for n, points in re.findall(r"(\d+)\(([\d\s]+)\)", body):
            sizes.append(int(n))
            labels.append(points)
        self.start = np.concatenate([[0], np.cumsum(sizes)])
        self.labels = np.array(" ".join(labels).split(), dtype=int)
        self.patches = {}
        boundary = (mesh / "boundary").read_text()
        for name, entries in re.findall(
            r"\n\s*([^\s{}()]+)\s*\{([^}]*)\}", boundary.split("\n(", 1)[1]
        ):
            n = int(re.search(r"nFaces\s+(\d+)", entries)[1])
            first = int(re.search(r"startFace\s+(\d+)", entries)[1])
            self.patches[name] = np.unique(
                self.labels[self.start[first] : self.start[first + n]]
            )

    def parts(self, n):
        """The number of the part that each of n points is in."""
        following = np.arange(1, len(self.labels) + 1)
        following[self.start[1:] - 1] = self.start[:-1]
        edges = coo_matrix(
            (
                np.ones(len(self.labels)),
                (self.labels, self.labels[following]),
            ),
            shape=(n, n),
        )
        return connected_components(edges, directed=False)[1]
