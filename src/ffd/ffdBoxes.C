/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBoxes.H"
#include "boundBox.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::ffdBoxes::combination>
Foam::ffdBoxes::combinationNames
({
    { combination::chain, "chain" },
    { combination::sum, "sum" }
});


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdBoxes::ffdBoxes
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    dict_(dict),
    registry_(registry),
    combine_
    (
        dictionaryChecks::getChoice
        (
            dict, "combine", combinationNames, combination::chain
        )
    ),
    eachHasSome_(true),
    prepared_(false)
{
    readBoxes();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBoxes::readBoxes()
{
    if (!dict_.findDict("boxes"))
    {
        FatalIOErrorInFunction(dict_)
            << "There is no dictionary 'boxes'" << nl
            << "    List the boxes there, for example boxes { body { origin"
            << " (0 0 0); span (1 1 1);" << nl
            << "    order (2 2 2); parameters { mu { value 0.1; moves"
            << " ( ((1 1 1) (1 0 0)) ); } } } }" << nl << exit(FatalIOError);
    }
    const dictionary& boxes = dict_.subDict("boxes");
    for (const entry& e : boxes)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(boxes)
                << "Entry '" << e.keyword() << "' has to be the dictionary of"
                << " a box" << nl << exit(FatalIOError);
        }
        boxes_.append(new ffdBox(e.dict(), registry_));
        forAll(boxes_.last().parameters(), i)
        {
            boxOf_.append(boxes_.size() - 1);
            placeOf_.append(i);
        }
    }
    if (boxes_.empty())
    {
        FatalIOErrorInFunction(boxes)
            << "There is no box: nothing would move" << nl
            << exit(FatalIOError);
    }
    before_.setSize(boxes_.size());
}


const Foam::pointField& Foam::ffdBoxes::before(const label boxi) const
{
    return
        combine_ == combination::chain && boxi > 0
      ? before_[boxi]
      : points_;
}


void Foam::ffdBoxes::prepare(const label boxi, const pointField& points)
{
    ffdBox& box = boxes_[boxi];
    box.setPoints(points);
    ffdBox::faceFlags shared(box.crossed(points, edges_));

    // Number of points inside, and which faces are shared, over all ranks
    labelList found(7);
    found[6] = box.inside().size();
    forAll(shared, face)
    {
        found[face] = shared[face];
    }
    foamCompat::allCombineList(found, plusEqOp<label>());

    if (eachHasSome_ && found[6] == 0)
    {
        const boundBox ofBox(box.lattice(false), false);
        const boundBox ofPoints(points, true);
        FatalIOErrorInFunction(box.dict())
            << "Box '" << box.name() << "' contains no point of the mesh" << nl
            << "    It reaches from " << ofBox.min() << " to " << ofBox.max()
            << ", the mesh from " << ofPoints.min() << " to "
            << ofPoints.max() << nl << exit(FatalIOError);
    }
    forAll(shared, face)
    {
        shared[face] = found[face] > 0;
    }
    box.checkFrozen(shared);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::ffdBoxes::keys()
{
    return {"boxes", "combine"};
}


const Foam::ffdParameter& Foam::ffdBoxes::parameter
(
    const label parameteri
) const
{
    return boxes_[boxOf_[parameteri]].parameters()[placeOf_[parameteri]];
}


Foam::wordList Foam::ffdBoxes::parameterNames() const
{
    wordList names(nParameters());
    forAll(names, i)
    {
        names[i] = boxes_[boxOf_[i]].name() + '.' + parameter(i).name();
    }
    return names;
}


Foam::scalarField Foam::ffdBoxes::values() const
{
    scalarField values(nParameters());
    forAll(values, i)
    {
        values[i] = parameter(i).value();
    }
    return values;
}


bool Foam::ffdBoxes::update(const scalar time)
{
    scalarField values(nParameters());
    forAll(values, i)
    {
        values[i] = parameter(i).valueAt(time);
    }
    return update(values);
}


bool Foam::ffdBoxes::update(const scalarField& values)
{
    boolList changed(boxes_.size(), false);
    forAll(values, i)
    {
        ffdParameter& p = boxes_[boxOf_[i]].parameters()[placeOf_[i]];
        const scalar former = p.value();
        p.setValue(values[i]);
        changed[boxOf_[i]] = changed[boxOf_[i]] || values[i] != former;
    }
    forAll(boxes_, boxi)
    {
        if (changed[boxi])
        {
            boxes_[boxi].update();
            boxes_[boxi].checkFold();
        }
    }
    return changed.found(true);
}


void Foam::ffdBoxes::setPoints
(
    const pointField& points,
    const edgeList& edges,
    const bool eachHasSome
)
{
    points_ = points;
    edges_ = edges;
    eachHasSome_ = eachHasSome;
    prepared_ = false;
}


Foam::tmp<Foam::vectorField> Foam::ffdBoxes::displacement()
{
    auto total = tmp<vectorField>::New(points_.size(), Zero);
    forAll(boxes_, boxi)
    {
        ffdBox& box = boxes_[boxi];
        if (combine_ == combination::chain && boxi > 0)
        {
            pointField now(points_ + total());
            const bool changed = !prepared_ || now != before_[boxi];
            before_[boxi].transfer(now);
            if (returnReduce(changed, orOp<bool>()))
            {
                prepare(boxi, before_[boxi]);
            }
        }
        else if (!prepared_)
        {
            prepare(boxi, points_);
        }

        const vectorField d(box.displacement(before(boxi)));
        forAll(d, i)
        {
            total.ref()[box.inside()[i]] += d[i];
        }
    }
    prepared_ = true;
    if (combine_ == combination::sum || boxes_.size() == 1)
    {
        // Only what acts on moved points asks for them again
        edges_.clear();
    }
    return total;
}


Foam::tmp<Foam::vectorField> Foam::ffdBoxes::derivative
(
    const label parameteri
) const
{
    auto total = tmp<vectorField>::New(points_.size(), Zero);
    forAll(boxes_, boxi)
    {
        const ffdBox& box = boxes_[boxi];
        vectorField d(box.inside().size(), Zero);
        if (boxOf_[parameteri] == boxi)
        {
            d = box.derivative(before(boxi), placeOf_[parameteri]);
        }
        else if (combine_ == combination::chain && boxOf_[parameteri] < boxi)
        {
            d = box.directional(before(boxi), total());
        }
        forAll(d, i)
        {
            total.ref()[box.inside()[i]] += d[i];
        }
    }
    return total;
}


Foam::List<Foam::ffdBox::faceFlags> Foam::ffdBoxes::cut
(
    const edgeList& edges
) const
{
    List<ffdBox::faceFlags> faces(boxes_.size());
    forAll(boxes_, boxi)
    {
        faces[boxi] =
            boxes_[boxi].settings().frozenLayers == 0
          ? boxes_[boxi].crossed(before(boxi), edges)
          : ffdBox::faceFlags(false);
    }
    return faces;
}


// ************************************************************************* //
