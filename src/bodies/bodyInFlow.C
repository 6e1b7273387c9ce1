/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "bodyInFlow.H"
#include "dictionaryChecks.H"
#include "dimensionedVector.H"
#include "foamCompat.H"
#include "forces.H"
#include "plainText.H"
#include "pointDisplacementField.H"
#include "pointFields.H"
#include "Time.H"
#include "uniformDimensionedFields.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bodyInFlow::bodyInFlow
(
    const word& name,
    const polyMesh& mesh,
    const dictionary& coeffs,
    const wordList& patches,
    const word& others
)
:
    IOdictionary
    (
        IOobject
        (
            name,
            mesh.time().timeName(),
            "uniform",
            mesh,
            IOobject::READ_IF_PRESENT,
            IOobject::AUTO_WRITE
        )
    ),
    mesh_(mesh),
    coeffs_(coeffs),
    patches_(patches),
    test_(coeffs.getOrDefault("test", false)),
    rho_(coeffs.getOrDefault<word>("rho", "rho")),
    rhoInf_(1),
    timeIndex_(-1)
{
    if (rho_ == "rhoInf")
    {
        rhoInf_ = coeffs_.get<scalar>("rhoInf");
    }
    checkOtherBodies();
    checkConditions();

    const bool starts = dictionary::empty();
    if (starts && mesh.pointsInstance() != mesh.time().constant())
    {
        WarningInFunction
            << "The mesh has moved, but there is no " << objectPath() << nl
            << "    The body starts from the state in " << coeffs_.name() << nl
            << "    To continue a run of OpenFOAM's own solver copy its file "
            << others << " to that name" << endl;
    }
    if (!starts)
    {
        keepWallVelocity();
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::bodyInFlow::checkOtherBodies() const
{
    for (const word& other : mesh_.sortedNames<bodyInFlow>())
    {
        const auto& body = mesh_.lookupObject<bodyInFlow>(other);
        for (const word& patch : patches_)
        {
            if (&body != this && body.patches_.found(patch))
            {
                FatalIOErrorInFunction(coeffs_)
                    << "Patch '" << patch << "' belongs to two bodies: "
                    << body.coeffs_.name() << " has it as well" << nl
                    << "    Its forces would act on both. Leave it in the"
                    << " 'patches' of one of them" << nl
                    << exit(FatalIOError);
            }
        }
    }
}


void Foam::bodyInFlow::checkConditions() const
{
    const auto* field =
        mesh_.findObject<pointVectorField>("pointDisplacement");
    for (const word& patch : patches_)
    {
        const label patchi = mesh_.boundaryMesh().findPatchID(patch);
        if (!field || patchi < 0)
        {
            continue;
        }
        const word type
        (
            pointDisplacementField::condition
            (
                *field, mesh_.boundaryMesh()[patchi]
            ).type()
        );
        if (type.find("igidBodyDisplacement") != string::npos)
        {
            FatalIOErrorInFunction(coeffs_)
                << "Patch '" << patch << "' is a body here and in "
                << field->objectPath() << ", by its condition " << type << nl
                << "    Two solvers would move one body. Give the patch the"
                << " condition calculated there" << nl << exit(FatalIOError);
        }
    }
}


void Foam::bodyInFlow::keepWallVelocity()
{
    // A mesh that has read its meshPhi counts as moving, so that solvers which
    // correct their fluxes at the start evaluate movingWallVelocity, from
    // points that have not moved: without what walls have along themselves, and
    // the first forces lack that friction
    const_cast<polyMesh&>(mesh_).moving(false);
}


// * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * * //

Foam::vector Foam::bodyInFlow::gravity() const
{
    dimensionedVector given("g", dimAcceleration, Zero);
    const bool hasOwn = given.readIfPresent(coeffs_);
    if (!mesh_.time().foundObject<uniformDimensionedVectorField>("g"))
    {
        return given.value();
    }

    const auto& field =
        mesh_.time().lookupObject<uniformDimensionedVectorField>("g");
    if (hasOwn && given.value() != field.value())
    {
        FatalIOErrorInFunction(coeffs_)
            << "Entry 'g' is " << given.value() << " but the flow has "
            << field.value() << " in " << field.objectPath() << nl
            << "    Body and flow need one gravity. Remove the entry" << nl
            << exit(FatalIOError);
    }
    return field.value();
}


void Foam::bodyInFlow::addFlow
(
    const wordList& patches,
    const point& centre,
    vector& force,
    vector& moment
) const
{
    if (test_ || patches.empty())
    {
        return;
    }
    dictionary dict;
    dict.add("type", functionObjects::forces::typeName);
    dict.add("patches", patches);
    dict.add("rhoInf", rhoInf_);
    dict.add("rho", rho_);
    dict.add("CofR", centre);
    functionObjects::forces flow("forces", mesh_, dict);
    foamCompat::calculateForces(flow);
    force += flow.forceEff();
    moment += flow.momentEff();
}


bool Foam::bodyInFlow::startsTimeStep()
{
    const bool first = timeIndex_ != time().timeIndex();
    timeIndex_ = time().timeIndex();
    return first;
}


void Foam::bodyInFlow::announce
(
    const bool continues,
    const string& where
) const
{
    Info<< name() << ": " << (continues ? "continues" : "starts") << " with "
        << where.c_str();
    if (test_)
    {
        Info<< ", without forces of a flow" << endl;
    }
    else
    {
        Info<< ", forces of " << plainText::listed(patches_).c_str() << endl;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::labelList Foam::bodyInFlow::selectPatches
(
    const dictionary& dict,
    const polyMesh& mesh
)
{
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    wordList names(boundary.names());
    names.setSize(boundary.nNonProcessor());
    const label nPatches = names.size();
    names.append(boundary.groupPatchIDs().sortedToc());

    labelHashSet selected;
    for (const label i : dictionaryChecks::select(dict, "patches", names))
    {
        if (i < nPatches)
        {
            selected.insert(i);
        }
        else
        {
            selected.insert(boundary.groupPatchIDs()[names[i]]);
        }
    }
    return selected.sortedToc();
}


void Foam::bodyInFlow::nameUnread
(
    const dictionary& dict,
    const wordList& keys
)
{
    wordList unread;
    for (const word& key : dict.toc())
    {
        if (!keys.found(key) && key != "FoamFile")
        {
            unread.append(key);
        }
    }
    if (unread.size())
    {
        IOWarningInFunction(dict)
            << "Nothing reads the entries "
            << plainText::listed(unread).c_str() << nl
            << "    Variables of the dictionary may stay. How far from the body"
            << " the mesh moves is the matter of 'supportRadius'" << endl;
    }
}


// ************************************************************************* //
