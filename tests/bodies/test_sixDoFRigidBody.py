# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Displacements of type sixDoFRigidBody: OpenFOAM's rigid body moves a group,
and a restart continues it.

Source of truth: closed forms of its symplectic integrator (Dullweber, Leimkuhler
and McLachlan 1997), which in one coordinate is the leapfrog method. A mass on a
spring that starts at rest, a away from its equilibrium, has at step n

    x = a (1 - cos(n theta)),    sin(theta/2) = omega dt/2,

and the same holds for an angle with the moment of inertia about the axis.
"""


import numpy as np
import pytest

from rbfCase import (
    groups,
    points_at,
    rbf_case,
    reference,
    restart_from,
    side,
)

DT = 0.1
STEPS = 8
MASS = 2.0
STIFFNESS = 50.0
ANCHOR = np.array([0.03, -0.02, 0.05])
CENTRE = (0.5, 0.5, 1)

SPRING = f"""
restraints
{{
    spring
    {{
        sixDoFRigidBodyMotionRestraint linearSpring;
        anchor ({CENTRE[0] + ANCHOR[0]} {CENTRE[1] + ANCHOR[1]}
            {CENTRE[2] + ANCHOR[2]});
        refAttachmentPt (0.5 0.5 1);
        stiffness {STIFFNESS}; damping 0; restLength 0;
    }}
}}
"""

# The first half step needs the acceleration that the spring gives at the start
START = "acceleration ({} {} {});".format(*STIFFNESS / MASS * ANCHOR)


def body(entries=SPRING + START, mass=f"mass {MASS};", centre=CENTRE):
    return (
        "displacement { type sixDoFRigidBody; test true; "
        + mass
        + "centreOfMass ({} {} {});".format(*centre)
        + "momentOfInertia (1 1.5 2); solver { type symplectic; }"
        + entries
        + "}"
    )


def lid(displacement, bottom="type fixed; patches (zMin);"):
    return "supportRadius 2;\n" + groups(
        lid=f"type moving; patches (zMax); {displacement}", bottom=bottom
    )


CONTROL = dict(end=STEPS * DT, deltaT=DT, writeInterval=STEPS // 2)


def swing(n, omega, dt=DT):
    """1 - cos(n theta) of the leapfrog method."""
    return 1 - np.cos(n * 2 * np.arcsin(0.5 * omega * dt))


@pytest.mark.parametrize("ranks", [1, 3])
def test_a_mass_on_a_spring_swings_as_the_leapfrog_method_says(
    tmp_path, ranks
):
    case = rbf_case(tmp_path, coeffs=lid(body()), control=CONTROL)
    before = reference(case)
    if ranks > 1:
        case.decompose((3, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    on = side(before, "zMax")
    omega = np.sqrt(STIFFNESS / MASS)
    for n in (STEPS // 2, STEPS):
        d = (points_at(case, f"{n*DT:g}") - before)[on]
        expected = ANCHOR * swing(n, omega)
        assert np.abs(expected).max() > 0.02
        np.testing.assert_allclose(
            d, np.tile(expected, (len(d), 1)), rtol=0, atol=1e-13
        )


PENDULUM = """
constraints
{
    hinge { sixDoFRigidBodyMotionConstraint point; centreOfRotation (0.5 0.5 1); }
    axis { sixDoFRigidBodyMotionConstraint axis; axis (0 0 1); }
}
restraints
{
    spring
    {
        sixDoFRigidBodyMotionRestraint linearAxialAngularSpring;
        axis (0 0 1); stiffness 50; damping 0;
        referenceOrientation (%r %r 0 %r %r 0 0 0 1);
    }
}
torque (0 0 %r);
"""


def test_inertia_is_moved_to_the_centre_of_rotation_once(tmp_path):
    """The spring's angle is an acos, of some 8 digits near zero."""
    angle = 0.05
    c, s = float(np.cos(angle)), float(np.sin(angle))
    centre = (0.8, 0.5, 1)
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=lid(body(PENDULUM % (c, -s, s, c, 50 * angle), centre=centre)),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    inertia = 2 + MASS * 0.3**2
    turned = angle * swing(STEPS, np.sqrt(50 / inertia))
    on = side(before, "zMax")
    r = before[on] - CENTRE
    cos, sin = np.cos(turned), np.sin(turned)
    expected = (
        np.column_stack(
            [
                cos * r[:, 0] - sin * r[:, 1],
                sin * r[:, 0] + cos * r[:, 1],
                r[:, 2],
            ]
        )
        + CENTRE
    )
    assert np.abs(expected - before[on]).max() > 0.02
    np.testing.assert_allclose(
        points_at(case, f"{STEPS*DT:g}")[on], expected, rtol=0, atol=1e-7
    )


