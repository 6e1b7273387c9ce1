/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdParameter.H"
#include "dictionaryEntries.H"
#include "foamCompat.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const dictionary& checked(const dictionary& dict)
{
    dictionaryChecks::onlyKeys
    (
        dict, {"min", "max", "moves"}, {"value", "valueCoeffs"}
    );
    return dict;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdParameter::ffdParameter
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    dict_(checked(dict)),
    name_(dict.dictName()),
    function_
    (
        dictionaryChecks::naming
        (
            dict,
            "value",
            [&]{ return foamCompat::function1<scalar>("value", dict, registry); }
        )
    ),
    min_(dictionaryChecks::getNumber(dict, "min", -GREAT)),
    max_(dictionaryChecks::getNumber(dict, "max", GREAT)),
    moves_(dict.lookup("moves")),
    generated_(false),
    value_(0)
{
    for (const auto& move : moves_)
    {
        dictionaryChecks::checkLengths(dict_, "moves", move.second());
    }
    if (name_.size() > 100)
    {
        FatalIOErrorInFunction(dict_)
            << "The name of the parameter has " << label(name_.size())
            << " characters" << nl
            << "    Files are called after it: give it at most 100" << nl
            << exit(FatalIOError);
    }
    checkBounds();
    if (moves_.empty())
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'moves' is empty: the parameter does nothing" << nl
            << "    List points of the lattice and what they move by, for"
            << " example ( ((3 5 3) (0 1 0)) )" << nl << exit(FatalIOError);
    }
}


Foam::ffdParameter::ffdParameter
(
    const dictionary& dict,
    const wordList& keys,
    const objectRegistry* registry
)
:
    dict_(dict),
    name_(dict.dictName()),
    function_(foamCompat::function1<scalar>("value", dict, registry)),
    min_(dictionaryChecks::getNumber(dict, "min", -GREAT)),
    max_(dictionaryChecks::getNumber(dict, "max", GREAT)),
    generated_(false),
    value_(0)
{
    dictionaryChecks::onlyKeys(dict, keys);
    checkBounds();
}


Foam::ffdParameter::ffdParameter
(
    const word& name,
    const dictionary& dict,
    const dictionary& valueDict,
    const word& key,
    const moveList& moves,
    const objectRegistry* registry
)
:
    dict_(dict),
    name_(name),
    function_(foamCompat::function1<scalar>(key, valueDict, registry)),
    min_(dictionaryChecks::getNumber(dict, "min", -GREAT)),
    max_(dictionaryChecks::getNumber(dict, "max", GREAT)),
    moves_(moves),
    generated_(true),
    value_(0)
{
    checkBounds();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdParameter::checkBounds() const
{
    if (max_ < min_)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'max' is " << max_ << ", which is less than 'min', "
            << min_ << nl << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ffdParameter::setValue(const scalar value)
{
    if (!std::isfinite(value) || !(value >= min_ && value <= max_))
    {
        FatalIOErrorInFunction(dict_)
            << "Parameter '" << name_ << "' has the value " << value
            << ", but it has to be from " << min_ << " to " << max_ << nl
            << "    Change the entry 'value', or its bounds 'min' and 'max'"
            << nl << exit(FatalIOError);
    }
    value_ = value;
}


// ************************************************************************* //
