/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionOrigin.H"
#include "foamCompat.H"
#include "Time.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const originName = "motionOrigin";


static IOobject originIO(const polyMesh& mesh, const IOobject::readOption read)
{
    return IOobject
    (
        originName, mesh.time().timeName(), mesh, read, IOobject::AUTO_WRITE
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

const Foam::pointVectorField* Foam::motionOrigin::of(const polyMesh& mesh)
{
    return mesh.findObject<pointVectorField>(originName);
}


void Foam::motionOrigin::read(const polyMesh& mesh)
{
    IOobject file(originIO(mesh, IOobject::MUST_READ));
    if (!of(mesh) && file.typeHeaderOk<pointVectorField>(true))
    {
        auto* field = new pointVectorField(file, foamCompat::pointMeshOf(mesh));
        field->store();
    }
}


void Foam::motionOrigin::start(const polyMesh& mesh, const pointField& points0)
{
    if (of(mesh))
    {
        return;
    }
    auto* field = new pointVectorField
    (
        originIO(mesh, IOobject::NO_READ),
        foamCompat::pointMeshOf(mesh),
        dimensionedVector(dimLength, Zero)
    );
    field->primitiveFieldRef() = points0;
    field->store();
}


// ************************************************************************* //
