/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshQuality.H"
#include "movedGeometry.H"
#include "plainText.H"
#include "polyMeshTools.H"
#include "syncTools.H"
#include "unitConversion.H"
#include "IOmanip.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Lower bounds of equal bins
static scalarList equalBins(const label n, const scalar width)
{
    scalarList from(n);
    forAll(from, i)
    {
        from[i] = i*width;
    }
    return from;
}


static bitSet betweenCells(const polyMesh& mesh)
{
    bitSet faces(mesh.nFaces());
    faces.set(identity(mesh.nInternalFaces()));
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled())
        {
            faces.set(identity(patch.size(), patch.start()));
        }
    }
    return faces;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::meshQuality::checkCells
(
    const polyMesh& mesh,
    const movedGeometry& geometry
)
{
    // Openness is not needed: a motion cannot open a cell
    scalarField openness;
    scalarField aspectRatio;
    primitiveMeshTools::cellClosedness
    (
        mesh,
        mesh.geometricD(),
        geometry.faceAreas(),
        geometry.cellVolumes(),
        openness,
        aspectRatio
    );

    nCells_ = returnReduce(mesh.nCells(), sumOp<label>());
    minVolume_ = gMin(geometry.cellVolumes());
    nNonPositiveCells_ = returnReduce
    (
        label
        (
            movedGeometry::nonPositive(geometry.cellVolumes()).count()
        ),
        sumOp<label>()
    );
    maxAspectRatio_ = gMax(aspectRatio);
}


void Foam::meshQuality::checkFaces
(
    const polyMesh& mesh,
    const movedGeometry& geometry,
    const pointField& points
)
{
    const scalarField cosines
    (
        polyMeshTools::faceOrthogonality
        (
            mesh,
            geometry.faceAreas(),
            geometry.cellCentres()
        )
    );
    maxNonOrthogonality_ =
        radToDeg(::acos(max(-1.0, min(1.0, gMin(cosines)))));

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
    maxSkewness_ = gMax(skewness);

    const bitSet once(syncTools::getMasterFaces(mesh));
    const bitSet between(betweenCells(mesh) & once);
    nonOrthogonality_.count
    (
        radToDeg(acos(max(-1.0, min(1.0, cosines)))), between
    );
    skewness_.count(skewness, once);
    volumeRatio_.count
    (
        polyMeshTools::volRatio(mesh, geometry.cellVolumes()), between
    );

    bitSet wrong(movedGeometry::nonPositive(geometry.syncedPyramidVolumes()));
    wrong &= once;
    nWrongFaces_ = returnReduce(label(wrong.count()), sumOp<label>());
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshQuality::meshQuality(const polyMesh& mesh, const pointField& points)
:
    nonOrthogonality_("nonOrthogonality", equalBins(19, 5)),
    skewness_("skewness", {0, 0.1, 0.2, 0.4, 0.6, 0.8, 1, 1.5, 2, 3, 4}),
    volumeRatio_("volumeRatio", equalBins(10, 0.1))
{
    const movedGeometry geometry(mesh, points);
    checkCells(mesh, geometry);
    checkFaces(mesh, geometry, points);
}


// * * * * * * * * * * * * * * * * * Write * * * * * * * * * * * * * * * * * //

void Foam::meshQuality::writeHeader(Ostream& os)
{
    os  << "# mesh  " << setw(10) << "cells"
        << ' ' << setw(18) << "minVolume"
        << ' ' << setw(19) << "maxNonOrthogonality"
        << ' ' << setw(18) << "maxSkewness"
        << ' ' << setw(18) << "maxAspectRatio"
        << ' ' << setw(20) << "wronglyOrientedFaces"
        << ' ' << setw(16) << "nonPositiveCells" << endl;
}


void Foam::meshQuality::writeRow
(
    Ostream& os,
    const word& name,
    const int digits
) const
{
    const auto rounded = [=](const scalar x)
    {
        return plainText::rounded(x, digits);
    };

    os  << name.c_str();
    for (label i = name.size(); i < 8; ++i)
    {
        os  << ' ';
    }

    os  << setw(10) << nCells_
        << ' ' << setw(18) << rounded(minVolume_).c_str()
        << ' ' << setw(19) << rounded(maxNonOrthogonality_).c_str()
        << ' ' << setw(18) << rounded(maxSkewness_).c_str()
        << ' ' << setw(18) << rounded(maxAspectRatio_).c_str()
        << ' ' << setw(20) << nWrongFaces_
        << ' ' << setw(16) << nNonPositiveCells_ << endl;
}


void Foam::meshQuality::writeHistograms
(
    Ostream& os,
    const meshQuality& before,
    const meshQuality& after
)
{
    typedef faceHistogram histogram;

    histogram::writeHeader(os);
    histogram::writeRows(os, before.nonOrthogonality_, after.nonOrthogonality_);
    histogram::writeRows(os, before.skewness_, after.skewness_);
    histogram::writeRows(os, before.volumeRatio_, after.volumeRatio_);
}


// ************************************************************************* //
