/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidBodyDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "transformField.H"
#include "untrapped.H"

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

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The dictionary, without coefficients that the function would not read
static const dictionary& checked(const dictionary& dict)
{
    const word name(dict.get<word>("solidBodyMotionFunction"));
    const word coeffs(name + "Coeffs");
    if (dict.found(coeffs))
    {
        dictionaryChecks::onlyKeys
        (
            dict, {"type", "solidBodyMotionFunction", name + "Coeffs"}
        );
    }
    for (const entry& e : dict)
    {
        if (e.keyword().ends_with("Coeffs") && e.keyword() != coeffs)
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' belongs to another"
                << " solidBodyMotionFunction than '"
                << name << "'" << nl
                << "    Call it '" << coeffs << "', or write its entries"
                << " beside 'solidBodyMotionFunction'" << nl
                << exit(FatalIOError);
        }
    }
    return dict;
}

} // End namespace Foam


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
    motion_
    (
        dictionaryChecks::naming
        (
            dict,
            "solidBodyMotionFunction",
            [&]
            {
                return solidBodyMotionFunction::New(checked(dict), mesh.time());
            }
        )
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::solidBodyDisplacement::displacement
(
    const points& p
) const
{
    // What is not finite is found where it is used
    const untrapped numbers;
    return
        transformPoints(motion_().transformation(), p.positions)
      - p.positions;
}


// ************************************************************************* //
