/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.


\*---------------------------------------------------------------------------*/

#include "ffdParameter.H"
#include "dictionaryChecks.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdParameter::ffdParameter(const dictionary& dict)
:
    dict_(dict),
    name_(dict.dictName()),
    function_(Function1<scalar>::New("value", dict)),
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
