# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Displacements of type rigidBody: OpenFOAM's rigid bodies with joints move a
group, and a restart continues them.

Source of truth: the equations of motion of a physical pendulum and of a double
pendulum as textbooks derive them from the Lagrangian (Landau and Lifshitz,
Mechanics, 1976, sections 5 and 44), integrated here by the leapfrog method, as
OpenFOAM's symplectic solver does; the exact period by an elliptic integral; and
OpenFOAM's own motion solver rigidBodyMotion.
"""

import re

import numpy as np
import pytest
from scipy.special import ellipk

from rbfCase import (
    groups,
    points_at,
    rbf_case,
    reference,
    restart_from,
    side,
)

G = 9.81
DT = 0.02
STEPS = 20
CONTROL = dict(end=STEPS * DT, deltaT=DT, writeInterval=STEPS // 2)

# An arm that hangs from a hinge in the middle of zMax, another one below it
M1, D1, I1, LENGTH = 2.0, 0.3, 0.05, 0.5
M2, D2, I2 = 1.5, 0.2, 0.03
START = (0.4, -0.7)


def arm(parent, at, mass, distance, inertia, patches, joint="type Ry;"):
    return f"""
    type rigidBody; parent {parent}; mass {mass};
    centreOfMass (0 0 {-distance}); inertia (0.01 0 0 {inertia} 0 0.02);
    transform (1 0 0 0 1 0 0 0 1) ({at}); joint {{ {joint} }}
    {f"patches ({patches});" if patches else ""}
    """


UPPER = arm("root", "0.5 0.5 1", M1, D1, I1, "zMax")
LOWER = arm("upper", f"0 0 {-LENGTH}", M2, D2, I2, "zMin")


def bodies(rest="", solver="symplectic", q=None, **arms):
    return (
        f"type rigidBody; test true; g (0 0 {-G}); "
        f"solver {{ type {solver}; }} bodies {{ "
        + " ".join(f"{name} {{ {arm} }}" for name, arm in arms.items())
        + " } "
        + (f"q ({' '.join(map(repr, q))});" if q else "")
        + rest
    )


def moved(displacement, patches="zMax zMin", **others):
    return "supportRadius 2; onInvalidMesh ignore;\n" + groups(
        robot=f"type moving; patches ({patches});"
        f"displacement {{ {displacement} }}",
        **others,
    )


def single(rest="", q=(0.4,), **solver):
    return bodies(rest, q=q, upper=UPPER, **solver)


def double(rest="", q=START, **solver):
    return bodies(rest, q=q, upper=UPPER, lower=LOWER, **solver)


def state(case, time, group="robot"):
    """Positions and velocities of the joints."""
    text = (case.path / time / "uniform" / f"rigidBody.{group}").read_text()
    return [
        np.array(re.search(rf"{key}\s*\((.*?)\)", text)[1].split(), float)
        for key in ("q", "qDot")
    ]


def leapfrog(acceleration, q, steps, dt=DT):
    """The state after each step of one that starts at rest, and without an
    acceleration, as a new body does."""
    q, v = np.array(q, float), np.zeros(len(q))
    a = np.zeros(len(q))
    states = []
    for _ in range(steps):
        v = v + 0.5 * dt * a
        q = q + dt * v
        a = acceleration(q, v)
        v = v + 0.5 * dt * a
        states.append((q, v))
    return states


def pendulum(q, _):
    return -M1 * G * D1 / (I1 + M1 * D1**2) * np.sin(q)


A = I1 + M1 * D1**2 + M2 * LENGTH**2
B = M2 * LENGTH * D2
C = I2 + M2 * D2**2


def double_pendulum(q, v):
    """In the angles of the joints: the lower one is measured from the arm."""
    t1, t2 = q[0], q[0] + q[1]
    w1, w2 = v[0], v[0] + v[1]
    c, s = np.cos(t1 - t2), np.sin(t1 - t2)
    a1, a2 = np.linalg.solve(
        [[A, B * c], [B * c, C]],
        [
            -B * s * w2**2 - (M1 * D1 + M2 * LENGTH) * G * np.sin(t1),
            B * s * w1**2 - M2 * G * D2 * np.sin(t2),
        ],
    )
    return np.array([a1, a2 - a1])


def energy(q, v):
    t1, t2 = q[0], q[0] + q[1]
    w1, w2 = v[0], v[0] + v[1]
    return (
        0.5 * A * w1**2
        + 0.5 * C * w2**2
        + B * np.cos(t1 - t2) * w1 * w2
        - (M1 * D1 + M2 * LENGTH) * G * np.cos(t1)
        - M2 * G * D2 * np.cos(t2)
    )


def turned(points, angle, about):
    """Points turned about the y axis through a point."""
    c, s = np.cos(angle), np.sin(angle)
    return (points - about) @ np.array(
        [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    ).T + about


@pytest.mark.parametrize("ranks", [1, 3])
def test_a_double_pendulum_swings_as_its_lagrangian_says(tmp_path, ranks):
    case = rbf_case(tmp_path, coeffs=moved(double()), control=CONTROL)
    before = reference(case)
    if ranks > 1:
        case.decompose((3, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    states = leapfrog(double_pendulum, START, STEPS)
    at = tmp_path if ranks == 1 else tmp_path / "processor0"
    for n in (STEPS // 2, STEPS):
        q, v = states[n - 1]
        text = (at / f"{n*DT:g}/uniform/rigidBody.robot").read_text()
        read = re.search(r"q\s*\((.*?)\)", text)[1].split()
        np.testing.assert_allclose(
            np.array(read, float), q, rtol=0, atol=1e-12
        )
        after = points_at(case, f"{n*DT:g}")
        hinge = np.array([0.5, 0.5, 1])
        upper = side(before, "zMax")
        np.testing.assert_allclose(
            after[upper],
            turned(before[upper], q[0], hinge),
            rtol=0,
            atol=1e-12,
        )
        knee = hinge - [0, 0, LENGTH]
        lower = side(before, "zMin")
        np.testing.assert_allclose(
            after[lower],
            turned(turned(before[lower], q[1], knee), q[0], hinge),
            rtol=0,
            atol=1e-12,
        )


@pytest.mark.parametrize(
    "solver, inner, order", [("Newmark", 10, 2), ("symplectic", 1, 1)]
)
def test_a_double_pendulum_keeps_its_energy(tmp_path, solver, inner, order):
    """To the order of the scheme in the time step. OpenFOAM's symplectic solver
    takes centrifugal forces at the middle of the step, which is first order.
    """
    errors = []
    start = double_pendulum(np.array(START), np.zeros(2))
    for dt in (0.01, 0.005):
        case = rbf_case(
            tmp_path / f"{dt}",
            coeffs=moved(
                double(
                    f"nIter {inner}; qDdot ({start[0]!r} {start[1]!r});",
                    solver=solver,
                )
            ),
            control=dict(end=0.8, deltaT=dt, writeInterval=round(0.1 / dt)),
        )
        case.run("moveDynamicMesh")
        energies = [
            energy(*state(case, f"{time:g}"))
            for time in np.arange(0.1, 0.85, 0.1)
        ]
        first = energy(START, (0, 0))
        errors.append(np.abs(np.array(energies) - first).max() / abs(first))
    assert errors[0] < 4e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.2)


@pytest.mark.parametrize("solver, inner", [("symplectic", 1), ("Newmark", 8)])
def test_a_pendulum_has_its_period(tmp_path, solver, inner):
    """Where it starts after one period, to second order in the time step."""
    amplitude = 0.4
    small = np.sqrt((I1 + M1 * D1**2) / (M1 * G * D1))
    period = 4 * small * ellipk(np.sin(amplitude / 2) ** 2)
    steps = 100
    first = pendulum(np.array([amplitude]), None)[0]
    case = rbf_case(
        tmp_path,
        coeffs=moved(
            single(f"qDdot ({first!r}); nIter {inner};", solver=solver),
            patches="zMax",
            bottom="type fixed; patches (zMin);",
        ),
        control=dict(
            end=period, deltaT=period / steps, writeInterval=steps // 4
        ),
    )
    case.run("moveDynamicMesh")
    last = max(
        (p for p in tmp_path.iterdir() if re.match(r"[\d.]+$", p.name)),
        key=lambda p: float(p.name),
    )
    (q,), (v,) = state(case, last.name)
    phase = np.arctan2(v * small, q)
    assert abs(phase) < 2 * np.pi / steps
    assert q == pytest.approx(amplitude, rel=2e-3)


def test_a_ramp_multiplies_gravity(tmp_path):
    """Source of truth: the equation of the pendulum, gravity times the ramp;
    a damping of the acceleration multiplies it likewise."""
    for name, rest, factor in (
        ("ramp", f"ramp polynomial (({1/(STEPS*DT)!r} 1));", None),
        ("damping", "accelerationDamping 0.5;", 0.5),
    ):
        case = rbf_case(
            tmp_path / name,
            control=CONTROL,
            coeffs=moved(single(rest), "zMax"),
        )
        case.run("moveDynamicMesh")
        n = [0]

        def acceleration(q, v):
            n[0] += 1
            return pendulum(q, v) * (factor or n[0] / STEPS)

        q, v = leapfrog(acceleration, (0.4,), STEPS)[-1]
        found = state(case, f"{STEPS*DT:g}")
        assert abs(q[0] - 0.4) > 0.01
        assert found[0] == pytest.approx(q, abs=1e-9)
        assert found[1] == pytest.approx(v, abs=1e-9)


def test_what_is_merged_is_one_body(tmp_path):
    """A pendulum of two halves, one merged with the other, against the single
    one of their sum."""
    whole = rbf_case(
        tmp_path / "whole",
        coeffs=moved(bodies(q=(0.4,), upper=UPPER), patches="zMax"),
        control=CONTROL,
    )
    halves = rbf_case(
        tmp_path / "halves",
        coeffs=moved(
            bodies(
                q=(0.4,),
                upper=arm("root", "0.5 0.5 1", M1 / 2, D1, I1 / 2, "zMax"),
                other=f"type rigidBody; mergeWith upper; mass {M1/2}; "
                f"centreOfMass (0 0 {-D1}); inertia (0.01 0 0 {I1/2} 0 0.02);"
                "transform (1 0 0 0 1 0 0 0 1) (0 0 0); patches (zMin);",
            )
        ),
        control=CONTROL,
    )
    for case in (whole, halves):
        case.run("moveDynamicMesh")
    end = f"{STEPS*DT:g}"
    q = state(whole, end)[0]
    np.testing.assert_allclose(state(halves, end)[0], q, rtol=0, atol=1e-12)
    before = reference(halves)
    lower = side(before, "zMin")
    np.testing.assert_allclose(
        points_at(halves, end)[lower],
        turned(before[lower], q[0], np.array([0.5, 0.5, 1])),
        rtol=0,
        atol=1e-12,
    )


DISTANCES = "innerDistance 0.1; outerDistance 0.3; "

# Of all kinds of joints that OpenFOAM has in its tutorials, with restraints
SPRINGS = """
accelerationRelaxation 0.7; nIter 2;
restraints
{
    spring { type linearSpring; body lower; anchor (0.6 0.5 0); damping 0.3;
        refAttachmentPt (0 0 -0.5); stiffness 40; restLength 0.1; }
    damper { type sphericalAngularDamper; body upper; coeff 0.2; }
}
"""
COMPOSITE = "type composite; joints ( { type Py; } { type Ry; } );"


def test_bodies_move_as_by_rigidBodyMotion(tmp_path):
    """OpenFOAM's own solver, with the same dictionary."""
    dictionary = bodies(
        SPRINGS,
        solver="Newmark",
        upper=arm("root", "0.5 0.5 1", M1, D1, I1, "zMax", COMPOSITE)
        + DISTANCES,
        lower=LOWER + DISTANCES,
        q=(0, 0.1, -0.2),
    )
    ours = rbf_case(
        tmp_path / "ours",
        coeffs=moved("type rigidBody; $:rigidBodyMotionCoeffs;"),
        extra=f"rigidBodyMotionCoeffs {{ {dictionary} }}",
        control=CONTROL,
    )
    output = ours.run("moveDynamicMesh")
    assert "Nothing reads the entries" not in output

    theirs = rbf_case(
        tmp_path / "theirs", {'".*"': "calculated"}, control=CONTROL
    )
    theirs.write(
        "constant/dynamicMeshDict",
        "dictionary",
        "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs "
        "(rigidBodyMeshMotion); motionSolver rigidBodyMotion; "
        f"rigidBodyMotionCoeffs {{ {dictionary} }}",
    )
    theirs.run("moveDynamicMesh")
    before = reference(ours)
    body = side(before, "zMax") | side(before, "zMin")
    end = f"{STEPS*DT:g}"
    expected = points_at(theirs, end)[body]
    assert np.abs(expected - before[body]).max() > 0.02
    np.testing.assert_allclose(
        points_at(ours, end)[body], expected, rtol=0, atol=1e-12
    )


