/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "shapeConstraints.H"
#include "IOmanip.H"
#include "OFstream.H"
#include "Pstream.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static void writeName(Ostream& os, const word& name)
{
    os  << name.c_str();
    for (label n = name.size(); n < 24; ++n)
    {
        os  << ' ';
    }
}


static void writeBound(Ostream& os, const scalar bound)
{
    if (mag(bound) > 0.5*GREAT)
    {
        os  << ' ' << setw(24) << "none";
    }
    else
    {
        os  << ' ' << setw(24) << bound;
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::shapeConstraints::shapeConstraints
(
    const dictionary& dict,
    const pointField& points,
    const faceList& faces
)
:
    surface_(points, faces)
{
    const bool closed = surface_.closed();
    for (const entry& e : dict)
    {
        if (e.keyword() == "patches")
        {
            continue;
        }
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' has to be a dictionary: "
                << e.keyword() << " { type volume; min 1; }" << nl
                << exit(FatalIOError);
        }
        if (Pstream::master())
        {
            constraints_.append
            (
                new shapeConstraint
                (
                    e.dict(), surface_.points(), surface_.triangles(), closed
                )
            );
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordRes Foam::shapeConstraints::patches(const dictionary& dict)
{
    return dict.get<wordRes>("patches");
}


void Foam::shapeConstraints::evaluate
(
    const pointField& moved,
    const wordList& parameters,
    const std::function<tmp<vectorField>(const label)>& derivative
)
{
    const morph::Vectors points(surface_.gather(moved));
    values_.clear();
    for (const shapeConstraint& constraint : constraints_)
    {
        for (auto& value : constraint.values(points))
        {
            values_.push_back(std::move(value));
        }
    }
    parameters_ = parameters;
    derivatives_.setSize(parameters.size());
    forAll(parameters, i)
    {
        const morph::Vectors velocities(surface_.gather(derivative(i)()));
        derivatives_[i].clear();
        for (const auto& value : values_)
        {
            derivatives_[i].append(value.derivative(velocities));
        }
    }
}


void Foam::shapeConstraints::writeValues(Ostream& os) const
{
    os  << "# constraint            ";
    for (const char* title : {"value", "before", "min", "max", "violation"})
    {
        os  << ' ' << setw(24) << title;
    }
    os  << endl;
    std::size_t number = 0;
    for (const shapeConstraint& constraint : constraints_)
    {
        forAll(constraint.names(), i)
        {
            const scalar value = values_[number++].value;
            writeName(os, constraint.names()[i]);
            os  << ' ' << setw(24) << value
                << ' ' << setw(24) << constraint.before()[i];
            writeBound(os, constraint.min());
            writeBound(os, constraint.max());
            os  << ' ' << setw(24)
                << max
                   (
                       max(constraint.min() - value, value - constraint.max()),
                       scalar(0)
                   )
                << endl;
        }
    }
}


void Foam::shapeConstraints::writeDerivatives(Ostream& os) const
{
    os  << "# constraint            ";
    for (const word& name : parameters_)
    {
        os  << ' ' << setw(24) << name.c_str();
    }
    os  << endl;
    label number = 0;
    for (const shapeConstraint& constraint : constraints_)
    {
        for (const word& name : constraint.names())
        {
            writeName(os, name);
            for (const scalarList& derivative : derivatives_)
            {
                os  << ' ' << setw(24) << derivative[number];
            }
            os  << endl;
            ++number;
        }
    }
}


void Foam::shapeConstraints::write(const fileName& prefix) const
{
    if (Pstream::master())
    {
        const int digits = std::numeric_limits<scalar>::max_digits10;
        OFstream values(prefix + "constraints.dat");
        values.precision(digits);
        writeValues(values);
        OFstream derivatives(prefix + "constraintDerivatives.dat");
        derivatives.precision(digits);
        writeDerivatives(derivatives);
        Info<< nl;
        writeValues(Info());
    }
    Info<< "Wrote " << prefix.c_str() << "constraints.dat and "
        << prefix.c_str() << "constraintDerivatives.dat" << endl;
}


// ************************************************************************* //
