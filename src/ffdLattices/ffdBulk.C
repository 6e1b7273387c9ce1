/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBulk.H"
#include "dictionaryEntries.H"
#include "ITstream.H"
#include "Pair.H"

// * * * * * * * * * * * * * * * * * Constants  * * * * * * * * * * * * * * * //

const Foam::Enum<Foam::ffdBulk::bulkType> Foam::ffdBulk::bulkTypeNames
({
    { bulkType::points, "points" },
    { bulkType::camber, "camber" },
    { bulkType::thickness, "thickness" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const wordList directionNames({"s", "t", "p"});

static const wordList indexNames({"i", "j", "k"});


// A direction of the box by its name
static label readDirection(const dictionary& dict, const word& key)
{
    const word given(dict.get<word>(key));
    const label d = directionNames.find(given);
    if (d < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is '" << given << "'" << nl
            << "    Use one of " << plainText::listed(directionNames).c_str() << nl
            << exit(FatalIOError);
    }
    return d;
}


static vector unit(const label d)
{
    vector v(Zero);
    v[d] = 1;
    return v;
}


// Names and vectors of the directions in which points move
static void readDirections
(
    const dictionary& dict,
    wordList& names,
    List<vector>& vectors
)
{
    if (!dict.found("directions"))
    {
        names = directionNames;
        vectors = {unit(0), unit(1), unit(2)};
        return;
    }
    DynamicList<word> foundNames;
    DynamicList<vector> foundVectors;
    ITstream& is = dict.lookup("directions");
    is.readBegin("directions");
    token t(is);
    while (t != token::END_LIST)
    {
        if (t.isWord() && directionNames.found(t.wordToken()))
        {
            foundNames.append(t.wordToken());
            foundVectors.append(unit(directionNames.find(t.wordToken())));
        }
        else if (t == token::BEGIN_LIST)
        {
            is.putBack(t);
            foundNames.append(Foam::name(foundVectors.size()));
            foundVectors.append(vector(is));
        }
        else
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'directions' has '" << t << "'" << nl
                << "    List some of s, t and p, or vectors: (s (0 0.7 0.7))"
                << nl << exit(FatalIOError);
        }
        is >> t;
    }
    if (foundNames.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'directions' is empty: nothing would move" << nl
            << exit(FatalIOError);
    }
    names = foundNames;
    vectors = foundVectors;
}


// First and last layer of a direction
static Pair<label> readLayers
(
    const dictionary& dict,
    const direction d,
    const label n
)
{
    const word& key = indexNames[d];
    Pair<label> layers(0, n - 1);
    if (dict.found(key))
    {
        layers = Pair<label>(dict.lookup(key));
    }
    if (layers.first() < 0 || layers.second() >= n
     || layers.second() < layers.first())
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << layers
            << ", but layers are from 0 to " << n - 1 << nl
            << "    Give the first and the last one, for example (0 "
            << n - 1 << ')' << nl << exit(FatalIOError);
    }
    return layers;
}


// One group of bulk parameters
class bulkGroup
{
    const dictionary& dict_;
    const ffdBoxSettings& settings_;
    PtrList<ffdParameter>& parameters_;
    const objectRegistry* registry_;

    FixedList<Pair<label>, 3> layers_;

    //- The direction of mirroring, -1 for none
    label mirror_;

    dictionary values_;

    dictionary common_;

    wordHashSet used_;


    word nameOf(const labelVector& p, const label without) const
    {
        word name(dict_.dictName());
        for (label d = 0; d < 3; ++d)
        {
            if (d != without)
            {
                name += '_' + Foam::name(p[d]);
            }
        }
        return name;
    }


    void add(const word& name, const ffdParameter::moveList& moves)
    {
        const bool own = values_.found(name);
        used_.insert(name);
        parameters_.append
        (
            new ffdParameter
            (
                name, dict_, own ? values_ : common_, own ? name : "value",
                moves, registry_
            )
        );
    }


    //- With the opposite points, where there are some. False if it is the
    //  upper one of a pair
    bool mirrored(ffdParameter::moveList& moves) const
    {
        if (mirror_ < 0)
        {
            return true;
        }
        const label last = settings_.order[mirror_];
        const label n = moves.size();
        ffdParameter::moveList both(moves);
        for (label i = 0; i < n; ++i)
        {
            labelVector p(moves[i].first());
            vector v(moves[i].second());
            if (2*p[mirror_] > last)
            {
                return false;
            }
            if (2*p[mirror_] == last)
            {
                both[i].second()[mirror_] = 0;
                continue;
            }
            p[mirror_] = last - p[mirror_];
            v[mirror_] *= -1;
            both.append(Tuple2<labelVector, vector>(p, v));
        }
        moves.transfer(both);
        for (const auto& move : moves)
        {
            if (magSqr(move.second()) > 0)
            {
                return true;
            }
        }
        return false;
    }


    void addPoints()
    {
        wordList names;
        List<vector> vectors;
        readDirections(dict_, names, vectors);
        labelVector p;
        for (p.z() = layers_[2].first(); p.z() <= layers_[2].second(); ++p.z())
        for (p.y() = layers_[1].first(); p.y() <= layers_[1].second(); ++p.y())
        for (p.x() = layers_[0].first(); p.x() <= layers_[0].second(); ++p.x())
        {
            forAll(names, i)
            {
                ffdParameter::moveList moves
                (
                    1, Tuple2<labelVector, vector>(p, vectors[i])
                );
                if (mirrored(moves))
                {
                    add(nameOf(p, -1) + '_' + names[i], moves);
                }
            }
        }
    }


    void addColumns(const bool thickness)
    {
        const label across = readDirection(dict_, "across");
        const label n = settings_.order[across];
        if (n < 1 || across == mirror_)
        {
            FatalIOErrorInFunction(dict_)
                << "Entry 'across' is " << directionNames[across]
                << ", where the lattice has " << n + 1
                << " layer(s) and 'mirror' is "
                << (mirror_ < 0 ? word("none") : directionNames[mirror_]) << nl
                << "    It has to lead from the lower to the upper side, and"
                << " differ from 'mirror'" << nl << exit(FatalIOError);
        }
        labelVector p;
        for (p.z() = layers_[2].first(); p.z() <= layers_[2].second(); ++p.z())
        for (p.y() = layers_[1].first(); p.y() <= layers_[1].second(); ++p.y())
        for (p.x() = layers_[0].first(); p.x() <= layers_[0].second(); ++p.x())
        {
            if (p[across] != layers_[across].first())
            {
                continue;
            }
            ffdParameter::moveList moves;
            for (label layer = 0; layer <= n; ++layer)
            {
                labelVector at(p);
                at[across] = layer;
                const scalar factor =
                    thickness ? scalar(layer)/n - 0.5 : scalar(1);
                moves.append
                (
                    Tuple2<labelVector, vector>(at, factor*unit(across))
                );
            }
            if (mirrored(moves))
            {
                add(nameOf(p, across), moves);
            }
        }
    }


public:

    bulkGroup
    (
        const dictionary& dict,
        const ffdBoxSettings& settings,
        PtrList<ffdParameter>& parameters,
        const objectRegistry* registry
    )
    :
        dict_(dict),
        settings_(settings),
        parameters_(parameters),
        registry_(registry),
        mirror_(dict.found("mirror") ? readDirection(dict, "mirror") : -1)
    {
        dictionaryChecks::onlyKeys
        (
            dict,
            {
                "type", "i", "j", "k", "directions", "across", "mirror",
                "value", "valueCoeffs", "values", "min", "max"
            }
        );
        for (direction d = 0; d < 3; ++d)
        {
            layers_[d] = readLayers(dict, d, settings.nPoints(d));
        }
        if (mirror_ == 1 && settings.frame->ring())
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'mirror' is t, but the box is a ring" << nl
                << "    Points have none opposite to them in that direction"
                << nl << exit(FatalIOError);
        }
        common_ = dict;
        if (!dict.found("value"))
        {
            common_.add("value", scalar(0));
        }
        if (dict.found("values"))
        {
            values_ = dictionaryChecks::subDict(dict, "values");
        }
    }


    void append()
    {
        const label first = parameters_.size();
        const auto type = dictionaryChecks::getChoice
        (
            dict_, "type", ffdBulk::bulkTypeNames, ffdBulk::bulkType::points
        );
        if (type == ffdBulk::bulkType::points)
        {
            addPoints();
        }
        else
        {
            addColumns(type == ffdBulk::bulkType::thickness);
        }
        for (const entry& e : values_)
        {
            if (!used_.found(e.keyword()))
            {
                FatalIOErrorInFunction(dict_)
                    << "Entry 'values': there is no parameter '"
                    << e.keyword() << "'" << nl
                    << "    There are " << parameters_.size() - first
                    << ", from "
                    << (first < parameters_.size()
                        ? parameters_[first].name() : word("none"))
                    << " to "
                    << (first < parameters_.size()
                        ? parameters_.last().name() : word("none"))
                    << nl << exit(FatalIOError);
            }
        }
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::ffdBulk::append
(
    const dictionary& bulk,
    const ffdBoxSettings& settings,
    PtrList<ffdParameter>& parameters,
    const objectRegistry* registry
)
{
    for (const entry& e : bulk)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(bulk)
                << "Entry '" << e.keyword() << "' has to be a dictionary: "
                << e.keyword() << " { directions (s t p); }" << nl
                << exit(FatalIOError);
        }
        bulkGroup(e.dict(), settings, parameters, registry).append();
    }
}


// ************************************************************************* //
