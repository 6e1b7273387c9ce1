/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "sixDoFRigidBody.H"
#include "dimensionedVector.H"
#include "foamCompat.H"
#include "forces.H"
#include "plainText.H"
#include "Time.H"
#include "uniformDimensionedFields.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// sixDoFRigidBodyMotion does not relax the first acceleration of a process. A
// run that continues has had its first one
static void spendFirstAcceleration(const Time& time)
{
    dictionary solver;
    solver.add("type", "symplectic");
    dictionary coeffs;
    coeffs.add("mass", 1);
    coeffs.add("centreOfMass", vector(Zero));
    coeffs.add("momentOfInertia", diagTensor(1, 1, 1));
    coeffs.add("solver", solver);
    sixDoFRigidBodyMotion(coeffs, coeffs, time).update(true, Zero, Zero, 1, 1);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sixDoFRigidBody::sixDoFRigidBody
(
    const word& name,
    const polyMesh& mesh,
    const dictionary& coeffs,
    const wordList& patches
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
    deltaT_(0),
    deltaT0_(0),
    timeIndex_(-1)
{
    if (rho_ == "rhoInf")
    {
        rhoInf_ = coeffs_.get<scalar>("rhoInf");
    }
    checkOtherBodies();
    start();
    dictionary::clear();
}


Foam::sixDoFRigidBody& Foam::sixDoFRigidBody::New
(
    const word& name,
    const polyMesh& mesh,
    const dictionary& coeffs,
    const wordList& patches
)
{
    if (!mesh.foundObject<sixDoFRigidBody>(name))
    {
        regIOobject::store(new sixDoFRigidBody(name, mesh, coeffs, patches));
    }
    return mesh.lookupObjectRef<sixDoFRigidBody>(name);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::sixDoFRigidBody::start()
{
    const dictionary& state = *this;
    const bool continues = !state.empty();
    if (continues)
    {
        spendFirstAcceleration(mesh_.time());
        deltaT_ = state.getOrDefault<scalar>("deltaT", 0);
    }
    else if (mesh_.pointsInstance() != mesh_.time().constant())
    {
        WarningInFunction
            << "The mesh has moved, but there is no " << objectPath() << nl
            << "    The body starts from the state in " << coeffs_.name() << nl
            << "    To continue a run of OpenFOAM's sixDoFRigidBodyMotion copy"
            << " its file sixDoFRigidBodyMotionState to that name" << endl;
    }
    motion_.reset
    (
        new sixDoFRigidBodyMotion
        (
            coeffs_, continues ? state : coeffs_, mesh_.time()
        )
    );
    Info<< name() << ": "
        << (continues ? "continues" : "starts") << " with centre of mass "
        << motion_->centreOfMass();
    if (test_)
    {
        Info<< ", without forces of a flow" << endl;
    }
    else
    {
        Info<< ", forces of "
            << plainText::listed(patches_).c_str() << endl;
    }
}


void Foam::sixDoFRigidBody::checkOtherBodies() const
{
    for (const word& other : mesh_.sortedNames<sixDoFRigidBody>())
    {
        const auto& body = mesh_.lookupObject<sixDoFRigidBody>(other);
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


Foam::vector Foam::sixDoFRigidBody::gravity() const
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


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sixDoFRigidBody::update()
{
    const Time& time = mesh_.time();
    const bool first = timeIndex_ != time.timeIndex();
    if (first)
    {
        timeIndex_ = time.timeIndex();
        motion_->newTime();
        deltaT0_ = deltaT_ > 0 ? deltaT_ : time.deltaT0Value();
        deltaT_ = time.deltaTValue();
    }

    const vector weight(motion_->mass()*gravity());
    vector force(weight);
    vector moment(motion_->momentArm() ^ weight);
    if (!test_)
    {
        dictionary dict;
        dict.add("type", functionObjects::forces::typeName);
        dict.add("patches", patches_);
        dict.add("rhoInf", rhoInf_);
        dict.add("rho", rho_);
        dict.add("CofR", motion_->centreOfRotation());
        functionObjects::forces flow("forces", mesh_, dict);
        foamCompat::calculateForces(flow);
        force += flow.forceEff();
        moment += flow.momentEff();
    }
    motion_->update(first, force, moment, deltaT_, deltaT0_);
}


bool Foam::sixDoFRigidBody::writeData(Ostream& os) const
{
    const int precision =
        os.precision(std::numeric_limits<scalar>::max_digits10);
    motion_->state().write(os);
    os.writeEntry("deltaT", deltaT_);
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
