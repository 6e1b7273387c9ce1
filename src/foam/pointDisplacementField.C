/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "pointDisplacementField.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "localIOdictionary.H"
#include "OSspecific.H"
#include "throwing.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Of the current time, neither registered nor read
static IOobject fieldIO(const polyMesh& mesh)
{
    return IOobject
    (
        "pointDisplacement",
        mesh.time().timeName(),
        mesh,
        IOobject::NO_READ,
        IOobject::AUTO_WRITE,
        false
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::pointVectorField Foam::pointDisplacementField::atRest
(
    const polyMesh& mesh
)
{
    return pointVectorField
    (
        fieldIO(mesh),
        foamCompat::pointMeshOf(mesh),
        dimensionedVector(dimLength, Zero)
    );
}


void Foam::pointDisplacementField::registerAndRead
(
    pointVectorField& pointDisplacement
)
{
    foamCompat::registerObject(pointDisplacement);

    IOobject file(fieldIO(pointDisplacement.mesh()()));
    file.readOpt() = IOobject::MUST_READ;
    string fault;
    try
    {
        const throwing errors;
        const untrapped numbers;
        const bool readable = file.typeHeaderOk<pointVectorField>(true);
        if (!readable && exists(file.objectPath()))
        {
            FatalErrorInFunction
                << "it is no pointVectorField" << nl
                << "    Remove it where it is not needed" << nl
                << exit(FatalError);
        }
        if (!readable)
        {
            return;
        }

        // Into the field that is there: some conditions cannot be copied before
        // they were evaluated, for example solidBodyMotionDisplacement
        const localIOdictionary dict(file, pointVectorField::typeName);
        dictionaryChecks::checkNumbers(dict);
        auto& internal = pointDisplacement.ref();
        internal.readField(dict, "internalField");
        pointDisplacement.boundaryFieldRef().readField
        (
            internal, dict.subDict("boundaryField")
        );
    }
    catch (const Foam::error& wrong)
    {
        fault = said(wrong);
    }
    catch (const std::exception& wrong)
    {
        fault = wrong.what();
    }
    if (!fault.empty())
    {
        // Not all ranks come here, and messages of OpenFOAM name no file
        const dictionary read(fileName(file.objectPath()));
        FatalIOErrorInFunction(read)
            << file.name() << " cannot be read: " << fault.c_str() << nl
            << "    Correct it" << nl << exit(FatalIOError);
    }
}


const Foam::pointPatchVectorField& Foam::pointDisplacementField::condition
(
    const pointVectorField& pointDisplacement,
    const polyPatch& patch
)
{
    const label patchi =
        pointDisplacement.mesh().boundary().findPatchID(patch.name());
    if (patchi < 0)
    {
        FatalErrorInFunction
            << "The mesh of points has no patch '" << patch.name()
            << "', which the mesh of faces has" << nl
            << "    Renew or remove polyMesh/pointMesh/boundary" << nl
            << exit(FatalError);
    }
    return pointDisplacement.boundaryField()[patchi];
}


Foam::label Foam::pointDisplacementField::patchIndex
(
    const pointPatchVectorField& condition
)
{
    return condition.patch().boundaryMesh().mesh()().boundaryMesh()
        .findPatchID(condition.patch().name());
}


// ************************************************************************* //