@pytest.mark.parametrize("ranks, restart_ranks", [(1, 1), (2, 3)])
@pytest.mark.parametrize("solver", ["Newmark", "symplectic"])
def test_a_restart_continues_to_the_last_bit(
    tmp_path, solver, ranks, restart_ranks
):
    """Source of truth: the run that is not interrupted."""
    half, end = (f"{n*DT:g}" for n in (STEPS // 2, STEPS))
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=moved(double(SPRINGS, solver=solver)),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    whole = points_at(case, end)
    assert np.abs(points_at(case, half) - whole).max() > 0.01

    restart_from(case, half, end, CONTROL, ranks, restart_ranks)
    output = case.run("moveDynamicMesh", ranks=restart_ranks)
    assert "rigidBody.robot: continues" in output
    again = points_at(case, end)
    assert np.abs(again - before).max() > 0.01
    assert np.array_equal(again, whole)


def test_bodies_of_two_groups_move_each_by_itself(tmp_path):
    """Two pendulums of two models, beside a body of sixDoFRigidBody."""
    other = arm("root", "0.5 0.5 0", M1, D1, I1, "zMin")
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=moved(
            single(),
            patches="zMax",
            low="type moving; patches (zMin); displacement { "
            + bodies(q=(-0.2,), low=other)
            + "}",
            side="type moving; patches (xMin); displacement { type "
            "sixDoFRigidBody; test true; mass 1; centreOfMass (0 0.5 0.5); "
            "momentOfInertia (1 1 1); solver { type symplectic; } "
            "velocity (-0.1 0 0); }",
        ),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    end = f"{STEPS*DT:g}"
    after = points_at(case, end)
    for name, start, height in (("zMax", 0.4, 1), ("zMin", -0.2, 0)):
        (q,), _ = leapfrog(pendulum, (start,), STEPS)[-1]
        on = side(before, name)
        np.testing.assert_allclose(
            after[on],
            turned(before[on], q, np.array([0.5, 0.5, height])),
            rtol=0,
            atol=1e-12,
        )
    on = side(before, "xMin") & ~side(before, "zMin") & ~side(before, "zMax")
    np.testing.assert_allclose(
        after[on] - before[on],
        np.tile([-0.1 * STEPS * DT, 0, 0], (on.sum(), 1)),
        rtol=0,
        atol=1e-12,
    )


def test_a_group_may_follow_one_of_the_bodies(tmp_path):
    """Points that are on no patch of a body."""
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs="supportRadius 2; onInvalidMesh ignore;\n"
        + groups(
            knee="type moving; points ((0.5 0.5 0.5)); displacement { "
            + double("body lower;")
            + "}",
        ),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    (q1, _), _ = leapfrog(double_pendulum, START, STEPS)[-1]
    at = np.abs(before - 0.5).max(axis=1) < 1e-9
    assert at.sum() == 1
    np.testing.assert_allclose(
        points_at(case, f"{STEPS*DT:g}")[at],
        turned(before[at], q1, np.array([0.5, 0.5, 1])),
        rtol=0,
        atol=1e-12,
    )


LOOP = arm("lower", "0 0 0", M1, D1, I1, "zMax")


@pytest.mark.parametrize(
    "coeffs, message",
    [
        (
            moved(bodies(upper=LOOP, lower=LOWER)),
            "The joints of body 'upper' close a loop: (upper lower upper)",
        ),
        (
            moved(bodies(upper=UPPER.replace("root", "(root lower)"))),
            "Entry 'parent' has to be the name of one body",
        ),
        (
            moved(bodies(upper=UPPER.replace("root", "mast"))),
            "Body 'upper' is joined to 'mast', which is no body",
        ),
        (
            moved(bodies(lower=LOWER, upper=UPPER)),
            "Body 'lower' comes before 'upper', which it is joined to",
        ),
        (
            moved(bodies(upper=UPPER.replace("mass 2.0", "mass 0"))),
            "Entry 'mass' is 0 but has to be a positive",
        ),
        (
            moved(bodies(upper=UPPER.replace("mass 2.0;", ""))),
            "Body 'upper' needs the entry 'mass'",
        ),
        (
            moved(
                bodies(
                    upper=UPPER.replace("rigidBody", "masslessBody"),
                )
            ),
            "Body 'upper' has no mass, and nothing that has",
        ),
        (
            moved(
                bodies(
                    upper=UPPER.replace("0.05", "0").replace("-0.3", "0"),
                )
            ),
            "No mass resists the joint of body 'upper'",
        ),
        (
            moved(bodies(upper=UPPER.replace("0.05", "-1"))),
            "Entry 'inertia' is (0.01 0 0 -1 0 0.02), of which a principal",
        ),
        (
            moved(bodies(upper=UPPER.replace("joint", "hinge"))),
            "Body 'upper' needs the dictionary 'joint'",
        ),
        (
            moved(bodies(upper=UPPER.replace("Ry", "hinge"))),
            "Unknown joint type hinge",
        ),
        (
            moved(bodies(upper=UPPER, lower=LOWER.replace("zMin", "zMax"))),
            "Patch 'zMax' belongs to two bodies",
        ),
        (
            moved(
                single(),
                patches="zMax",
                low="type moving; patches (zMin); displacement { "
                + bodies(other=arm("root", "0 0 0", 1, 1, 1, '"z.*"'))
                + "}",
            ),
            "Patch 'zMax' belongs to two bodies",
        ),
        (
            moved(
                single(),
                patches="zMax",
                low="type moving; patches (zMin); displacement { type "
                "sixDoFRigidBody; test true; mass 1; centreOfMass (0 0 0); "
                "momentOfInertia (1 1 1); solver { type symplectic; } "
                "patches (zMax); }",
            ),
            "Patch 'zMax' belongs to two bodies",
        ),
        (
            moved(double(), patches="zMax zMin xMin"),
            "Patch 'xMin' of the group belongs to no body",
        ),
        (
            moved(double(), patches="zMax"),
            "Patch 'zMin' of a body is not in the group",
        ),
        (
            moved(double("body middle;")),
            "Entry 'body' is 'middle', which is no body",
        ),
        (
            moved(double(q=(0.1,))),
            "same size as the number of DoF 2",
        ),
        (
            moved(double(SPRINGS.replace("body lower", "body knee"))),
            "Restraint 'spring' holds 'knee', which is no body",
        ),
        (
            moved("type rigidBody; test true; solver { type Newmark; }"),
            "needs the dictionary 'bodies'",
        ),
    ],
)
@pytest.mark.parametrize("ranks", [1, 2])
def test_what_cannot_be_joined_is_an_error(tmp_path, coeffs, message, ranks):
    case = rbf_case(tmp_path, coeffs=coeffs)
    if ranks > 1:
        case.decompose((2, 1, 1))
    files = case.tree_without_reports()
    output = case.run("moveDynamicMesh", status=1, ranks=ranks)
    assert message in re.sub(r"\s*\n\[?\d?\]?\s*", " ", output)
    assert "FOAM FATAL IO ERROR" in output
    assert case.tree_without_reports() == files


def test_a_condition_for_a_body_beside_the_group_is_an_error(tmp_path):
    """One body of two solvers."""
    case = rbf_case(
        tmp_path,
        coeffs=moved(single(), patches="zMax"),
        conditions={
            "zMax": "sixDoFRigidBodyDisplacement; mass 1; centreOfMass (0 0 0);"
            "momentOfInertia (1 1 1); solver { type Newmark; } "
            "value uniform (0 0 0);",
            '"(x|y).*|zMin"': "calculated",
        },
    )
    output = case.run("moveDynamicMesh", status=1)
    assert "Two solvers would move one body" in output


def test_entries_that_nothing_reads_are_named(tmp_path):
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=moved(double("Lx 0.3;")),
    )
    output = case.run("moveDynamicMesh")
    assert "Nothing reads the entries" in output and "Lx" in output
