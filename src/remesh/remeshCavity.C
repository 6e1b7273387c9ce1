/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remeshCavity.H"
#include "movedGeometry.H"
#include "polyMesh.H"
#include "polyMeshTools.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::remeshCavity::remeshCavity
(
    const polyMesh& mesh,
    const remeshSettings& settings,
    const labelUList& patches,
    const bitSet& also
)
:
    mesh_(mesh),
    settings_(settings),
    kept_(mesh.nCells()),
    bad_(mesh.nCells())
{
    bad_ |= also;

    if (settings.keepLayers > 0)
    {
        bitSet atPatches(mesh.nPoints());
        for (const label patchi : patches)
        {
            atPatches.set(mesh.boundaryMesh()[patchi].meshPoints());
        }
        for (const label pointi : atPatches)
        {
            kept_.set(mesh.pointCells(pointi));
        }
        for (label layer = 1; layer < settings.keepLayers; ++layer)
        {
            grow(kept_);
        }
    }
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.coupled())
        {
            kept_.set(patch.faceCells());
        }
    }

    const movedGeometry geometry(mesh, mesh.points());
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
            mesh.points(),
            geometry.faceCentres(),
            geometry.faceAreas(),
            geometry.cellCentres()
        )
    );
    const scalarField pyramids(geometry.syncedPyramidVolumes());
    const scalar least = Foam::cos(degToRad(settings.nonOrthogonality));
    forAll(cosines, facei)
    {
        const bool good =
            cosines[facei] >= least
         && skewness[facei] <= settings.skewness
         && pyramids[facei] > 0;
        if (!good)
        {
            bad_.set(mesh.faceOwner()[facei]);
            if (mesh.isInternalFace(facei))
            {
                bad_.set(mesh.faceNeighbour()[facei]);
            }
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::remeshCavity::grow(bitSet& cells) const
{
    bitSet points(mesh_.nPoints());
    for (const label celli : cells)
    {
        for (const label facei : mesh_.cells()[celli])
        {
            points.set(mesh_.faces()[facei]);
        }
    }
    for (const label pointi : points)
    {
        cells.set(mesh_.pointCells(pointi));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::labelList Foam::remeshCavity::cells(const label layers) const
{
    bitSet cells(bad_);
    if (settings_.region == remeshSettings::extent::all)
    {
        cells = bitSet(mesh_.nCells(), true);
    }
    else
    {
        for (label layer = 0; layer < layers; ++layer)
        {
            grow(cells);
        }
    }
    cells -= kept_;
    return cells.sortedToc();
}


// ************************************************************************* //
