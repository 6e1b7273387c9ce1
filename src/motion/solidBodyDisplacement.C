/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "solidBodyDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "difference.hpp"
#include "transformField.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(solidBodyDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        solidBodyDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// The dictionary, without coefficients that the function would not read
static const dictionary& checked(const dictionary& dict)
{
    const word name(dict.get<word>("solidBodyMotionFunction"));
    const word coeffs(name + "Coeffs");
    if (dict.found(coeffs))
    {
        dictionaryChecks::onlyKeys
        (
            dict, {"type", "solidBodyMotionFunction", name + "Coeffs"}
        );
    }
    for (const entry& e : dict)
    {
        if (e.keyword().ends_with("Coeffs") && e.keyword() != coeffs)
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' belongs to another"
                << " solidBodyMotionFunction than '"
                << name << "'" << nl
                << "    Call it '" << coeffs << "', or write its entries"
                << " beside 'solidBodyMotionFunction'" << nl
                << exit(FatalIOError);
        }
    }
    return dict;
}


//- First step of differences, in units of a number
static const scalar step = 0.1;

//- What they may be off by, in units of the derivative
static const scalar differenceTolerance = 1e-9;


//- Does not tell the log of functions that it makes
class silent
{
    const int former_;

public:

    silent()
    :
        former_(messageStream::level)
    {
        messageStream::level = 0;
    }

    ~silent()
    {
        messageStream::level = former_;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::solidBodyDisplacement::solidBodyDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    motion_
    (
        dictionaryChecks::naming
        (
            dict,
            "solidBodyMotionFunction",
            [&]
            {
                return solidBodyMotionFunction::New(checked(dict), mesh.time());
            }
        )
    )
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Eigen::VectorXd Foam::solidBodyDisplacement::frame
(
    const label numberi,
    const scalar value
) const
{
    const untrapped numbers;
    const silent log;
    const autoPtr<solidBodyMotionFunction> motion
    (
        solidBodyMotionFunction::New
        (
            numbers_->with(numberi, value), mesh().time()
        )
    );
    pointField x(4, mesh().bounds().centre());
    for (direction c = 0; c < vector::nComponents; ++c)
    {
        x[c + 1] += mesh().bounds().mag()*unit(c);
    }
    const vectorField moved(transformPoints(motion().transformation(), x));
    return Eigen::Map<const Eigen::VectorXd>(moved.cdata()->cdata(), 12);
}


const Foam::dictionaryNumbers& Foam::solidBodyDisplacement::numbers() const
{
    if (numbers_.valid())
    {
        return numbers_();
    }
    numbers_.reset
    (
        new dictionaryNumbers(dict(), {"type", "solidBodyMotionFunction"})
    );
    for (label i = numbers_->size() - 1; i >= 0; --i)
    {
        // A count, say, that can be no other number
        bool smooth = false;
        try
        {
            const throwing errors;
            const scalar value = numbers_()[i].value;
            smooth =
                frame(i, value + 1e-3*max(numbers_->magnitude(i), SMALL))
               .allFinite();
        }
        catch (const Foam::error&)
        {}
        if (!smooth)
        {
            numbers_->remove(i);
        }
    }
    return numbers_();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::solidBodyDisplacement::displacement
(
    const points& p
) const
{
    // What is not finite is found where it is used
    const untrapped numbers;
    return
        transformPoints(motion_().transformation(), p.positions)
      - p.positions;
}


Foam::List<Foam::motionParameter> Foam::solidBodyDisplacement::parameters
(
    const word& group
) const
{
    List<motionParameter> list(numbers().size());
    forAll(list, i)
    {
        list[i] = numbers()[i];
        list[i].name = group + '.' + list[i].name;
    }
    return list;
}


Foam::tmp<Foam::vectorField> Foam::solidBodyDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    const motionParameter parameter(numbers()[parameteri]);
    const scalar size = numbers().magnitude(parameteri);
    const scalar span = mesh().bounds().mag();
    const untrapped computing;
    const morph::Difference d = morph::difference
    (
        [&](const scalar value) { return frame(parameteri, value); },
        parameter.value,
        step*(size > SMALL ? size : min(span, scalar(1)))
    );
    const scalar largest = d.derivative.size() ? d.derivative.norm() : 0;
    if (!(d.error <= differenceTolerance*max(largest, span)))
    {
        FatalIOErrorInFunction(dict())
            << "Displacement type 'solidBody' has no derivative by '"
            << parameter.name << "' = " << parameter.value << " at time "
            << mesh().time().timeName() << ": differences do not converge, by "
            << d.error << nl
            << "    The motion jumps there. Choose another time, or another"
            << " value" << nl << exit(FatalIOError);
    }

    vectorField corner(4);
    forAll(corner, i)
    {
        corner[i] =
            toFoam(morph::Vector3(d.derivative.segment<3>(3*i)));
    }
    auto result = tmp<vectorField>::New(p.positions.size(), corner[0]);
    forAll(p.positions, i)
    {
        const vector x = (p.positions[i] - mesh().bounds().centre())/span;
        for (direction c = 0; c < vector::nComponents; ++c)
        {
            result.ref()[i] += x[c]*(corner[c + 1] - corner[0]);
        }
    }
    return result;
}


// ************************************************************************* //
