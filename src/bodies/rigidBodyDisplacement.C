/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rigidBodyDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "bodyTree.H"
#include "dictionaryChecks.H"
#include "jointedBodies.H"
#include "StringStream.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(rigidBodyDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        rigidBodyDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rigidBodyDisplacement::rigidBodyDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(checked(dict, mesh), mesh),
    names_(dict.subDict("bodies").toc()),
    follows_(-1),
    bodies_
    (
        bodyInFlow::New<jointedBodies>
        (
            typeName + '.' + dict.parent().dictName(),
            mesh,
            this->dict(),
            wetPatches(dict, mesh)
        )
    )
{
    findBodies(patches);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::dictionary& Foam::rigidBodyDisplacement::checked
(
    const dictionary& dict,
    const polyMesh& mesh
)
{
    const wordList keys
    ({
        "type", "bodies", "solver", "restraints", "body", "rho", "rhoInf", "g",
        "ramp", "rampCoeffs", "nIter", "test", "report",
        "accelerationRelaxation", "accelerationDamping", "q", "qDot", "qDdot",
        "t", "deltaT"
    });

    for (const char* key : {"bodies", "solver"})
    {
        if (!dict.findDict(key) || dict.findDict(key)->empty())
        {
            FatalIOErrorInFunction(dict)
                << "A rigidBody displacement needs the dictionary '" << key
                << "'" << nl
                << "    Give it here, or take OpenFOAM's dictionary as it is:"
                << " $:rigidBodyMotionCoeffs;" << nl
                << exit(FatalIOError);
        }
    }
    if (dict.getOrDefault<label>("nIter", 1) < 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'nIter' is " << dict.get<label>("nIter") << nl
            << "    Give at least 1: one solution each time the mesh moves"
            << nl << exit(FatalIOError);
    }
    bodyTree::check(dict, mesh.time());
    bodyInFlow::nameUnread(dict, keys);
    return dict;
}


Foam::labelList Foam::rigidBodyDisplacement::patches
(
    const dictionary& body,
    const polyMesh& mesh
)
{
    return
        body.found("patches")
      ? bodyInFlow::selectPatches(body, mesh)
      : labelList();
}


Foam::wordList Foam::rigidBodyDisplacement::wetPatches
(
    const dictionary& dict,
    const polyMesh& mesh
)
{
    HashTable<word> owner;
    for (const entry& e : dict.subDict("bodies"))
    {
        for (const label patchi : patches(e.dict(), mesh))
        {
            const word& patch = mesh.boundaryMesh()[patchi].name();
            if (owner.found(patch))
            {
                FatalIOErrorInFunction(e.dict())
                    << "Patch '" << patch << "' belongs to two bodies: '"
                    << owner[patch] << "' has it as well" << nl
                    << "    Its forces would act on both. Leave it in the"
                    << " 'patches' of one of them" << nl
                    << exit(FatalIOError);
            }
            owner.insert(patch, e.keyword());
        }
    }
    if (owner.empty() && !dict.getOrDefault("test", false))
    {
        FatalIOErrorInFunction(dict)
            << "There are no patches on which the flow could move the bodies"
            << nl << "    Give the bodies 'patches', or 'test true' to move them"
            << " without a flow" << nl << exit(FatalIOError);
    }
    return owner.sortedToc();
}


void Foam::rigidBodyDisplacement::findBodies(const labelList& patches)
{
    label nWet = 0;
    forAll(names_, bodyi)
    {
        if (dict().subDict("bodies").subDict(names_[bodyi]).found("patches"))
        {
            ++nWet;
            follows_ = bodyi;
        }
    }
    if (dict().found("body"))
    {
        follows_ = names_.find(dict().get<word>("body"));
        if (follows_ < 0)
        {
            FatalIOErrorInFunction(dict())
                << "Entry 'body' is '" << dict().get<word>("body")
                << "', which is no body" << nl
                << "    Bodies: " << plainText::listed(names_).c_str() << nl
                << exit(FatalIOError);
        }
    }
    else if (names_.size() == 1)
    {
        follows_ = 0;
    }
    else if (nWet != 1)
    {
        follows_ = -1;
        findPoints();
    }
    if (follows_ < 0)
    {
        checkPatches(patches);
    }
}


void Foam::rigidBodyDisplacement::findPoints()
{
    bodyOf_ = labelList(mesh().nPoints(), labelMax);
    forAll(names_, bodyi)
    {
        const dictionary& body =
            dict().subDict("bodies").subDict(names_[bodyi]);
        for (const label patchi : patches(body, mesh()))
        {
            for (const label pointi : mesh().boundaryMesh()[patchi].meshPoints())
            {
                bodyOf_[pointi] = min(bodyOf_[pointi], bodyi);
            }
        }
    }
    syncTools::syncPointList(mesh(), bodyOf_, minEqOp<label>(), labelMax);
}


void Foam::rigidBodyDisplacement::checkPatches(const labelList& patches) const
{
    labelHashSet held;
    for (const entry& e : dict().subDict("bodies"))
    {
        held.insert(this->patches(e.dict(), mesh()));
    }
    const labelHashSet moved(patches);
    for (const label patchi : patches)
    {
        if (!held.found(patchi))
        {
            FatalIOErrorInFunction(dict())
                << "Patch '" << mesh().boundaryMesh()[patchi].name()
                << "' of the group belongs to no body" << nl
                << "    Write it into the 'patches' of the body that it moves"
                << " with, or take it out of the group" << nl
                << exit(FatalIOError);
        }
    }
    for (const label patchi : held.sortedToc())
    {
        if (!moved.found(patchi))
        {
            FatalIOErrorInFunction(dict())
                << "Patch '" << mesh().boundaryMesh()[patchi].name()
                << "' of a body is not in the group, so that nothing moves it"
                << nl
                << "    Write it into the 'patches' of the group" << nl
                << exit(FatalIOError);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::rigidBodyDisplacement::update()
{
    bodies_.update();
}


Foam::tmp<Foam::vectorField> Foam::rigidBodyDisplacement::displacement
(
    const points& p
) const
{
    if (follows_ >= 0)
    {
        return bodies_.transform(names_[follows_], p.positions) - p.positions;
    }

    string message;
    List<DynamicList<label>> places(names_.size());
    forAll(p.positions, i)
    {
        const label pointi = p.meshPoints[i];
        const label bodyi = pointi < 0 ? labelMax : bodyOf_[pointi];
        if (bodyi < names_.size())
        {
            places[bodyi].append(i);
        }
        else if (message.empty())
        {
            OStringStream text;
            text<< "The point at " << p.positions[i] << " is on the patches of"
                << " no body" << nl
                << "    Of zones and listed points 'body' says which body they"
                << " follow: give them a group of their own, with one body";
            message = text.str();
        }
    }
    dictionaryChecks::stopIf(dict(), message);

    auto result = tmp<vectorField>::New(p.positions.size());
    forAll(names_, bodyi)
    {
        const pointField positions(p.positions, places[bodyi]);
        UIndirectList<vector>(result.ref(), places[bodyi]) =
            bodies_.transform(names_[bodyi], positions) - positions;
    }
    return result;
}


// ************************************************************************* //
