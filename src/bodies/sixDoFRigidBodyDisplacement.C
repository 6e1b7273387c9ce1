/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "sixDoFRigidBodyDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "sixDoFRigidBody.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(sixDoFRigidBodyDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        sixDoFRigidBodyDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sixDoFRigidBodyDisplacement::sixDoFRigidBodyDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label
)
:
    prescribedDisplacement(checked(dict), mesh),
    body_
    (
        bodyInFlow::New<sixDoFRigidBody>
        (
            typeName + '.' + dict.parent().dictName(),
            mesh,
            this->dict(),
            wetPatches(dict, mesh, patches)
        )
    )
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::dictionary& Foam::sixDoFRigidBodyDisplacement::checked
(
    const dictionary& dict
)
{
    const wordList keys
    ({
        "type", "mass", "centreOfMass", "momentOfInertia", "solver",
        "constraints", "restraints", "patches", "rho", "rhoInf", "g", "test",
        "report", "accelerationRelaxation", "accelerationDamping",
        "orientation", "initialOrientation", "initialCentreOfMass",
        "centreOfRotation", "velocity", "acceleration", "angularMomentum",
        "torque"
    });

    for (const char* key : {"mass", "centreOfMass", "momentOfInertia", "solver"})
    {
        if (!dict.found(key))
        {
            FatalIOErrorInFunction(dict)
                << "A sixDoFRigidBody needs the entry '" << key << "'" << nl
                << "    Give it here, or take OpenFOAM's dictionary as it is:"
                << " $:sixDoFRigidBodyMotionCoeffs;" << nl
                << exit(FatalIOError);
        }
    }
    dictionaryChecks::getPositive(dict, "mass");

    const vector inertia(dict.get<vector>("momentOfInertia"));
    if (!(cmptMin(inertia) > 0))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'momentOfInertia' is " << inertia
            << " but has to be three positive numbers" << nl
            << "    Directions in which the body cannot turn are a matter of"
            << " 'constraints'" << nl << exit(FatalIOError);
    }

    bodyInFlow::nameUnread(dict, keys);
    return dict;
}


Foam::wordList Foam::sixDoFRigidBodyDisplacement::wetPatches
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches
)
{
    const wordList wet
    (
        UIndirectList<word>
        (
            mesh.boundaryMesh().names(),
            dict.found("patches")
          ? bodyInFlow::selectPatches(dict, mesh)
          : patches
        )
    );

    if (wet.empty() && !dict.getOrDefault("test", false))
    {
        FatalIOErrorInFunction(dict)
            << "There are no patches on which the flow could move the body"
            << nl << "    Give it 'patches', or 'test true' to move it without"
            << " a flow" << nl << exit(FatalIOError);
    }
    return wet;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sixDoFRigidBodyDisplacement::update()
{
    body_.update();
}


Foam::tmp<Foam::vectorField> Foam::sixDoFRigidBodyDisplacement::displacement
(
    const points& p
) const
{
    auto result = tmp<vectorField>::New(p.positions.size());
    forAll(p.positions, i)
    {
        result.ref()[i] = body_.transform(p.positions[i]) - p.positions[i];
    }
    return result;
}


// ************************************************************************* //
