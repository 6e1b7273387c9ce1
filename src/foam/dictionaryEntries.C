/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "dictionaryEntries.H"
#include "finiteNumbers.H"
#include "ITstream.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::dictionaryChecks::getNumber
(
    const dictionary& dict,
    const word& key,
    const scalar otherwise
)
{
    const entry* given = dict.findEntry(key);
    if (!given)
    {
        return otherwise;
    }
    bool good = false;
    if (!given->isDict())
    {
        ITstream& tokens = given->stream();
        good = tokens.size() == 1 && tokens[0].isNumber();
    }
    if (!good)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' has to be a number" << nl
            << exit(FatalIOError);
    }
    return dict.get<scalar>(key);
}


Foam::vector Foam::dictionaryChecks::getVector
(
    const dictionary& dict,
    const word& key
)
{
    // Products of three, as in volumes, stay finite
    const scalar most = finiteNumbers::largest;
    if (dict.isDict(key))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is a dictionary but has to be a vector"
            << nl << "    Write " << key << " (x y z);" << nl
            << exit(FatalIOError);
    }
    const vector given(dict.get<vector>(key));
    if (!(cmptMax(cmptMag(given)) < most))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << given
            << ", which is beyond all measure" << nl
            << "    Give metres, or degrees where it is an angle" << nl
            << exit(FatalIOError);
    }
    return given;
}


const Foam::dictionary& Foam::dictionaryChecks::subDict
(
    const dictionary& dict,
    const word& key
)
{
    const dictionary* found = dict.findDict(key);
    if (!found)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' "
            << (dict.found(key) ? "is no dictionary" : "is missing") << nl
            << "    Write " << key << " { ... }" << nl << exit(FatalIOError);
    }
    return *found;
}


// ************************************************************************* //
