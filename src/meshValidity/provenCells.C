/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "provenCells.H"
#include "cellGeometry.H"
#include "labelPair.H"
#include "untrappedHere.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(provenCells, 0);
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The points of a face, from its first, such that its normal points out of a
//  cell
class outwardFace
{
    const face& f_;
    const bool owns_;

public:

    outwardFace(const face& f, const bool owns)
    :
        f_(f),
        owns_(owns)
    {}

    label size() const
    {
        return f_.size();
    }

    label operator[](const label i) const
    {
        return f_[owns_ ? i : f_.size() - 1 - i];
    }
};


//- Add the other points of a cell by a face beside its base: that has one edge
//  of the base, the other way round. False if it has none, or contradicts
//  another face
static bool addSide
(
    const outwardFace& side,
    const label nBase,
    const bool tip,
    std::int32_t* points
)
{
    const label n = side.size();
    for (label i = 0; i < n; ++i)
    {
        label next = 0;
        while (next < nBase && points[next] != side[i])
        {
            ++next;
        }
        const label j = next == 0 ? nBase - 1 : next - 1;
        if (next == nBase || side[(i + 1) % n] != points[j])
        {
            continue;
        }
        const label beside = side[(i + 2) % n];
        const label last = side[(i + n - 1) % n];
        std::int32_t& a = points[nBase + (tip ? 0 : j)];
        std::int32_t& b = points[nBase + (tip ? 0 : next)];
        if ((a >= 0 && a != beside) || (b >= 0 && b != last))
        {
            return false;
        }
        a = beside;
        b = last;
        return true;
    }
    return false;
}


//- The shape that a cell can have by the number of its faces' points; false if
//  there is none
static bool shapeOf
(
    const cell& c,
    const faceList& faces,
    morph::CellShape& shape
)
{
    label triangles = 0;
    label quadrilaterals = 0;
    for (const label facei : c)
    {
        triangles += faces[facei].size() == 3;
        quadrilaterals += faces[facei].size() == 4;
    }
    if (triangles + quadrilaterals != c.size())
    {
        return false;
    }
    const labelPair found(triangles, quadrilaterals);
    if (found == labelPair(0, 6))
    {
        shape = morph::CellShape::hexahedron;
    }
    else if (found == labelPair(2, 3))
    {
        shape = morph::CellShape::prism;
    }
    else if (found == labelPair(4, 1))
    {
        shape = morph::CellShape::pyramid;
    }
    else
    {
        shape = morph::CellShape::tetrahedron;
        return found == labelPair(4, 0);
    }
    return true;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::provenCells::provenCells(const polyMesh& mesh)
:
    kept(mesh)
{
    // Most meshes are hexahedra for the most part
    alike& most = shapes_[int(morph::CellShape::hexahedron)];
    most.cells.reserve(mesh.nCells());
    most.points.reserve(8*mesh.nCells());

    const cellList& cells = mesh.cells();
    const faceList& faces = mesh.faces();
    const labelList& owner = mesh.faceOwner();
    forAll(cells, celli)
    {
        morph::CellShape shape;
        std::int32_t points[8];
        if
        (
            shapeOf(cells[celli], faces, shape)
         && match(celli, cells[celli], faces, owner, shape, points)
        )
        {
            alike& same = shapes_[int(shape)];
            same.cells.append(celli);
            for (label j = 0; j < morph::nPoints(shape); ++j)
            {
                same.points.append(points[j]);
            }
        }
        else
        {
            others_.append(celli);
        }
    }
    for (alike& same : shapes_)
    {
        same.cells.shrink();
        same.points.shrink();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::provenCells::match
(
    const label celli,
    const cell& c,
    const faceList& faces,
    const labelList& owner,
    const morph::CellShape shape,
    std::int32_t* points
)
{
    const bool onTriangle =
        shape == morph::CellShape::tetrahedron
     || shape == morph::CellShape::prism;
    const label nBase = onTriangle ? 3 : 4;
    const label nPoints = morph::nPoints(shape);
    const bool tip = nPoints == nBase + 1;
    const auto outward = [&](const label facei)
    {
        return outwardFace(faces[facei], owner[facei] == celli);
    };

    label base = 0;
    while (faces[c[base]].size() != nBase)
    {
        ++base;
    }
    const outwardFace f(outward(c[base]));
    for (label j = 0; j < nPoints; ++j)
    {
        points[j] = j < nBase ? f[j] : -1;
    }

    label sides = 0;
    label top = -1;
    forAll(c, i)
    {
        if (i == base)
        {
            continue;
        }
        if (addSide(outward(c[i]), nBase, tip, points))
        {
            ++sides;
        }
        else if (top < 0)
        {
            top = c[i];
        }
        else
        {
            return false;
        }
    }
    if (sides != nBase || (top < 0) != tip)
    {
        return false;
    }
    if (tip)
    {
        return true;
    }
    const outwardFace opposite(outward(top));
    label start = 0;
    while (start < nBase && opposite[start] != points[nBase])
    {
        ++start;
    }
    bool same = opposite.size() == nBase && start < nBase;
    for (label j = 0; same && j < nBase; ++j)
    {
        same = opposite[(start + nBase - j) % nBase] == points[nBase + j];
    }
    return same;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::provenCells::all(const pointField& points) const
{
    const untrappedHere numbers;
    DynamicList<label> doubtful(others_);
    for (label i = 0; i < morph::nCellShapes; ++i)
    {
        const alike& same = shapes_[i];
        if (same.cells.empty())
        {
            continue;
        }
        const std::vector<morph::Index> failed = morph::notProven
        (
            morph::CellShape(i),
            same.points.cdata(),
            same.cells.size(),
            points[0].cdata()
        );
        for (const morph::Index j : failed)
        {
            doubtful.append(same.cells[j]);
        }
    }
    if (doubtful.size() > mesh().nCells()/2)
    {
        return false;
    }
    cellGeometry cell(mesh(), points);
    for (const label celli : doubtful)
    {
        cell.set(celli);
        const scalar roundOff =
            morph::cellRoundOff*cell.farthest()*cell.sqrSize() + 1e-100;
        if (!(cell.volume() > roundOff && cell.smallestPyramid() > roundOff))
        {
            return false;
        }
    }
    return true;
}


// ************************************************************************* //