# Off its centre of mass, relaxed, in an ascii file of six digits
RESTARTS = (
    PENDULUM % (0.999, -0.04471, 0.04471, 0.999, 2)
    + "accelerationRelaxation 0.7;"
)


@pytest.mark.parametrize("ranks, restart_ranks", [(1, 1), (2, 3)])
def test_a_restart_continues_to_the_last_bit(tmp_path, ranks, restart_ranks):
    """Source of truth: the run that is not interrupted."""
    half, end = (f"{n*DT:g}" for n in (STEPS // 2, STEPS))
    case = rbf_case(
        tmp_path / "whole",
        control=CONTROL,
        coeffs=lid(body(RESTARTS, centre=(0.8, 0.5, 1))),
    )
    before = reference(case)
    if ranks > 1:
        case.decompose((ranks, 1, 1))
    case.run("moveDynamicMesh", ranks=ranks)
    whole = points_at(case, end)
    state = (
        (case.path / ("processor0" if ranks > 1 else ".")) / half / "uniform"
    )
    assert (state / "sixDoFRigidBody.lid").is_file()
    assert np.abs(points_at(case, half) - whole).max() > 0.01

    restart_from(case, half, end, CONTROL, ranks, restart_ranks)
    output = case.run("moveDynamicMesh", ranks=restart_ranks)
    assert "sixDoFRigidBody.lid: continues" in output
    again = points_at(case, end)
    assert np.abs(again - before).max() > 0.01
    assert np.array_equal(again, whole)


@pytest.mark.parametrize(
    "coeffs, message",
    [
        (lid(body(mass="")), "A sixDoFRigidBody needs the entry 'mass'"),
        (
            lid(body(mass="mass 0;")),
            "Entry 'mass' is 0 but has to be a positive",
        ),
        (
            lid(body().replace("(1 1.5 2)", "(1 0 2)")),
            "Entry 'momentOfInertia'",
        ),
        (
            lid(body("patches (hull);")),
            "Entry 'patches': nothing is called 'hull'",
        ),
        (
            lid(
                body("patches (xMin zMax);"),
                f"type moving; patches (zMin); {body('patches (zMax);')}",
            ),
            "Patch 'zMax' belongs to two bodies",
        ),
    ],
)
def test_what_makes_no_body_is_an_error(tmp_path, coeffs, message):
    case = rbf_case(tmp_path, coeffs=coeffs)
    output = case.run("moveDynamicMesh", status=1)
    assert message in output and "FOAM FATAL IO ERROR" in output
    assert not (case.path / "1").exists()


def test_entries_that_nothing_reads_are_named(tmp_path):
    """Variables and distances of OpenFOAM's dictionaries may stay."""
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=lid(body(SPRING + "Lx 0.3; innerDistance 0.05;")),
    )
    output = case.run("moveDynamicMesh")
    assert "Nothing reads the entries" in output
    assert "Lx" in output and "innerDistance" in output


def test_two_bodies_move_each_by_its_own_spring(tmp_path):
    other = body(
        "restraints { spring { sixDoFRigidBodyMotionRestraint "
        "linearSpring; anchor (0.5 0.51 0); refAttachmentPt (0.5 0.5"
        " 0); stiffness 20; damping 0; restLength 0; } }"
        "acceleration (0 0.1 0);",
        centre=(0.5, 0.5, 0),
    )
    case = rbf_case(
        tmp_path,
        control=CONTROL,
        coeffs=lid(body(), f"type moving; patches (zMin); {other}"),
    )
    before = reference(case)
    case.run("moveDynamicMesh")
    d = points_at(case, f"{STEPS*DT:g}") - before
    for name, a, k in (
        ("zMax", ANCHOR, STIFFNESS),
        ("zMin", (0, 0.01, 0), 20),
    ):
        on = d[side(before, name)]
        np.testing.assert_allclose(
            on,
            np.tile(
                np.array(a) * swing(STEPS, np.sqrt(k / MASS)), (len(on), 1)
            ),
            rtol=0,
            atol=1e-13,
        )
