/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidBodyDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "transformField.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(solidBodyDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        solidBodyDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidBodyDisplacement::solidBodyDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    motion_(solidBodyMotionFunction::New(dict, mesh.time()))
{
    const word name(dict.get<word>("solidBodyMotionFunction"));
    dictionaryChecks::onlyKeys
    (
        dict,
        {"type", "solidBodyMotionFunction", name + "Coeffs"}
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::solidBodyDisplacement::displacement
(
    const points& p
) const
{
    return
        transformPoints(motion_().transformation(), p.positions)
      - p.positions;
}


// ************************************************************************* //
