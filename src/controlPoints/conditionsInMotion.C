/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfControlPoints.H"
#include "eigenFields.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::rbfControlPoints::follows
(
    const controlCandidates& c,
    const label j,
    const morph::Vector3& s
) const
{
    return
        c.whole[j].slides()
     && sliding_.follows(c.places[j])
     && s.norm() < farthest_;
}


void Foam::rbfControlPoints::renew
(
    const label regioni,
    const morph::Vectors& s,
    morph::ControlPoints& values
)
{
    controlCandidates& c = candidates_[regioni];
    forAll(c.places, j)
    {
        const morph::Vector3 here = s.row(j).transpose();
        if (follows(c, j, here))
        {
            morph::ControlPoint& p = c.whole[j];
            morph::slideOnto
            (
                p, here, sliding_.planes(c.places[j], toFoam(here))
            );
            values[j].value = restricted(p).value;
        }
    }
}


bool Foam::rbfControlPoints::turned
(
    const label regioni,
    const morph::Vectors& s,
    const scalar cosine
) const
{
    if (!follow_)
    {
        return false;
    }
    scalar least = 1;
    const controlCandidates& c = candidates_[regioni];
    forAll(c.places, j)
    {
        const morph::Vector3 here = s.row(j).transpose();
        if (follows(c, j, here))
        {
            morph::ControlPoint p = c.whole[j];
            const scalar present = morph::slideOnto
            (
                p, here, sliding_.planes(c.places[j], toFoam(here))
            );
            least = min(least, present);
        }
    }
    return returnReduce(least, minOp<scalar>()) < cosine;
}


void Foam::rbfControlPoints::renewDirections
(
    const label regioni,
    const morph::Vectors& s
)
{
    controlCandidates& c = candidates_[regioni];
    forAll(c.places, j)
    {
        const label i = c.places[j];
        const morph::Vector3 here = s.row(j).transpose();
        if (follows(c, j, here))
        {
            start_[i] = sliding_.onto(i, toFoam(here));
            sliding_.renewDirections(i, start_[i]);
            c.whole[j] = condition
            (
                controlled_.position(i), true, sliding_.normals(i), start_[i]
            );
            c.conditions[j] = restricted(c.whole[j]);
        }
    }
}


void Foam::rbfControlPoints::setDirections
(
    const label regioni,
    const morph::Vectors& reached
)
{
    controlCandidates& c = candidates_[regioni];
    forAll(c.places, j)
    {
        const label i = c.places[j];
        morph::ControlPoint& p = c.whole[j];
        if (p.slides() && sliding_.follows(i))
        {
            const morph::Vector3 here = reached.row(j).transpose();
            const morph::TangentPlanes planes =
                sliding_.planes(i, toFoam(here));
            List<vector> normals(planes.k);
            forAll(normals, k)
            {
                normals[k] =
                    toFoam(morph::Vector3(planes.normals.col(k)));
            }
            p = condition
            (
                controlled_.position(i), true, normals, toFoam(here)
            );
            morph::slideOnto(p, here, planes);
            c.conditions[j] = restricted(p);
        }
    }
}


morph::ControlPoints Foam::rbfControlPoints::conditionsOnWay
(
    const label regioni,
    const morph::Vectors& reached,
    const motionPaths& paths,
    const scalar fraction,
    const label steps
) const
{
    const controlCandidates& c = candidates_[regioni];
    morph::ControlPoints conditions(c.conditions);
    forAll(c.places, j)
    {
        const label i = c.places[j];
        if
        (
            i >= 0
         && !conditions_[i].slides()
         && paths.turns(controlled_.groupIndex(i))
        )
        {
            const morph::Vector3 so(reached.row(j).transpose());
            const morph::Vector3 next
            (
                toEigen
                (
                    paths.part
                    (
                        controlled_.groupIndex(i), conditions_[i], fraction
                    )
                )
            );
            morph::ControlPoint whole(c.whole[j]);
            whole.value = so + steps*(next - so);
            conditions[j] = restricted(whole);
        }
    }
    return conditions;
}


// ************************************************************************* //
