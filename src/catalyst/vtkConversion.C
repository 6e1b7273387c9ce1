/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "vtkConversion.H"
#include "controlGeometry.H"
#include "cellModel.H"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkPointData.h"

#include <map>
#include <vector>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace vtkConversion
{

static std::vector<vtkIdType> labels(const labelUList& list)
{
    return std::vector<vtkIdType>(list.begin(), list.end());
}


// VTK's cell type, VTK_POLYHEDRON where it has no other
static int cellType(const cellShape& shape)
{
    static const std::map<word, int> types
    {
        {"hex", VTK_HEXAHEDRON},
        {"prism", VTK_WEDGE},
        {"pyr", VTK_PYRAMID},
        {"tet", VTK_TETRA}
    };
    const auto found = types.find(shape.model().name());
    return found == types.end() ? VTK_POLYHEDRON : found->second;
}


static void insertPolyhedron
(
    const polyMesh& mesh,
    const label celli,
    vtkUnstructuredGrid& grid
)
{
    std::vector<vtkIdType> stream;
    for (const label facei : mesh.cells()[celli])
    {
        const face& f = mesh.faces()[facei];
        stream.push_back(f.size());
        if (mesh.faceOwner()[facei] == celli)
        {
            stream.insert(stream.end(), f.begin(), f.end());
        }
        else
        {
            // Seen from this cell, its normal has to point outwards too
            const face reversed(f.reverseFace());
            stream.insert(stream.end(), reversed.begin(), reversed.end());
        }
    }
    const auto points = labels(mesh.cellPoints(celli));
    grid.InsertNextCell
    (
        VTK_POLYHEDRON,
        points.size(),
        points.data(),
        mesh.cells()[celli].size(),
        stream.data()
    );
}


static vtkSmartPointer<vtkCellArray> cellArray(const UList<labelList>& lists)
{
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    for (const labelList& list : lists)
    {
        const auto these = labels(list);
        cells->InsertNextCell(these.size(), these.data());
    }
    return cells;
}

} // End namespace vtkConversion
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

vtkSmartPointer<vtkPoints> Foam::vtkConversion::points
(
    const UList<point>& positions
)
{
    auto result = vtkSmartPointer<vtkPoints>::New();
    result->SetDataTypeToDouble();
    result->SetNumberOfPoints(positions.size());
    forAll(positions, i)
    {
        result->SetPoint(i, positions[i].cdata());
    }
    return result;
}


vtkSmartPointer<vtkUnstructuredGrid> Foam::vtkConversion::cells
(
    const polyMesh& mesh
)
{
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->Allocate(mesh.nCells());
    const cellShapeList& shapes = mesh.cellShapes();
    forAll(shapes, celli)
    {
        const int type = cellType(shapes[celli]);
        if (type == VTK_POLYHEDRON)
        {
            insertPolyhedron(mesh, celli, *grid);
            continue;
        }
        auto p = labels(shapes[celli]);
        if (type == VTK_WEDGE)
        {
            // The normals of VTK's triangles point the other way
            std::swap(p[1], p[2]);
            std::swap(p[4], p[5]);
        }
        grid->InsertNextCell(type, p.size(), p.data());
    }
    grid->SetPoints(points(mesh.points()));
    return grid;
}


vtkSmartPointer<vtkPolyData> Foam::vtkConversion::faces(const polyPatch& patch)
{
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    for (const face& f : patch.localFaces())
    {
        const auto these = labels(f);
        cells->InsertNextCell(these.size(), these.data());
    }
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points(patch.localPoints()));
    result->SetPolys(cells);
    return result;
}


vtkSmartPointer<vtkPolyData> Foam::vtkConversion::shape(const controlShape& s)
{
    auto result = vtkSmartPointer<vtkPolyData>::New();
    result->SetPoints(points(s.points));
    if (returnReduce(s.lines.size(), sumOp<label>()))
    {
        result->SetLines(cellArray(s.lines));
    }
    else
    {
        labelListList single(s.points.size());
        forAll(single, i)
        {
            single[i] = labelList(1, i);
        }
        result->SetVerts(cellArray(single));
    }
    for (const word& name : s.scalars.sortedToc())
    {
        result->GetPointData()->AddArray(array<scalar>(name, s.scalars[name]));
    }
    for (const word& name : s.vectors.sortedToc())
    {
        result->GetPointData()->AddArray(array<vector>(name, s.vectors[name]));
    }
    return result;
}


// ************************************************************************* //
