/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "dictionaryNumbers.H"
#include "primitiveEntry.H"
#include "vector.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::dictionaryNumbers::dictionaryNumbers
(
    const dictionary& dict,
    const wordList& without
)
:
    dict_(dict)
{
    dictionary within(dict);
    for (const word& key : without)
    {
        within.remove(key);
    }
    find(within, word::null, wordList());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::dictionaryNumbers::find
(
    const dictionary& dict,
    const word& prefix,
    const wordList& path
)
{
    for (const entry& e : dict)
    {
        const word key(e.keyword());
        wordList here(path);
        here.append(key);
        if (!e.isDict())
        {
            add(e, prefix + key, here);
        }
        else if (key.ends_with("Coeffs"))
        {
            find(e.dict(), prefix, here);
        }
        else
        {
            find(e.dict(), prefix + key + '.', here);
        }
    }
}


void Foam::dictionaryNumbers::add
(
    const entry& e,
    const word& name,
    const wordList& path
)
{
    const ITstream& tokens = e.stream();
    const bool constant =
        tokens.size() > 1
     && tokens[0].isWord()
     && tokens[0].wordToken() == "constant";
    const label first = constant ? 1 : 0;
    const label n = tokens.size() - first;

    if (n == 1 && tokens[first].isNumber())
    {
        const scalar value = tokens[first].number();
        numbers_.append({name, path, first, mag(value), value});
        return;
    }

    bool isVector =
        n == 5
     && tokens[first].isPunctuation()
     && tokens[first].pToken() == token::BEGIN_LIST;
    vector value(Zero);
    for (direction c = 0; isVector && c < vector::nComponents; ++c)
    {
        isVector = tokens[first + 1 + c].isNumber();
        value[c] = isVector ? tokens[first + 1 + c].number() : 0;
    }
    for (direction c = 0; isVector && c < vector::nComponents; ++c)
    {
        numbers_.append
        (
            {
                name + '.' + vector::componentNames[c],
                path,
                first + 1 + c,
                mag(value),
                value[c]
            }
        );
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::dictionary Foam::dictionaryNumbers::with
(
    const label i,
    const scalar value
) const
{
    const number& changed = numbers_[i];
    dictionary dict(dict_);
    dictionary* within = &dict;
    for (label depth = 0; depth + 1 < changed.path.size(); ++depth)
    {
        within = within->findDict(changed.path[depth]);
    }
    const word& key = changed.path.last();
    const tokenList& former = within->findEntry(key)->stream();
    tokenList tokens(former);
    tokens[changed.token] = value;
    const UList<token>& changedTokens = tokens;
    within->set(new primitiveEntry(key, changedTokens));
    return dict;
}


void Foam::dictionaryNumbers::remove(const label i)
{
    DynamicList<number> left;
    forAll(numbers_, j)
    {
        if (j != i)
        {
            left.append(numbers_[j]);
        }
    }
    numbers_.transfer(left);
}


// ************************************************************************* //
