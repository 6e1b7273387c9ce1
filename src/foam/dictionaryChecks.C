/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "dictionaryChecks.H"
#include "finiteNumbers.H"
#include "foamCompat.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// No list of ours that repeats one value is longer
static const label mostRepeated = 10000000;

// Squares and cubes of larger numbers are infinite
static const scalar largestNumber = 1e100;

// Larger ones are no input of anything
static const scalar largestInput = 1e250;


static void checkValue(const dictionary& dict, const entry& e)
{
    if (!e.isDict() && e.stream().empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << e.keyword() << "' has no value and is no dictionary" << nl
            << "    Give one, or remove the entry" << nl
            << exit(FatalIOError);
    }
}


static bool squarable(const scalar x)
{
    return std::isfinite(x) && x <= largestNumber && x >= -largestNumber;
}


static void wrongNumber(const dictionary& dict, const entry& e, const scalar x)
{
    FatalIOErrorInFunction(dict)
        << "Entry '" << e.keyword() << "': " << x << " is no number to"
        << " calculate with" << nl
        << "    Give one between " << -largestInput << " and " << largestInput
        << nl
        << exit(FatalIOError);
}


static void checkTokens(const dictionary& dict, const entry& e)
{
    const ITstream& tokens = e.stream();
    forAll(tokens, i)
    {
        const token& t = tokens[i];
        if
        (
            t.isNumber()
         && !(std::isfinite(t.number()) && mag(t.number()) <= largestInput)
        )
        {
            wrongNumber(dict, e, t.number());
        }
        // Within brackets it is the first of a pair, (37 (0 0 1)), and after
        // another number it does not count either: arc 30 31 (0 0 1)
        const bool pair =
            i > 0
         && (tokens[i - 1] == token::BEGIN_LIST || tokens[i - 1].isNumber());
        if (!t.isLabel() || i + 1 == tokens.size() || pair)
        {
            continue;
        }
        const token& next = tokens[i + 1];
        const label n = t.labelToken();
        const label most =
            next == token::BEGIN_LIST ? tokens.size() - i - 2
          : next == token::BEGIN_BLOCK ? mostRepeated
          : labelMax;
        if (most < labelMax && (n < 0 || n > most))
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "': a list in it cannot have "
                << n << " elements" << nl
                << "    Correct the number before the bracket, or remove it:"
                << " lists are counted without" << nl
                << exit(FatalIOError);
        }
    }
}

} // End namespace Foam


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


void Foam::dictionaryChecks::onlyKeys
(
    const dictionary& dict,
    const wordList& values,
    const wordList& dictionaries
)
{
    wordList allowed(values);
    allowed.append(dictionaries);
    onlyKeys(dict, allowed);
    checkValues(dict, values);
}


void Foam::dictionaryChecks::checkValues
(
    const dictionary& dict,
    const wordList& values
)
{
    for (const entry& e : dict)
    {
        if (e.isDict() && values.found(e.keyword()))
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' is a dictionary, but has to"
                << " be a value: a number, a word or a list" << nl
                << "    Write " << e.keyword() << " <value>; without braces"
                << nl << exit(FatalIOError);
        }
        checkValue(dict, e);
    }
}


void Foam::dictionaryChecks::checkNumbers(const dictionary& dict)
{
    for (const entry& e : dict)
    {
        checkValue(dict, e);
        if (e.isDict())
        {
            checkNumbers(e.dict());
        }
        else
        {
            checkTokens(dict, e);
        }
    }
}


void Foam::dictionaryChecks::checkLengths
(
    const dictionary& dict,
    const word& key,
    const vector& v
)
{
    if (!finiteNumbers::usable(v))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "': " << v << " is no length or position"
            << " to calculate with" << nl
            << "    Give components between " << -finiteNumbers::largest
            << " and " << finiteNumbers::largest << nl << exit(FatalIOError);
    }
}


void Foam::dictionaryChecks::checkLengths
(
    const dictionary& dict,
    const word& key,
    const UList<vector>& list
)
{
    for (const vector& v : list)
    {
        checkLengths(dict, key, v);
    }
}


void Foam::dictionaryChecks::restoreNames
(
    const dictionary& dict,
    const fileName& file
)
{
    static const string sent("IOstream");
    const auto restore = [&](fileName& name)
    {
        if (name.starts_with(sent))
        {
            name = file + name.substr(sent.size());
        }
    };
    restore(const_cast<dictionary&>(dict).name());
    for (const entry& e : dict)
    {
        if (e.isDict())
        {
            restoreNames(e.dict(), file);
        }
        else
        {
            restore(const_cast<ITstream&>(e.stream()).name());
        }
    }
}


Foam::scalar Foam::dictionaryChecks::getPositive
(
    const dictionary& dict,
    const word& key
)
{
    checkValues(dict, wordList(1, key));
    const token given(dict.lookup(key));
    const scalar value = given.isNumber() ? dict.get<scalar>(key) : -1;
    if (!(value > 0) || !squarable(value) || value < 1/largestNumber)
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


void Foam::dictionaryChecks::stopIf
(
    const fileName& file,
    const string& message
)
{
    const string first(firstOf(message));
    if (!first.empty())
    {
        FatalErrorInFunction << first.c_str() << nl << exit(FatalError);
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


Foam::scalar Foam::dictionaryChecks::getBetween
(
    const dictionary& dict,
    const word& key,
    const scalar otherwise,
    const scalar least,
    const scalar most
)
{
    const scalar value = dict.getOrDefault<scalar>(key, otherwise);
    if (!(value >= least && value <= most))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << value << nl
            << "    Use a number from " << least << " to " << most << nl
            << exit(FatalIOError);
    }
    return value;
}


Foam::label Foam::dictionaryChecks::getCount
(
    const dictionary& dict,
    const word& key,
    const label otherwise,
    const label least,
    const label most
)
{
    const label value = dict.getOrDefault<label>(key, otherwise);
    if (value < least || value > most)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << value << nl
            << "    Use a whole number from " << least << " to " << most << nl
            << exit(FatalIOError);
    }
    return value;
}


// ************************************************************************* //
