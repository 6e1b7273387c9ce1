/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "sixDoFRigidBody.H"
#include "StringStream.H"
#include "Time.H"

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
    bodyInFlow(name, mesh, coeffs, patches, "sixDoFRigidBodyMotionState"),
    deltaT_(0),
    deltaT0_(0)
{
    start();
    dictionary::clear();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::sixDoFRigidBody::start()
{
    const dictionary& state = *this;
    const bool continues = !state.empty();
    if (continues)
    {
        spendFirstAcceleration(time());
        deltaT_ = state.getOrDefault<scalar>("deltaT", 0);
    }
    motion_.reset
    (
        new sixDoFRigidBodyMotion
        (
            coeffs(), continues ? state : coeffs(), time()
        )
    );
    OStringStream where;
    where<< "centre of mass " << motion_->centreOfMass();
    announce(continues, where.str());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sixDoFRigidBody::update()
{
    const bool first = startsTimeStep();
    if (first)
    {
        motion_->newTime();
        deltaT0_ = deltaT_ > 0 ? deltaT_ : time().deltaT0Value();
        deltaT_ = time().deltaTValue();
    }

    const vector weight(motion_->mass()*gravity());
    vector force(weight);
    vector moment(motion_->momentArm() ^ weight);
    addFlow(patches(), motion_->centreOfRotation(), force, moment);
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
