/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "predictedMesh.H"
#include "invalidMotion.H"
#include "movedGeometry.H"
#include "polyMeshTools.H"
#include "remeshSettings.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::predictedMesh::predictedMesh
(
    const polyMesh& mesh,
    const pointField& points,
    const remeshSettings& settings
)
:
    bad_(mesh.nCells())
{
    const invalidMotion invalid(mesh, points);
    valid_ = invalid.empty();
    bad_ |= invalid.cells();

    const movedGeometry geometry(mesh, points);
    const scalarField cosines
    (
        polyMeshTools::faceOrthogonality
        (
            mesh, geometry.faceAreas(), geometry.cellCentres()
        )
    );
    const scalarField skewness
    (
        polyMeshTools::faceSkewness
        (
            mesh,
            points,
            geometry.faceCentres(),
            geometry.faceAreas(),
            geometry.cellCentres()
        )
    );
    nonOrthogonality_ =
        radToDeg(::acos(max(scalar(-1), min(scalar(1), gMin(cosines)))));
    skewness_ = gMax(skewness);

    const scalar least = ::cos(degToRad(settings.nonOrthogonality));
    forAll(cosines, facei)
    {
        if (cosines[facei] < least || skewness[facei] > settings.skewness)
        {
            bad_.set(mesh.faceOwner()[facei]);
            if (mesh.isInternalFace(facei))
            {
                bad_.set(mesh.faceNeighbour()[facei]);
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::predictedMesh::good() const
{
    return returnReduce(bad_.none(), andOp<bool>());
}


// * * * * * * * * * * * * * * * IOstream Operators  * * * * * * * * * * * * //

Foam::Ostream& Foam::operator<<(Ostream& os, const predictedMesh& mesh)
{
    if (!mesh.valid())
    {
        os  << "invalid, ";
    }
    return os
        << "non-orthogonality " << mesh.nonOrthogonality()
        << " degrees, skewness " << mesh.skewness();
}


// ************************************************************************* //
