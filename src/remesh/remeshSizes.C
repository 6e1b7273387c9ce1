/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remeshSizes.H"
#include "dictionaryChecks.H"
#include "movedGeometry.H"
#include "pointIOField.H"
#include "referencePoints.H"
#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const sizeName = "remeshSize";


//- points0 of the mesh, without the points in constant if the mesh is of
//  there, or else its points: where motion solvers find their reference
static pointField referenceOf(const fvMesh& mesh)
{
    const referencePoints::referenceFile points0File
    (
        referencePoints::find(mesh)
    );
    IOobject io(points0File.file);
    if (!points0File.found)
    {
        io.rename("points");
        io.instance() = mesh.time().constant();
        if
        (
            mesh.facesInstance() != io.instance()
         || mesh.pointsInstance() == io.instance()
        )
        {
            return mesh.points();
        }
    }
    const pointIOField points0(io);
    dictionaryChecks::stopIf
    (
        points0.objectPath(),
        points0.size() == mesh.nPoints()
      ? string()
      : string
        (
            points0.name() + " is of another mesh: it has "
          + Foam::name(points0.size()) + " points, the mesh "
          + Foam::name(mesh.nPoints()) + "\n    Remove it"
        )
    );
    return points0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::volScalarField& Foam::remeshSizes::of(const fvMesh& mesh)
{
    if (mesh.foundObject<volScalarField>(sizeName))
    {
        return mesh.lookupObjectRef<volScalarField>(sizeName);
    }
    const IOobject io
    (
        sizeName,
        mesh.time().timeName(),
        mesh,
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    );
    if (IOobject(io).typeHeaderOk<volScalarField>(true))
    {
        return regIOobject::store(new volScalarField(io, mesh));
    }

    const movedGeometry geometry(mesh, referenceOf(mesh));
    volScalarField* size = new volScalarField
    (
        io,
        mesh,
        dimensionedScalar(dimLength, Zero),
        zeroGradientFvPatchScalarField::typeName
    );
    forAll(*size, celli)
    {
        const label parts = mesh.cells()[celli].size() == 4 ? 1 : 2;
        (*size)[celli] = Foam::cbrt
        (
            max(geometry.cellVolumes()[celli], VSMALL)*6*Foam::sqrt(2.0)/parts
        );
    }
    size->correctBoundaryConditions();
    return regIOobject::store(size);
}


// ************************************************************************* //
