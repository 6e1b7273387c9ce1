/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "valuesDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(valuesDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        valuesDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::valuesDisplacement::valuesDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    tabulatedDisplacement(dict, mesh, {"values"}),
    values_(dictionaryChecks::getLengths<vectorField>(dict, "values"))
{
    if (nListed == 0 || !patches.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Displacement type 'values' needs a group that lists 'points':"
            << " the points of patches and zones have no order" << nl
            << "    For those use displacement type 'file', which matches by"
            << " position" << nl
            << exit(FatalIOError);
    }
    if (values_.size() != nListed)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'values' has "
            << plainText::counted(values_.size(), "displacement").c_str()
            << ", but the group lists "
            << plainText::counted(nListed, "point").c_str() << nl
            << "    Give one displacement for each point" << nl
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::valuesDisplacement::unscaled
(
    const points& p
) const
{
    return tmp<vectorField>::New(values_, p.listed);
}


Foam::List<Foam::motionParameter> Foam::valuesDisplacement::tableParameters
(
    const word& group
) const
{
    DynamicList<motionParameter> list;
    forAll(values_, i)
    {
        append(list, group + ".values." + Foam::name(i), values_[i]);
    }
    return List<motionParameter>(list);
}


Foam::tmp<Foam::vectorField> Foam::valuesDisplacement::tableDerivative
(
    const points& p,
    const label parameteri
) const
{
    auto d = tmp<vectorField>::New(p.listed.size(), Zero);
    forAll(p.listed, i)
    {
        if (p.listed[i] == parameteri/vector::nComponents)
        {
            d.ref()[i] = unit(parameteri % vector::nComponents);
        }
    }
    return d;
}


// ************************************************************************* //
