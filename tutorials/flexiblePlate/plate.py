# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""plate.py: the elastic bottom of the basin, beside the flow. It answers the
pressures that OpenFOAM's function object externalCoupled writes into comms with
displacements, until the flow ends.

An Euler-Bernoulli beam of Hermite elements, one for each face, in time by
Newmark's method (average acceleration); its ends slide along the sides and do
not turn. Flow and plate of a time step converge by a quasi-Newton method with
least squares (IQN-ILS, Degroote, Bathe and Vierendeels, 2009,
doi:10.1016/j.compstruc.2008.11.013). After the last exchange of a step all that
a restart needs is in plate/<time>.npz; the history is plate/history.csv.
"""

import pathlib
import re
import sys
import time

import numpy as np

LENGTH, WIDTH, DEPTH = 1.0, 0.1, 1.0
DENSITY = 1000.0  # of the fluid [kg/m3]
MASS = 300.0  # of the plate [kg/m2]
STIFFNESS = 250.0  # bending, per width [N m]
EXCHANGES = 5  # nOuterCorrectors
DELTA_T = 0.025
PUSH = 40.0  # amplitude [Pa] of the load cos(pi x/L) that starts the motion
PUSHED = 0.5  # how long it lasts [s]

COMMS = pathlib.Path("comms")
LOCK = COMMS / "OpenFOAM.lock"
OUT, IN = COMMS / "plate/p.out", COMMS / "plate/cellDisplacement.in"
STATES = pathlib.Path("plate")


class Plate:
    """Nodal deflections and rotations u = (w0, t0, w1, t1, ...)."""

    def __init__(self, n):
        self.n = n
        h = LENGTH / n
        k = np.array(
            [
                [12, 6 * h, -12, 6 * h],
                [6 * h, 4 * h**2, -6 * h, 2 * h**2],
                [-12, -6 * h, 12, -6 * h],
                [6 * h, 2 * h**2, -6 * h, 4 * h**2],
            ]
        ) * (STIFFNESS * WIDTH / h**3)
        m = np.array(
            [
                [156, 22 * h, 54, -13 * h],
                [22 * h, 4 * h**2, 13 * h, -3 * h**2],
                [54, 13 * h, 156, -22 * h],
                [-13 * h, -3 * h**2, -22 * h, 4 * h**2],
            ]
        ) * (MASS * WIDTH * h / 420)
        size = 2 * (n + 1)
        self.stiffness = np.zeros((size, size))
        self.mass = np.zeros((size, size))
        # Deflections in the middle of elements, where the flow wants them
        self.to_faces = np.zeros((n, size))
        for i in range(n):
            at = slice(2 * i, 2 * i + 4)
            self.stiffness[at, at] += k
            self.mass[at, at] += m
            self.to_faces[i, at] = 0.5, h / 8, 0.5, -h / 8
        self.free = np.delete(np.arange(size), (1, size - 1))
        x = (np.arange(n) + 0.5) * h
        self.shape = np.cos(np.pi * x / LENGTH)
        self.area = h * WIDTH

    def forces(self, pressures, now):
        """On the nodes: what faces do, through the transposed of what gives
        them their displacement, so that no work is lost between them."""
        push = PUSH * np.sin(np.pi * now / PUSHED) ** 2 * (now < PUSHED)
        flow = -DENSITY * pressures
        return self.area * self.to_faces.T @ flow, (
            self.area * self.to_faces.T @ (push * self.shape)
        )

    def step(self, state, load):
        """The state (u, v, a) one time step later under this load."""
        u, v, a = state
        f, dt = self.free, DELTA_T
        predicted = u + dt * v + dt**2 / 4 * a
        system = self.mass + dt**2 / 4 * self.stiffness
        new = np.zeros_like(a)
        new[f] = np.linalg.solve(
            system[np.ix_(f, f)], (load - self.stiffness @ predicted)[f]
        )
        return predicted + dt**2 / 4 * new, v + dt / 2 * (a + new), new


class QuasiNewton:
    """Displacements and residuals of this time step, and the differences of
    former ones."""

    def __init__(self):
        self.dx, self.dr = [], []
        self.former = None

    def next(self, x, r):
        if self.former is not None:
            self.dx.insert(0, x - self.former[0])
            self.dr.insert(0, r - self.former[1])
            del self.dx[12:], self.dr[12:]
        self.former = x, r
        if not self.dr:
            return x + 0.5 * r
        columns = np.array(self.dr).T
        scale = np.linalg.norm(columns, axis=0)
        keep = scale > 1e-13 * max(scale.max(), 1e-300)
        c, *_ = np.linalg.lstsq(columns[:, keep] / scale[keep], -r, rcond=1e-8)
        return (
            x
            + r
            + (np.array(self.dx).T + columns)[:, keep] @ (c / scale[keep])
        )

    def next_step(self):
        self.former = None


def numbers(path):
    rows = [
        line.split()
        for line in path.read_text().splitlines()
        if line.strip() and not line.startswith("#")
    ]
    return np.array(rows, float)


def order_of_faces():
    """Faces as the flow counts them, from one end of the plate to the other."""

    def entries(name):
        text = (COMMS / "plate" / name).read_text()
        return re.findall(r"\(([-+\d.e ]+)\)", text)

    x = [float(point.split()[0]) for point in entries("patchPoints")]
    centres = [
        np.mean([x[int(i)] for i in face.split()])
        for face in entries("patchFaces")
    ]
    return np.argsort(centres)


def my_turn():
    """Wait for pressures; False if the flow has ended."""
    while True:
        if LOCK.exists():
            try:
                if "done" in LOCK.read_text():
                    return False
            except FileNotFoundError:
                pass
        elif OUT.exists():
            return True
        time.sleep(0.005)


def main():
    STATES.mkdir(exist_ok=True)
    started = float(sys.argv[1]) if len(sys.argv) > 1 else 0
    history = open(STATES / "history.csv", "a")
    plate = newton = order = None
    while my_turn():
        if plate is None:
            order = order_of_faces()
            plate = Plate(len(order))
            size = 2 * (plate.n + 1)
            newton = QuasiNewton()
            state = former = tuple(np.zeros(size) for _ in range(3))
            x = np.zeros(plate.n)
            flow = np.zeros(size)
            largest, now, exchange = 0.0, started, EXCHANGES
            if started:
                saved = np.load(STATES / f"{started:g}.npz")
                former, state = saved["former"], saved["state"]
                newton.dx, newton.dr = list(saved["dx"]), list(saved["dr"])
                x, flow = saved["x"], saved["flow"]
                newton.former = saved["newton"]
                largest = float(saved["largest"])
        pressures = numbers(OUT)[order, 0]
        if exchange == EXCHANGES:
            if now:
                # Where flow and plate have come in the step that ends
                new, push = plate.forces(pressures, now)
                state = plate.step(former, new + push)
                r = plate.to_faces @ state[0] - x
                newton.next(x, r)
                newton.next_step()
                largest = max(largest, np.abs(state[0][::2]).max())
                work = (new + flow) / 2 @ (state[0] - former[0])
                amplitude = 2 * plate.shape @ (plate.to_faces @ state[0])
                residual = np.abs(r).max() / largest
                print(
                    f"{now:.6g},{amplitude/plate.n:.12e},{work:.12e},"
                    f"{residual:.3e}",
                    file=history,
                    flush=True,
                )
                print(f"Time {now:g}: residual {residual:.1e}", flush=True)
                flow = new
            former = state
            now = round(now + DELTA_T, 9)
            exchange = 0
            # As fast and as much faster as it was
            u = former[0] + DELTA_T * former[1] + DELTA_T**2 / 2 * former[2]
            x = plate.to_faces @ u
        else:
            new, push = plate.forces(pressures, now)
            state = plate.step(former, new + push)
            x = newton.next(x, plate.to_faces @ state[0] - x)
        exchange += 1
        if exchange == EXCHANGES:
            np.savez(
                STATES / f"{now:g}.npz",
                former=former,
                state=state,
                dx=newton.dx,
                dr=newton.dr,
                newton=newton.former,
                x=x,
                flow=flow,
                largest=largest,
            )
        answer = np.zeros((plate.n, 3))
        answer[order, 2] = x
        np.savetxt(IN, answer, fmt="%.17g")
        OUT.unlink()
        LOCK.write_text("status=plate\n")


main()
