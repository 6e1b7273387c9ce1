"""Heave and pitch of the wing on its springs with our motion solver and
OpenFOAM's, at the times of the latter (results/trajectory.csv and .md)."""

import math
import re
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "scripts"))
from foamOutput import writeTable  # noqa: E402

number = r"([-+.\deE]+)"
step = re.compile(
    rf"^Time = {number}$|^    Centre of rotation: \({number} {number} {number}\)"
    rf"|^    Orientation: \({number} {number} ", re.MULTILINE)


def trajectory(name):
    """Times, heave [m] and pitch [deg] at the end of each step."""
    times, heave, pitch = [], [], []
    log = (here / "runs" / name / "log.pimpleFoam").read_text()
    for time, _, y, _, xx, xy in (f.groups() for f in step.finditer(log)):
        if time:
            times.append(float(time))
            heave.append(math.nan)
            pitch.append(math.nan)
        elif not times:
            continue
        elif y:
            heave[-1] = float(y) - 0.007
        else:
            pitch[-1] = math.degrees(math.atan2(float(xy), float(xx)))
    return times, heave, [angle - pitch[0] for angle in pitch]


def at(time, times, values):
    after = next(i for i, t in enumerate(times) if t >= time - 1e-9)
    if after == 0:
        return values[0]
    part = (time - times[after - 1]) / (times[after] - times[after - 1])
    return values[after - 1] + part * (values[after] - values[after - 1])


def row(label, ours, reference, times):
    a = [at(t, ours[0], ours[1]) for t in times]
    b = [at(t, reference[0], reference[1]) for t in times]
    largest = max(map(abs, b))
    return {
        "motion": label,
        "largest, rbf": max(map(abs, a)),
        "largest, sixDoF": largest,
        "largest difference, of that": max(
            abs(x - y) for x, y in zip(a, b)) / largest,
    }


ours, reference = trajectory("rbf"), trajectory("sixDoF")
end = min(ours[0][-1], reference[0][-1])
times = [t for t in reference[0] if t <= end]
writeTable(
    [row("heave [m]", ours[:2], reference[:2], times),
     row("pitch [deg]", ours[::2], reference[::2], times)],
    here / "results/trajectory")
