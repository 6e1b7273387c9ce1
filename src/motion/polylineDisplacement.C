/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "polylineDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(polylineDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        polylineDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::polylineDisplacement::polylineDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    tabulatedDisplacement(dict, mesh, {"vertices", "values"}),
    vertices_(dictionaryChecks::getLengths<pointField>(dict, "vertices")),
    values_(dictionaryChecks::getLengths<vectorField>(dict, "values"))
{
    if (vertices_.size() < 2 || values_.size() != vertices_.size())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'vertices' has "
            << plainText::counted(vertices_.size(), "position").c_str()
            << " and 'values' has "
            << plainText::counted(values_.size(), "displacement").c_str() << nl
            << "    Give at least two vertices and one value for each" << nl
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::vector Foam::polylineDisplacement::at(const point& x) const
{
    vector value(Zero);
    scalar nearest = GREAT;
    for (label i = 0; i + 1 < vertices_.size(); ++i)
    {
        const vector edge = vertices_[i + 1] - vertices_[i];
        const scalar t = min
        (
            max((x - vertices_[i]) & edge, scalar(0))
           /max(magSqr(edge), VSMALL),
            scalar(1)
        );
        const scalar distance = mag(x - vertices_[i] - t*edge);
        if (distance < nearest)
        {
            nearest = distance;
            value = (1 - t)*values_[i] + t*values_[i + 1];
        }
    }
    return value;
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::polylineDisplacement::unscaled
(
    const points& p
) const
{
    auto d = tmp<vectorField>::New(p.positions.size());
    forAll(p.positions, i)
    {
        d.ref()[i] = at(p.positions[i]);
    }
    return d;
}


// ************************************************************************* //
