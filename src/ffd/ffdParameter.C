/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdParameter.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdParameter::ffdParameter
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    dict_(dict),
    name_(dict.dictName()),
    function_(foamCompat::function1<scalar>("value", dict, registry)),
    min_(dict.getOrDefault<scalar>("min", -GREAT)),
    max_(dict.getOrDefault<scalar>("max", GREAT)),
    moves_(dict.lookup("moves")),
    value_(0)
{
    dictionaryChecks::onlyKeys
    (
        dict, {"value", "valueCoeffs", "min", "max", "moves"}
    );
    if (max_ < min_)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'max' is " << max_ << ", which is less than 'min', "
            << min_ << nl << exit(FatalIOError);
    }
    if (moves_.empty())
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'moves' is empty: the parameter does nothing" << nl
            << "    List points of the lattice and what they move by, for"
            << " example ( ((3 5 3) (0 1 0)) )" << nl << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ffdParameter::setValue(const scalar value)
{
    if (!(value >= min_ && value <= max_))
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
