/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "jointedBodies.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "plainText.H"
#include "Time.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// As a list in ascii, whatever the format of the file
static void writeNumbers(Ostream& os, const word& key, const scalarField& values)
{
    os.writeKeyword(key)<< token::BEGIN_LIST;
    forAll(values, i)
    {
        os<< (i ? " " : "") << values[i];
    }
    os<< token::END_LIST << token::END_STATEMENT << nl;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::jointedBodies::jointedBodies
(
    const word& name,
    const polyMesh& mesh,
    const dictionary& coeffs,
    const wordList& patches
)
:
    bodyInFlow(name, mesh, coeffs, patches, "rigidBodyMotionState"),
    names_(coeffs.subDict("bodies").toc()),
    wet_(names_.size()),
    ramp_
    (
        coeffs.found("ramp")
      ? dictionaryChecks::naming
        (
            coeffs,
            "ramp",
            [&]
            {
                return foamCompat::function1<scalar>("ramp", coeffs, &mesh);
            }
        )
      : nullptr
    ),
    nIter_(coeffs.getOrDefault<label>("nIter", 1))
{
    forAll(names_, bodyi)
    {
        const dictionary& body = coeffs.subDict("bodies").subDict(names_[bodyi]);
        if (body.found("patches"))
        {
            wet_[bodyi] = UIndirectList<word>
            (
                mesh.boundaryMesh().names(), selectPatches(body, mesh)
            );
        }
    }
    start();
    dictionary::clear();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::jointedBodies::start()
{
    const dictionary& own = *this;
    const bool continues = !own.empty();
    const dictionary& state = continues ? own : coeffs();
    const auto make = [&]
    {
        return autoPtr<RBD::rigidBodyMotion>
        (
            new RBD::rigidBodyMotion(time(), coeffs(), state)
        );
    };
    motion_ = dictionaryChecks::naming(state, continues ? "q" : "bodies", make);

    OStringStream where;
    where<< "bodies " << plainText::listed(names_).c_str() << ", joints at "
        << flatOutput(motion_->state().q());
    announce(continues, where.str());
}


Foam::Field<Foam::spatialVector> Foam::jointedBodies::forces
(
    const scalar factor
) const
{
    Field<spatialVector> result(motion_->nBodies(), Zero);
    forAll(names_, bodyi)
    {
        vector force(Zero);
        vector moment(Zero);
        addFlow(wet_[bodyi], point(Zero), force, moment);

        // What is merged with another body acts on that one
        const label i = motion_->master(motion_->bodyID(names_[bodyi]));
        result[i] += factor*spatialVector(moment, force);
    }
    return result;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::jointedBodies::update()
{
    if (startsTimeStep())
    {
        motion_->newTime();
    }

    const scalar ramp = ramp_.valid() ? ramp_->value(time().value()) : 1;
    motion_->g() = ramp*gravity();
    const Field<spatialVector> forces(this->forces(ramp));
    for (label i = 0; i < nIter_; ++i)
    {
        motion_->solve
        (
            time().value(),
            time().deltaTValue(),
            scalarField(motion_->nDoF(), Zero),
            forces
        );
    }

    if (motion_->report())
    {
        for (const word& body : names_)
        {
            motion_->status(motion_->bodyID(body));
        }
    }
}


bool Foam::jointedBodies::writeData(Ostream& os) const
{
    const int precision =
        os.precision(std::numeric_limits<scalar>::max_digits10);
    const RBD::rigidBodyModelState& state = motion_->state();
    writeNumbers(os, "q", state.q());
    writeNumbers(os, "qDot", state.qDot());
    writeNumbers(os, "qDdot", state.qDdot());
    os.writeEntry("t", state.t());
    os.writeEntry("deltaT", state.deltaT());
    os.precision(precision);
    return os.good();
}


// ************************************************************************* //
