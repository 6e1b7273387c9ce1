/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshChannel.H"
#include "dictionaryChecks.H"
#include "emptyPolyPatch.H"
#include "mapPolyMesh.H"
#include "volFields.H"
#include "vtkConversion.H"

#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::meshChannel::meshChannel
(
    const word& name,
    const dictionary& dict,
    const Time& time
)
:
    catalystChannel(name, dict, time),
    internal_(dict.getOrDefault("internal", true)),
    boundary_(dict.getOrDefault("boundary", true)),
    patches_(dict.getOrDefault<wordRes>("patches", wordRes())),
    fields_(dict.getOrDefault<wordRes>("fields", wordRes())),
    moved_(true)
{
    dictionaryChecks::onlyKeys
    (
        dict, {"type", "region", "internal", "boundary", "patches", "fields"}
    );
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::meshChannel::selectPatches()
{
    const polyBoundaryMesh& boundary = mesh()->boundaryMesh();
    DynamicList<label> selected;
    for (label patchi = 0; patchi < boundary.nNonProcessor(); ++patchi)
    {
        const polyPatch& patch = boundary[patchi];
        const bool wanted =
            patches_.empty()
          ? !isA<emptyPolyPatch>(patch)
          : patches_.match(patch.name());
        if (wanted)
        {
            selected.append(patchi);
        }
    }
    patchIDs_.transfer(selected);
}


void Foam::meshChannel::updateGeometry()
{
    const bool first = !cells_ && faces_.empty();
    if (first && internal_)
    {
        cells_ = vtkConversion::cells(*mesh());
    }
    else if (moved_ && internal_)
    {
        cells_->SetPoints(vtkConversion::points(mesh()->points()));
    }

    if (first && boundary_)
    {
        selectPatches();
        for (const label patchi : patchIDs_)
        {
            faces_.push_back
            (
                vtkConversion::faces(mesh()->boundaryMesh()[patchi])
            );
        }
    }
    else if (moved_ && boundary_)
    {
        forAll(patchIDs_, i)
        {
            faces_[i]->SetPoints
            (
                vtkConversion::points
                (
                    mesh()->boundaryMesh()[patchIDs_[i]].localPoints()
                )
            );
        }
    }
    moved_ = false;
}


template<class Type>
void Foam::meshChannel::addFields
(
    vtkUnstructuredGrid* cells,
    const std::vector<vtkSmartPointer<vtkPolyData>>& faces
) const
{
    typedef GeometricField<Type, fvPatchField, volMesh> fieldType;
    for (const word& name : mesh()->sortedNames<fieldType>())
    {
        if (!fields_.match(name))
        {
            continue;
        }
        const auto& field = mesh()->lookupObject<fieldType>(name);
        if (cells)
        {
            cells->GetCellData()->AddArray
            (
                vtkConversion::array<Type>(name, field.primitiveField())
            );
        }
        forAll(patchIDs_, i)
        {
            if (i < label(faces.size()))
            {
                faces[i]->GetCellData()->AddArray
                (
                    vtkConversion::array<Type>
                    (
                        name, field.boundaryField()[patchIDs_[i]]
                    )
                );
            }
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

vtkSmartPointer<vtkMultiBlockDataSet> Foam::meshChannel::data()
{
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    if (!mesh())
    {
        return blocks;
    }
    updateGeometry();

    // Shallow copies, so that the fields of one time do not stay
    vtkSmartPointer<vtkUnstructuredGrid> cells;
    if (internal_)
    {
        cells = vtkSmartPointer<vtkUnstructuredGrid>::New();
        cells->ShallowCopy(cells_);
    }
    std::vector<vtkSmartPointer<vtkPolyData>> faces;
    for (const auto& geometry : faces_)
    {
        faces.push_back(vtkSmartPointer<vtkPolyData>::New());
        faces.back()->ShallowCopy(geometry);
    }

    addFields<scalar>(cells, faces);
    addFields<vector>(cells, faces);
    addFields<sphericalTensor>(cells, faces);
    addFields<symmTensor>(cells, faces);
    addFields<tensor>(cells, faces);

    unsigned block = 0;
    const auto add = [&](vtkMultiBlockDataSet* to, unsigned i, auto* what,
        const char* name)
    {
        to->SetBlock(i, what);
        to->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), name);
    };
    if (internal_)
    {
        add(blocks, block++, cells.Get(), "internal");
    }
    if (boundary_)
    {
        auto patches = vtkSmartPointer<vtkMultiBlockDataSet>::New();
        forAll(patchIDs_, i)
        {
            add
            (
                patches, i, faces[i].Get(),
                mesh()->boundaryMesh()[patchIDs_[i]].name().c_str()
            );
        }
        add(blocks, block++, patches.Get(), "boundary");
    }
    return blocks;
}


void Foam::meshChannel::movePoints(const polyMesh& moved)
{
    moved_ = moved_ || &moved == mesh();
}


void Foam::meshChannel::updateMesh(const mapPolyMesh& map)
{
    if (&map.mesh() == mesh())
    {
        cells_ = nullptr;
        faces_.clear();
    }
}


// ************************************************************************* //
