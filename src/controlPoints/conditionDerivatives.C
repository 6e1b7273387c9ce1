/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfControlPoints.H"
#include "eigenFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// In units of the mesh's size: steps of differences along curved surfaces
static const scalar differenceStep = 1e-5;

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::vector Foam::rbfControlPoints::ontoDerivative
(
    const label i,
    const vector& s,
    const vector& ds
) const
{
    const scalar size = mag(ds);
    if (size < VSMALL)
    {
        return Zero;
    }
    const vector step = differenceStep*farthest_/size*ds;
    return
        (sliding_.onto(i, s + step) - sliding_.onto(i, s - step))
       *(size/(2*differenceStep*farthest_));
}


Foam::rbfControlPoints::conditionDerivatives
Foam::rbfControlPoints::derivatives(const controlPointSource& told) const
{
    conditionDerivatives result;
    string lost;
    result.controlled = controlled_.displacements(told, lost);
    for (label i = 0; i < controlled_.size(); ++i)
    {
        // Surfaces stay: see rbfSensitivities
        if (controlled_.slides(i))
        {
            result.controlled[i] = Zero;
        }
    }
    const vectorField listed(listedPoints_.displacements(told));

    result.candidates.setSize(candidates_.size());
    forAll(candidates_, regioni)
    {
        const controlCandidates& c = candidates_[regioni];
        forAll(c.places, j)
        {
            const label i = c.places[j];
            morph::ControlPoint p = c.whole[j];
            p.value.setZero();
            if (!p.slides())
            {
                p.value = toEigen(i < 0 ? listed[-1 - i] : result.controlled[i]);
            }
            result.candidates[regioni].push_back(restricted(p));
        }
    }
    return result;
}


bool Foam::rbfControlPoints::renewDerivatives
(
    const label regioni,
    const morph::Vectors& s,
    const morph::Vectors& ds,
    morph::ControlPoints& derivatives
) const
{
    bool some = false;
    const controlCandidates& c = candidates_[regioni];
    forAll(c.places, j)
    {
        const morph::Vector3 here = s.row(j).transpose();
        if (!follows(c, j, here))
        {
            continue;
        }
        some = true;
        const morph::Vector3 way = ds.row(j).transpose();
        const scalar size = way.norm();
        morph::ControlPoint p = c.whole[j];
        p.value.setZero();
        if (size > VSMALL)
        {
            const scalar length = differenceStep*farthest_;
            for (const scalar sign : {1, -1})
            {
                const morph::Vector3 there = here + sign*length/size*way;
                morph::ControlPoint q = c.whole[j];
                morph::slideOnto
                (
                    q, there, sliding_.planes(c.places[j], toFoam(there))
                );
                p.value += sign*size/(2*length)*q.value;
            }
        }
        derivatives[j].value = restricted(p).value;
    }
    return returnReduce(some, orOp<bool>());
}


void Foam::rbfControlPoints::imposeDerivative
(
    const vectorField& controlled,
    const vectorField& displacement,
    vectorField& derivative,
    const bool slidingToo
) const
{
    for (label i = 0; i < controlled_.size(); ++i)
    {
        const label pointi = controlled_.labels()[i];
        vector& d = derivative[pointi];
        const morph::ControlPoint& p = conditions_[i];
        if (!p.slides())
        {
            d = controlled[i];
        }
        else if (slidingToo && sliding_.follows(i))
        {
            d = ontoDerivative(i, displacement[pointi], d);
        }
        else if (slidingToo)
        {
            const morph::Vector3 s = toEigen(d);
            d -= toFoam(morph::Vector3(p.C()*(p.C().transpose()*s)));
        }
    }
    for (const label pointi : controlled_.constraints().onPlanes())
    {
        vector& d = derivative[pointi];
        d = controlled_.constraints().kept(pointi, d);
    }
}


// ************************************************************************* //
