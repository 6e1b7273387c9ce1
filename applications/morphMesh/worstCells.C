/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "worstCells.H"
#include "foamCompat.H"
#include "ListListOps.H"
#include "movedGeometry.H"
#include "polyMeshTools.H"
#include "unitConversion.H"

#include <algorithm>
#include <cmath>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

static const label nWorst = 10;


cellFigures::cellFigures(const fvMesh& mesh, const pointField& points)
:
    nonOrthogonality(mesh.nCells(), Zero),
    skewness(mesh.nCells(), Zero),
    invalid(mesh.nCells(), false)
{
    const movedGeometry geometry(mesh, points);
    volume = geometry.cellVolumes();
    centres = geometry.cellCentres();
    const scalarField cosines
    (
        polyMeshTools::faceOrthogonality
        (
            mesh, geometry.faceAreas(), geometry.cellCentres()
        )
    );
    const scalarField skew
    (
        polyMeshTools::faceSkewness
        (
            mesh, points, geometry.faceCentres(), geometry.faceAreas(),
            geometry.cellCentres()
        )
    );
    const bitSet wrong
    (
        movedGeometry::nonPositive(geometry.syncedPyramidVolumes())
    );
    forAll(cosines, facei)
    {
        const scalar angle = radToDeg
        (
            std::acos(max(scalar(-1), min(scalar(1), cosines[facei])))
        );
        const label neighbour =
            mesh.isInternalFace(facei)
          ? mesh.faceNeighbour()[facei]
          : mesh.faceOwner()[facei];
        for (const label celli : {mesh.faceOwner()[facei], neighbour})
        {
            nonOrthogonality[celli] = max(nonOrthogonality[celli], angle);
            skewness[celli] = max(skewness[celli], skew[facei]);
            invalid[celli] = invalid[celli] || wrong.test(facei);
        }
    }
    for (const label celli : movedGeometry::nonPositive(volume))
    {
        invalid[celli] = true;
    }
}


scalar cellFigures::badness(const label celli) const
{
    const scalar bad =
        max(nonOrthogonality[celli]/70, skewness[celli]/4);
    return (invalid[celli] ? 1000 : 0) + std::floor(1e8*bad + 0.5)/1e8;
}


List<worstCell> worstCells
(
    const movedMesh& moved,
    const cellFigures& before,
    const cellFigures& after
)
{
    const auto worse = [](const worstCell& a, const worstCell& b)
    {
        return a.at.beats(b.at);
    };
    const label nCells = after.volume.size();

    // Cells above each other differ by round-off in their other coordinates,
    // and two cells have the worst face
    const scalar unit = 1e-9*boundBox(moved.mesh().points()).mag();
    pointField places(before.centres);
    for (point& x : places)
    {
        for (direction d = 0; d < 3; ++d)
        {
            x[d] = unit*std::floor(x[d]/unit + 0.5);
        }
    }

    labelList order(identity(nCells));
    scalarField badness(nCells);
    forAll(badness, celli)
    {
        badness[celli] = after.badness(celli);
    }
    const auto byBadness = [&](const label a, const label b)
    {
        peak one, other;
        one.value = badness[a];
        one.before = places[a];
        other.value = badness[b];
        other.before = places[b];
        return one.beats(other);
    };
    const label n = min(nWorst, nCells);
    std::partial_sort
    (
        order.begin(), order.begin() + n, order.end(), byBadness
    );

    List<List<worstCell>> all(Pstream::nProcs());
    List<worstCell>& mine = all[Pstream::myProcNo()];
    for (label i = 0; i < n; ++i)
    {
        const label celli = order[i];
        worstCell cell;
        cell.at.value = badness[celli];
        cell.at.before = places[celli];
        cell.at.after = after.centres[celli];
        for (const label facei : moved.mesh().cells()[celli])
        {
            cell.at.length = max(cell.at.length, moved.length(facei));
        }
        cell.nonOrthogonality = after.nonOrthogonality[celli];
        cell.skewness = after.skewness[celli];
        cell.volume = after.volume[celli];
        mine.append(cell);
    }
    foamCompat::allGatherList(all);
    List<worstCell> worst
    (
        ListListOps::combine<List<worstCell>>
        (
            all, accessOp<List<worstCell>>()
        )
    );
    std::sort(worst.begin(), worst.end(), worse);
    worst.setSize(min(nWorst, worst.size()));
    return worst;
}

} // End namespace morphMeshPictures
} // End namespace Foam


// ************************************************************************* //
