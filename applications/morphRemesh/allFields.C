/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "allFields.H"
#include "cellSet.H"
#include "faceSet.H"
#include "foamCompat.H"
#include "fvMesh.H"
#include "IOobjectList.H"
#include "mapPolyMesh.H"
#include "pointFields.H"
#include "pointSet.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Files of the mesh itself: what it swept in its last step
static const wordHashSet ofTheMesh({"meshPhi", "V0", "V00"});


template<class Field>
static void read
(
    const IOobjectList& objects,
    const typename Field::Mesh& mesh,
    DynamicList<word>& names
)
{
    for (const word& name : objects.sortedNames(Field::typeName))
    {
        // Old times come with their field
        const bool old =
            name.ends_with("_0") && objects.found(name.substr(0, name.size() - 2));
        if (!old && !ofTheMesh.found(name))
        {
            IOobject io(*objects.findObject(name));
            io.readOpt() = IOobject::MUST_READ;
            io.writeOpt() = IOobject::AUTO_WRITE;
            regIOobject::store(new Field(io, mesh));
            names.append(name);
        }
    }
}


template<class Type>
static void readAll
(
    const IOobjectList& objects,
    fvMesh& mesh,
    DynamicList<word>& names
)
{
    read<GeometricField<Type, fvPatchField, volMesh>>(objects, mesh, names);
    read<GeometricField<Type, fvsPatchField, surfaceMesh>>
    (
        objects, mesh, names
    );
    read<GeometricField<Type, pointPatchField, pointMesh>>
    (
        objects, foamCompat::pointMeshOf(mesh), names
    );
}


//- What a change made of some labels
static labelHashSet changedTo(const labelHashSet& old, const labelUList& map)
{
    labelHashSet made;
    forAll(map, i)
    {
        if (map[i] >= 0 && old.found(map[i]))
        {
            made.insert(i);
        }
    }
    return made;
}


template<class Set>
static void readSets
(
    const IOobjectList& objects,
    const fvMesh& mesh,
    PtrList<topoSet>& sets
)
{
    for (const word& name : objects.sortedNames(Set::typeName))
    {
        sets.append(new Set(*objects.findObject(name)));
    }
}


template<class Set>
static void writeSet
(
    const fvMesh& mesh,
    const topoSet& set,
    const labelUList& map
)
{
    if (isA<Set>(set))
    {
        Set(mesh, set.name(), changedTo(set, map)).write();
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Functions  * * * * * * * * * * * * * * * //

Foam::wordList Foam::allFields::read(fvMesh& mesh)
{
    const IOobjectList objects(mesh, mesh.time().timeName());
    DynamicList<word> names;
    readAll<scalar>(objects, mesh, names);
    readAll<vector>(objects, mesh, names);
    readAll<sphericalTensor>(objects, mesh, names);
    readAll<symmTensor>(objects, mesh, names);
    readAll<tensor>(objects, mesh, names);
    return wordList(names);
}


Foam::PtrList<Foam::topoSet> Foam::allFields::readSets(const fvMesh& mesh)
{
    const IOobjectList objects
    (
        mesh, mesh.facesInstance(), polyMesh::meshSubDir/"sets"
    );
    PtrList<topoSet> sets;
    Foam::readSets<cellSet>(objects, mesh, sets);
    Foam::readSets<faceSet>(objects, mesh, sets);
    Foam::readSets<pointSet>(objects, mesh, sets);
    return sets;
}


void Foam::allFields::writeSets
(
    const fvMesh& mesh,
    const UPtrList<topoSet>& sets,
    const mapPolyMesh& changed
)
{
    for (const topoSet& set : sets)
    {
        writeSet<cellSet>(mesh, set, changed.cellMap());
        writeSet<faceSet>(mesh, set, changed.faceMap());
        writeSet<pointSet>(mesh, set, changed.pointMap());
    }
}


// ************************************************************************* //
