/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "prescribedDisplacement.H"
#include "plainText.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(prescribedDisplacement, 0);
    defineRunTimeSelectionTable(prescribedDisplacement, dictionary);
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::prescribedDisplacement::prescribedDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh
)
:
    dict_(dict),
    mesh_(mesh)
{}


Foam::autoPtr<Foam::prescribedDisplacement> Foam::prescribedDisplacement::New
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
{
    const word type(dict.get<word>("type"));
    const auto constructor = dictionaryConstructorTablePtr_->cfind(type);

    if (!constructor.found())
    {
        FatalIOErrorInFunction(dict)
            << "Unknown displacement type '" << type << "'" << nl
            << "    Valid types: "
            << plainText::listed
               (
                   dictionaryConstructorTablePtr_->sortedToc()
               ).c_str()
            << nl
            << exit(FatalIOError);
    }

    return autoPtr<prescribedDisplacement>
    (
        constructor()(dict, mesh, patches, nListed)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::prescribedDisplacement::append
(
    DynamicList<motionParameter>& parameters,
    const word& name,
    const vector& value
)
{
    for (direction c = 0; c < vector::nComponents; ++c)
    {
        parameters.append
        (
            {name + '.' + vector::componentNames[c], value[c]}
        );
    }
}


Foam::tmp<Foam::vectorField> Foam::prescribedDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    // Of one without parameters there is none
    return tmp<vectorField>::New(p.positions.size(), Zero);
}


// ************************************************************************* //
