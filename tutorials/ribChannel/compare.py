"""Morphed restarts beside uniform starts on new meshes of the same designs.

    compare.py STUDY -> results/restart

Time is that of the processor, as the solver's log has it: what else runs on
the machine hardly touches it.
"""

import csv
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "scripts"))
from foamOutput import writeTable  # noqa: E402


def results(study, strategy):
    with (Path(study)/f"results.{strategy}.csv").open() as file:
        return {row["design"]: row for row in csv.DictReader(file)
                if row["status"] == "done" and row["design"].isdigit()}


def seconds(study, strategy, design):
    log = (Path(study)/strategy/design/"log.solve").read_text()
    return float(re.findall(r"ExecutionTime = (\S+) s", log)[-1])


def quality(study, strategy, design):
    """Largest non-orthogonality [deg] and skewness, as checkMesh says."""
    log = (Path(study)/strategy/design/"log.quality").read_text()
    return (float(re.search(r"non-orthogonality Max: (\S+)", log)[1]),
            float(re.search(r"[Mm]ax skewness = ([\d.e+-]+)", log)[1]))


def differs(new, old):
    return 100*(float(new)/float(old) - 1)


def compare(study):
    morph, remesh = results(study, "morph"), results(study, "remesh")
    rows = []
    for design in sorted(set(morph) & set(remesh)):
        a, b = morph[design], remesh[design]
        here, there = (quality(study, name, design)
                       for name in ("morph", "remesh"))
        rows.append({
            "design": design, **{x: float(a[x]) for x in ("h", "e", "E")},
            "iterations": int(a["iterations"]),
            "uniform": int(b["iterations"]),
            "time [s]": seconds(study, "morph", design),
            "uniform [s]": seconds(study, "remesh", design),
            "Nu": float(a["Nu"]), "Nu differs [%]": differs(a["Nu"], b["Nu"]),
            "Cf": float(a["Cf"]), "Cf differs [%]": differs(a["Cf"], b["Cf"]),
            "non-orth. [deg]": here[0], "remeshed [deg]": there[0],
            "skewness": here[1], "remeshed": there[1],
        })
    if not rows:
        sys.exit("Error: no design is done in both ways")
    mean = {name: sum(row[name] for row in rows)/len(rows)
            for name in list(rows[0])[4:]}
    for name in ("Nu differs [%]", "Cf differs [%]"):
        mean[name] = sum(abs(row[name]) for row in rows)/len(rows)
    rows.append({"design": "mean", "h": "", "e": "", "E": "", **mean})
    return rows


if __name__ == "__main__":
    writeTable(compare(sys.argv[1]), "results/restart")
