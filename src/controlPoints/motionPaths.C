/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionPaths.H"
#include "eigenFields.H"
#include "mathematicalConstants.H"
#include "pstreamCommunicator.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionPaths::motionPaths()
:
    n_(1)
{}


Foam::motionPaths::motionPaths
(
    const controlledPoints& controlled,
    const UList<morph::ControlPoint>& conditions,
    const label n
)
:
    n_(n),
    paths_(controlled.nGroups())
{
    List<DynamicList<label>> members(controlled.nGroups());
    for (label i = 0; i < controlled.size(); ++i)
    {
        if (controlled.owned(i) && !conditions[i].slides())
        {
            members[controlled.groupIndex(i)].append(i);
        }
    }
    pstreamCommunicator communicator;
    forAll(members, groupi)
    {
        const labelList& of = members[groupi];
        morph::Vectors x(of.size(), 3);
        morph::Vectors d(of.size(), 3);
        forAll(of, i)
        {
            x.row(i) = conditions[of[i]].position.transpose();
            d.row(i) = conditions[of[i]].value.transpose();
        }
        paths_[groupi] = morph::RigidPath::fit(x, d, communicator);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::vector Foam::motionPaths::part
(
    const label groupi,
    const morph::ControlPoint& prescribed,
    const scalar fraction
) const
{
    if (!turns(groupi))
    {
        return fraction*toFoam(prescribed.value);
    }
    const morph::RigidPath& path = paths_[groupi];
    const auto at = [&](const scalar f)
    {
        return toFoam
        (
            path.displacement(prescribed.position, prescribed.value, f)
        );
    };
    const scalar step = fraction*n_;
    const scalar made = std::floor(step + 1e-9);
    const scalar more = step - made;
    const vector from(at(made/n_));
    return
        mag(more) <= 1e-9
      ? from
      : from + more*(at(min((made + 1)/n_, scalar(1))) - from);
}


Foam::label Foam::motionPaths::turnsOver(const motionPaths& former) const
{
    if (paths_.size() == former.paths_.size())
    {
        for (std::size_t groupi = 0; groupi < paths_.size(); ++groupi)
        {
            const morph::Vector3 between =
                paths_[groupi].rotation() - former.paths_[groupi].rotation();
            if (between.norm() > constant::mathematical::pi)
            {
                return groupi;
            }
        }
    }
    return -1;
}


// ************************************************************************* //
