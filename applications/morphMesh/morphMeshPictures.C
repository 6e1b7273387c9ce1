/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshPictures.H"
#include "emptyPolyPatch.H"
#include "foamCompat.H"
#include "foamVtkSurfaceWriter.H"
#include "fvMesh.H"
#include "ListListOps.H"
#include "movedGeometry.H"
#include "OSspecific.H"
#include "polyMeshTools.H"
#include "processorPolyPatch.H"
#include "syncTools.H"
#include "Tuple2.H"
#include "unitConversion.H"
#include "wedgePolyPatch.H"
#include "wholeFile.H"

#include <algorithm>
#include <cmath>
#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshPictures
{

// Of a window, in lengths of the face that changed most
static const scalar windowSize = 8;

// Faces of a window: more are too small to be seen
static const label mostFaces = 6000;

// A plane beside the boundary has fewer, and is moved into the mesh
static const label leastFaces = 12;

static const label nWorst = 10;


//- Where something is largest: of equals, the first by its place before, so
//  that all decompositions have the same
struct peak
{
    scalar value = -1;
    point before = Zero;
    point after = Zero;

    //- Of the face there
    scalar length = 0;

    //- Where the mesh is stretched or sheared, before
    vector along = Zero;

    bool beats(const peak& other) const
    {
        if (value != other.value)
        {
            return value > other.value;
        }
        for (direction i = 0; i < 3; ++i)
        {
            if (before[i] != other.before[i])
            {
                return before[i] < other.before[i];
            }
        }
        return length > other.length;
    }

    //- The one of all ranks. Collective
    void reduce();
};


static Ostream& operator<<(Ostream& os, const peak& p)
{
    return os
        << p.value << p.before << p.after << p.length << p.along;
}


static Istream& operator>>(Istream& is, peak& p)
{
    return is >> p.value >> p.before >> p.after >> p.length >> p.along;
}


void peak::reduce()
{
    List<peak> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = *this;
    foamCompat::allGatherList(all);
    for (const peak& other : all)
    {
        if (other.beats(*this))
        {
            *this = other;
        }
    }
}


//- The mesh before and after a motion
class movedMesh
{
    const fvMesh& mesh_;
    const pointField& after_;

    //- Without the last of them two dimensions remain; -1 for three
    label across_;

    //- Of the faces whose shape is seen: of one empty side, or all
    DynamicList<label> faces_;


    void findFaces()
    {
        if (across_ < 0)
        {
            faces_ = identity(mesh_.nFaces());
            return;
        }
        for (const polyPatch& patch : mesh_.boundaryMesh())
        {
            if (isA<emptyPolyPatch>(patch) || isA<wedgePolyPatch>(patch))
            {
                forAll(patch, i)
                {
                    const label facei = patch.start() + i;
                    const vector area
                    (
                        mesh_.faces()[facei].areaNormal(mesh_.points())
                    );
                    if (area[across_] > 0.5*mag(area))
                    {
                        faces_.append(facei);
                    }
                }
            }
        }
    }


public:

    movedMesh(const fvMesh& mesh, const pointField& after)
    :
        mesh_(mesh),
        after_(after),
        across_(-1)
    {
        for (direction i = 0; i < 3; ++i)
        {
            if (mesh.geometricD()[i] < 0)
            {
                across_ = i;
            }
        }
        findFaces();
    }

    const fvMesh& mesh() const
    {
        return mesh_;
    }

    bool planar() const
    {
        return across_ >= 0;
    }

    const DynamicList<label>& faces() const
    {
        return faces_;
    }

    const point& before(const label pointi) const
    {
        return mesh_.points()[pointi];
    }

    const point& after(const label pointi) const
    {
        return after_[pointi];
    }

    //- In the plane, if there is one
    vector seen(vector v) const
    {
        if (planar())
        {
            v[across_] = 0;
        }
        return v;
    }

    //- The longest of its edges and diagonals, before and after
    scalar length(const label facei) const
    {
        scalar longest = 0;
        const face& f = mesh_.faces()[facei];
        forAll(f, i)
        {
            for (label j = 0; j < i; ++j)
            {
                longest = max
                (
                    longest,
                    max
                    (
                        mag(seen(before(f[i]) - before(f[j]))),
                        mag(seen(after(f[i]) - after(f[j])))
                    )
                );
            }
        }
        return longest;
    }

    //- The normal of the section
    vector normal(const peak& at) const
    {
        vector n(Zero);
        if (planar())
        {
            n[across_] = 1;
            return n;
        }
        const vector moved(at.after - at.before);
        const vector u(moved/max(mag(moved), VSMALL));
        const vector v(at.along/max(mag(at.along), VSMALL));
        direction least = 1;
        for (const direction i : {0, 2})
        {
            if (sqr(u[i]) + sqr(v[i]) < sqr(u[least]) + sqr(v[least]) - 1e-6)
            {
                least = i;
            }
        }
        n[least] = 1;
        return n;
    }
};


//- Where a face changed most. Collective
static peak mostChanged(const movedMesh& moved)
{
    peak most;
    for (const label facei : moved.faces())
    {
        const face& f = moved.mesh().faces()[facei];
        forAll(f, i)
        {
            for (label j = 0; j < i; ++j)
            {
                const vector was
                (
                    moved.seen(moved.before(f[i]) - moved.before(f[j]))
                );
                const vector is
                (
                    moved.seen(moved.after(f[i]) - moved.after(f[j]))
                );
                if (magSqr(was) <= VSMALL)
                {
                    continue;
                }
                peak here;
                here.value =
                    std::abs(std::log(max(mag(is), VSMALL)/mag(was)));
                here.before =
                    0.5*(moved.before(f[i]) + moved.before(f[j]));
                if (!(here.value >= most.value))
                {
                    continue;
                }
                here.after = 0.5*(moved.after(f[i]) + moved.after(f[j]));
                here.length = moved.length(facei);
                here.along = was;
                if (here.beats(most))
                {
                    most = here;
                }
            }
        }
    }
    most.reduce();
    return most;
}


//- Figures of cells
struct cellFigures
{
    scalarField nonOrthogonality;
    scalarField skewness;
    scalarField volume;
    pointField centres;

    //- Has the cell no volume, or a face of the wrong side?
    boolList invalid;

    //- Collective
    cellFigures(const fvMesh& mesh, const pointField& points)
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

    //- By what OpenFOAM's checkMesh accepts; rounded, as volumes of one cell
    //  differ by round-off between decompositions
    scalar badness(const label celli) const
    {
        const scalar bad =
            max(nonOrthogonality[celli]/70, skewness[celli]/4);
        return (invalid[celli] ? 1000 : 0) + std::floor(1e8*bad + 0.5)/1e8;
    }
};


struct worstCell
{
    peak at;
    scalar nonOrthogonality;
    scalar skewness;
    scalar volume;
};


static Ostream& operator<<(Ostream& os, const worstCell& c)
{
    return os
        << c.at << c.nonOrthogonality << c.skewness << c.volume;
}


static Istream& operator>>(Istream& is, worstCell& c)
{
    return is >> c.at >> c.nonOrthogonality >> c.skewness >> c.volume;
}


static bool operator!=(const worstCell& a, const worstCell& b)
{
    return a.at.beats(b.at) || b.at.beats(a.at);
}


//- The worst cells after the motion, of all ranks. Collective
static List<worstCell> worstCells
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


//- The larger value of the cells at each face
static scalarField ofFaces
(
    const fvMesh& mesh,
    const scalarField& cells,
    const labelUList& faces
)
{
    scalarList others;
    syncTools::swapBoundaryCellList(mesh, cells, others);
    scalarField values(faces.size());
    forAll(faces, i)
    {
        const label facei = faces[i];
        const label patchi = mesh.boundaryMesh().whichPatch(facei);
        const scalar own = cells[mesh.faceOwner()[facei]];
        values[i] =
            patchi < 0
          ? max(own, cells[mesh.faceNeighbour()[facei]])
          : mesh.boundaryMesh()[patchi].coupled()
          ? max(own, others[facei - mesh.nInternalFaces()])
          : own;
    }
    return values;
}


//- The mesh around a place
class meshWindow
{
    const movedMesh& moved_;

public:

    const word name;
    const peak at;
    const vector normal;

    //- Half of its width
    scalar reach;

    DynamicList<label> faces;


private:

    //- Faces between cells on both sides of the plane, each on one rank.
    //  Collective
    labelList crinkle(const scalar offset, const scalarField& heights) const
    {
        const fvMesh& mesh = moved_.mesh();
        scalarList others;
        syncTools::swapBoundaryCellList(mesh, heights, others);
        DynamicList<label> cut;
        for (label facei = 0; facei < mesh.nInternalFaces(); ++facei)
        {
            const bool owner = heights[mesh.faceOwner()[facei]] > offset;
            const bool other = heights[mesh.faceNeighbour()[facei]] > offset;
            if (owner != other)
            {
                cut.append(facei);
            }
        }
        for (const polyPatch& patch : mesh.boundaryMesh())
        {
            const auto* processor = isA<processorPolyPatch>(patch);
            if (!processor || !processor->owner())
            {
                continue;
            }
            forAll(patch, i)
            {
                const label facei = patch.start() + i;
                const bool owner = heights[mesh.faceOwner()[facei]] > offset;
                const bool other =
                    others[facei - mesh.nInternalFaces()] > offset;
                if (owner != other)
                {
                    cut.append(facei);
                }
            }
        }
        return labelList(cut);
    }

    //- Those that are in the window before or after
    DynamicList<label> within(const labelUList& all, const scalar width) const
    {
        DynamicList<label> inside;
        for (const label facei : all)
        {
            vector was(Zero), is(Zero);
            const face& f = moved_.mesh().faces()[facei];
            scalar nearest = GREAT;
            for (const label pointi : f)
            {
                was = moved_.before(pointi) - at.before;
                is = moved_.after(pointi) - at.after;
                nearest = min
                (
                    nearest,
                    min
                    (
                        cmptMax(cmptMag(was - (was & normal)*normal)),
                        cmptMax(cmptMag(is - (is & normal)*normal))
                    )
                );
            }
            if (nearest <= (1 + 1e-6)*width)
            {
                inside.append(facei);
            }
        }
        return inside;
    }

    label count(const DynamicList<label>& these) const
    {
        return returnReduce(these.size(), sumOp<label>());
    }

    //- Take those of a section that fit; make the window smaller where they
    //  are too many. Collective
    void take(const labelUList& section)
    {
        faces = within(section, reach);
        while (count(faces) > mostFaces)
        {
            reach *= 0.7;
            faces = within(labelList(faces), reach);
        }
    }


public:

    //- Collective
    meshWindow(const word& called, const movedMesh& moved, const peak& place)
    :
        moved_(moved),
        name(called),
        at(place),
        normal(moved.normal(place)),
        reach(0)
    {
        const boundBox box(moved.mesh().points());
        const scalar whole = 0.5*cmptMax(moved.seen(box.span()));
        const scalar full = max(min(windowSize*at.length, whole), VSMALL);
        reach = full;
        if (moved.planar())
        {
            take(moved.faces());
            return;
        }

        const scalarField heights
        (
            (moved.mesh().cellCentres() - at.before) & normal
        );
        // Not through centres of cells, on either side by round-off
        take(crinkle(0.01*at.length, heights));
        scalar chosen = reach;
        DynamicList<label> most(faces);
        for
        (
            scalar step = at.length/64;
            count(most) < leastFaces && step < 8*whole;
            step *= 2
        )
        {
            for (const scalar offset : {step, -step})
            {
                reach = full;
                take(crinkle(offset, heights));
                if (count(faces) > count(most))
                {
                    most = faces;
                    chosen = reach;
                }
            }
        }
        faces = most;
        reach = chosen;
    }

    //- Collective
    void write
    (
        const cellFigures& before,
        const cellFigures& after,
        const fileName& folder
    ) const;

    void writeRow(Ostream& os) const
    {
        os  << name.c_str();
        for (const vector& v : {at.before, at.after, normal})
        {
            os  << ' ' << v.x() << ' ' << v.y() << ' ' << v.z();
        }
        os  << ' ' << reach << ' ' << at.value << ' '
            << (moved_.planar() ? 2 : 3) << nl;
    }
};


//- Faces with points of their own
static void compact
(
    const fvMesh& mesh,
    const labelUList& which,
    faceList& faces,
    labelList& points
)
{
    faces.setSize(which.size());
    Map<label> place(4*which.size());
    DynamicList<label> used;
    forAll(which, i)
    {
        faces[i] = mesh.faces()[which[i]];
        for (label& pointi : faces[i])
        {
            if (place.insert(pointi, used.size()))
            {
                used.append(pointi);
            }
            pointi = place[pointi];
        }
    }
    points.transfer(used);
}


static void writeSurface
(
    const fileName& file,
    const pointField& points,
    const faceList& faces,
    const vectorField& displacement,
    const scalarField& before,
    const scalarField& after
)
{
    vtk::surfaceWriter writer(points, faces, file);
    writer.writeGeometry();
    writer.beginCellData(2);
    writer.write("nonOrthogonalityBefore", before);
    writer.write("nonOrthogonalityAfter", after);
    writer.beginPointData(1);
    writer.write("displacement", displacement);
    const fileName written(writer.output());
    writer.close();
    wholeFile::checkEnd(written, "</VTKFile>");
}


void meshWindow::write
(
    const cellFigures& before,
    const cellFigures& after,
    const fileName& folder
) const
{
    const fvMesh& mesh = moved_.mesh();
    faceList shown;
    labelList used;
    compact(mesh, faces, shown, used);
    pointField was(used.size());
    vectorField by(used.size());
    forAll(used, i)
    {
        was[i] = moved_.before(used[i]) - at.before;
        by[i] = (moved_.after(used[i]) - at.after) - was[i];
    }
    writeSurface
    (
        folder/name,
        was,
        shown,
        by,
        ofFaces(mesh, before.nonOrthogonality, faces),
        ofFaces(mesh, after.nonOrthogonality, faces)
    );
}


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
