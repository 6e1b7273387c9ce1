/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdAxis.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "PstreamReduceOps.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<morph::SectionAxis::Kind> Foam::ffdAxis::kindNames
({
    { morph::SectionAxis::Kind::twist, "twist" },
    { morph::SectionAxis::Kind::chord, "chord" },
    { morph::SectionAxis::Kind::thickness, "thickness" },
    { morph::SectionAxis::Kind::sweep, "sweep" },
    { morph::SectionAxis::Kind::dihedral, "dihedral" },
    { morph::SectionAxis::Kind::span, "span" }
});


const Foam::Enum<morph::AxisFunction::Kind> Foam::ffdAxis::lineNames
({
    { morph::AxisFunction::Kind::linear, "linear" },
    { morph::AxisFunction::Kind::spline, "spline" }
});


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdAxis::ffdAxis
(
    const dictionary& dict,
    PtrList<ffdParameter>& parameters,
    const objectRegistry* registry
)
:
    dict_(dict),
    first_(parameters.size())
{
    const pointField through(dict.get<pointField>("through"));
    if (through.size() < 2)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'through' lists " << through.size()
            << " points, but an axis needs two at least" << nl
            << "    Give the points that it goes through, in order" << nl
            << exit(FatalIOError);
    }

    const wordList variableKeys
    ({
        "type", "value", "valueCoeffs", "along", "line", "min", "max"
    });
    std::vector<morph::SectionAxis::Variable> variables;
    for (const entry& e : dictionaryChecks::subDict(dict, "variables"))
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Variable '" << e.keyword() << "' has to be a dictionary: "
                << e.keyword() << " { type twist; value 0; }" << nl
                << exit(FatalIOError);
        }
        const auto kind =
            dictionaryChecks::getChoice(e.dict(), "type", kindNames);
        parameters.append
        (
            new ffdParameter(e.dict(), variableKeys, registry)
        );
        kinds_.append(kind);
        variables.push_back({kind, readAlong(e.dict())});
    }
    if (kinds_.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'variables' is empty: the axis moves nothing" << nl
            << "    Write for example variables { washout { type twist;"
            << " value -3; } }" << nl << exit(FatalIOError);
    }
    values_.resize(std::size_t(kinds_.size()), 0.0);

    vector normal(through.last() - through.first());
    if (dict.found("normal"))
    {
        normal = dictionaryChecks::getVector(dict, "normal");
    }
    vector chord(1, 0, 0);
    if (dict.found("chord"))
    {
        chord = dictionaryChecks::getVector(dict, "chord");
    }
    if (!(mag(normal) > VSMALL))
    {
        FatalIOErrorInFunction(dict)
            << "The normal of the sections is " << normal
            << " but has to be a direction" << nl
            << "    Give 'normal', or an axis whose first and last point"
            << " differ" << nl << exit(FatalIOError);
    }
    try
    {
        axis_ = std::make_shared<morph::SectionAxis>
        (
            asVectors(through),
            dictionaryChecks::getChoice
            (
                dict, "line", lineNames, morph::AxisFunction::Kind::linear
            ),
            toEigen(normal),
            toEigen(chord),
            variables
        );
    }
    catch (const std::invalid_argument& wrong)
    {
        FatalIOErrorInFunction(dict)
            << "The axis through " << through << " is none: " << wrong.what()
            << nl << "    The normal of the sections is " << normal
            << ", the chord " << chord << ". Change 'through', 'normal' or"
            << " 'chord'" << nl << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::AxisFunction Foam::ffdAxis::readAlong(const dictionary& dict)
{
    List<Tuple2<scalar, scalar>> given
    ({
        Tuple2<scalar, scalar>(0, 0), Tuple2<scalar, scalar>(1, 1)
    });
    if (dict.found("along"))
    {
        given = List<Tuple2<scalar, scalar>>(dict.lookup("along"));
    }
    std::vector<double> at, values;
    for (const auto& pair : given)
    {
        at.push_back(pair.first());
        values.push_back(pair.second());
    }
    try
    {
        return morph::AxisFunction
        (
            at,
            values,
            dictionaryChecks::getChoice
            (
                dict, "line", lineNames, morph::AxisFunction::Kind::linear
            )
        );
    }
    catch (const std::invalid_argument& wrong)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'along' is " << given << ": " << wrong.what() << nl
            << "    List fractions of the axis and factors, for example"
            << " ((0 0) (0.5 0.2) (1 1))" << nl << exit(FatalIOError);
        throw;
    }
}


Foam::scalar Foam::ffdAxis::unit(const label variable) const
{
    return
        kinds_[variable] == morph::SectionAxis::Kind::twist
      ? degToRad(scalar(1))
      : 1;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::ffdAxis::keys()
{
    return {"through", "line", "normal", "chord", "variables"};
}


void Foam::ffdAxis::update(const PtrList<ffdParameter>& parameters)
{
    forAll(kinds_, i)
    {
        values_[std::size_t(i)] = unit(i)*parameters[first_ + i].value();
    }
}


morph::SectionAxis::Section Foam::ffdAxis::section(const scalar u) const
{
    return axis_->section(u, values_);
}


morph::SectionAxis::Section Foam::ffdAxis::byParameter
(
    const scalar u,
    const label parameteri
) const
{
    const label variable = parameteri - first_;
    auto section = axis_->byVariable(u, values_, std::size_t(variable));
    section.shift *= unit(variable);
    section.change *= unit(variable);
    return section;
}


morph::SectionAxis::Section Foam::ffdAxis::byFraction(const scalar u) const
{
    return axis_->byFraction(u, values_);
}


Foam::pointField Foam::ffdAxis::shown(const bool moved) const
{
    const label n = 20;
    pointField points(n + 1);
    forAll(points, i)
    {
        const scalar u = scalar(i)/n;
        morph::Vector3 x = axis_->at(u);
        if (moved)
        {
            x += section(u).shift;
        }
        points[i] = toFoam(x);
    }
    return points;
}


void Foam::ffdAxis::checkMet(const scalar least, const scalar most) const
{
    const scalar low = returnReduce(least, minOp<scalar>());
    const scalar high = returnReduce(most, maxOp<scalar>());
    if (low > 1 || high < 0)
    {
        FatalIOErrorInFunction(dict_)
            << "The axis meets no section: along the normal of the sections it"
            << " reaches from 0 to 1, what it has to move from " << low
            << " to " << high << nl
            << "    Let 'through' pass the body, or change 'normal'" << nl
            << exit(FatalIOError);
    }
}


// ************************************************************************* //
