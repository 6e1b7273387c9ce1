/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshPictures.H"
#include "emptyPolyPatch.H"
#include "meshWindow.H"
#include "OSspecific.H"
#include "shownFaces.H"
#include "wedgePolyPatch.H"
#include "wholeFile.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

//- The boundary without what is there for the decomposition or for two
//  dimensions. Collective
static void writeBoundary
(
    const movedMesh& moved,
    const cellFigures& before,
    const cellFigures& after,
    const fileName& folder
)
{
    const fvMesh& mesh = moved.mesh();
    DynamicList<label> which;
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    for (label patchi = 0; patchi < boundary.nNonProcessor(); ++patchi)
    {
        const polyPatch& patch = boundary[patchi];
        if (!isA<emptyPolyPatch>(patch) && !isA<wedgePolyPatch>(patch))
        {
            which.append(identity(patch.size(), patch.start()));
        }
    }
    faceList shown;
    labelList used;
    compact(mesh, which, shown, used);
    vectorField by(used.size());
    forAll(used, i)
    {
        by[i] = moved.after(used[i]) - moved.before(used[i]);
    }
    writeSurface
    (
        folder/"boundary",
        pointField(mesh.points(), used),
        shown,
        by,
        ofFaces(mesh, before.nonOrthogonality, which),
        ofFaces(mesh, after.nonOrthogonality, which)
    );
}


static void writeTables
(
    const UPtrList<meshWindow>& windows,
    const List<worstCell>& worst,
    const meshQuality& before,
    const meshQuality& after,
    const fileName& folder
)
{
    wholeFile::writeOrStop(folder/"windows.dat", [&](Ostream& os)
    {
        os.precision(std::numeric_limits<scalar>::max_digits10);
        os  << "# window xBefore yBefore zBefore xAfter yAfter zAfter"
            << " xNormal yNormal zNormal reach value dimensions" << nl;
        for (const meshWindow& window : windows)
        {
            window.writeRow(os);
        }
    });
    wholeFile::writeOrStop(folder/"worstCells.dat", [&](Ostream& os)
    {
        os.precision(std::numeric_limits<scalar>::max_digits10);
        os  << "# xBefore yBefore zBefore xAfter yAfter zAfter"
            << " nonOrthogonality skewness volume" << nl;
        for (const worstCell& cell : worst)
        {
            for (const point& x : {cell.at.before, cell.at.after})
            {
                os  << x.x() << ' ' << x.y() << ' ' << x.z() << ' ';
            }
            os  << cell.nonOrthogonality << ' ' << cell.skewness << ' '
                << cell.volume << nl;
        }
    });
    wholeFile::writeOrStop(folder/"histogram.dat", [&](Ostream& os)
    {
        meshQuality::writeHistograms(os, before, after);
    });
}

} // End namespace morphMeshPictures
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::morphMeshPictures::write
(
    const fvMesh& mesh,
    const pointField& newPoints,
    const meshQuality& before,
    const meshQuality& after,
    const fileName& folder
)
{
    if (Pstream::master())
    {
        mkDir(folder);
    }
    const movedMesh moved(mesh, newPoints);
    const cellFigures then(mesh, mesh.points());
    const cellFigures now(mesh, newPoints);
    const List<worstCell> worst(worstCells(moved, then, now));

    PtrList<meshWindow> windows(2);
    windows.set(0, new meshWindow("change", moved, mostChanged(moved)));
    windows.set
    (
        1,
        new meshWindow
        (
            "worst", moved, worst.empty() ? peak() : worst.first().at
        )
    );
    writeBoundary(moved, then, now, folder);
    for (const meshWindow& window : windows)
    {
        window.write(then, now, folder);
    }
    if (Pstream::master())
    {
        writeTables(windows, worst, before, after, folder);
    }
}


void Foam::morphMeshPictures::draw(const fileName& folder)
{
    if (!Pstream::master())
    {
        return;
    }
    const string command
    (
        "\"$(python3With numpy matplotlib)\" -m morphfoam.pictures.motion \""
      + folder + '"'
    );
    Info<< endl;
    if (Foam::system(command) != 0)
    {
        WarningInFunction
            << "There is no picture of the motion" << nl
            << "    It needs numpy and matplotlib. Try it: "
            << command.c_str() << endl;
    }
}


// ************************************************************************* //
