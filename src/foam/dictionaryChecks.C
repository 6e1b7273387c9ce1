/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::dictionaryChecks::onlyKeys
(
    const dictionary& dict,
    const wordList& allowed
)
{
    for (const entry& e : dict)
    {
        if (!allowed.found(e.keyword()))
        {
            FatalIOErrorInFunction(dict)
                << "Unknown entry '" << e.keyword() << "'" << nl
                << "    Valid entries: " << plainText::listed(allowed).c_str() << nl
                << exit(FatalIOError);
        }
    }
}


Foam::scalar Foam::dictionaryChecks::getPositive
(
    const dictionary& dict,
    const word& key
)
{
    const token given(dict.lookup(key));
    const scalar value = given.isNumber() ? dict.get<scalar>(key) : -1;
    if (!(value > 0) || value > VGREAT)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << given
            << " but has to be a positive number" << nl
            << exit(FatalIOError);
    }
    return value;
}


Foam::string Foam::dictionaryChecks::firstOf(const string& message)
{
    if (!returnReduce(!message.empty(), orOp<bool>()))
    {
        return string::null;
    }

    List<string> messages(Pstream::nProcs());
    messages[Pstream::myProcNo()] = message;
    foamCompat::allGatherList(messages);
    for (const string& first : messages)
    {
        if (!first.empty())
        {
            return first;
        }
    }
    return string::null;
}


void Foam::dictionaryChecks::stopIf
(
    const dictionary& dict,
    const string& message
)
{
    const string first(firstOf(message));
    if (!first.empty())
    {
        FatalIOErrorInFunction(dict)
            << first.c_str() << nl << exit(FatalIOError);
    }
}


Foam::labelList Foam::dictionaryChecks::select
(
    const dictionary& dict,
    const word& key,
    const wordList& names
)
{
    labelHashSet selected;
    for (const wordRe& pattern : dict.get<wordRes>(key))
    {
        bool found = false;
        forAll(names, i)
        {
            if (pattern.match(names[i]))
            {
                found = true;
                selected.insert(i);
            }
        }
        if (!found)
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << key << "': nothing is called '" << pattern
                << "'" << nl
                << "    There are: " << plainText::listed(names).c_str() << nl
                << exit(FatalIOError);
        }
    }
    return selected.sortedToc();
}


// ************************************************************************* //
