/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBoxes.H"
#include "boundBox.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "plainText.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBoxes::findParents()
{
    parent_.setSize(boxes_.size(), -1);
    wordList before;
    forAll(boxes_, boxi)
    {
        const auto* box = dynamic_cast<const ffdBox*>(&boxes_[boxi]);
        if (box && !box->parentName().empty())
        {
            const word name(box->parentName());
            parent_[boxi] = before.find(name);
            if (parent_[boxi] < 0)
            {
                FatalIOErrorInFunction(box->dict())
                    << "Entry 'parent' is '" << name
                    << "', but no lattice above has that name" << nl
                    << "    There are: " << plainText::listed(before).c_str() << nl
                    << "    List parents before the boxes that go with them"
                    << nl << exit(FatalIOError);
            }
        }
        before.append(box ? boxes_[boxi].name() : word::null);
    }
}


const Foam::ffdBox& Foam::ffdBoxes::lattice(const label boxi) const
{
    return dynamic_cast<const ffdBox&>(boxes_[boxi]);
}


bool Foam::ffdBoxes::isAncestor(const label boxi, const label of) const
{
    label above = parent_[of];
    while (above >= 0 && above != boxi)
    {
        above = parent_[above];
    }
    return above == boxi;
}


void Foam::ffdBoxes::findStages()
{
    stage_.setSize(boxes_.size(), 0);
    neighbours_.setSize(boxes_.size());
    nStages_ = 0;
    forAll(boxes_, boxi)
    {
        label together = -1;
        for (label other = 0; other < boxi; ++other)
        {
            if
            (
                !isAncestor(other, boxi)
             && boxes_[boxi].touches(boxes_[other])
            )
            {
                neighbours_[boxi].append(other);
                together = max(together, stage_[other]);
            }
        }
        if (combine_ == combination::chain)
        {
            const label with =
                parent_[boxi] < 0 ? together : stage_[parent_[boxi]];
            stage_[boxi] = with < 0 ? nStages_ : with;
        }
        nStages_ = max(nStages_, stage_[boxi] + 1);
    }

    // Only those that act on the same points can share some
    forAll(boxes_, boxi)
    {
        DynamicList<label> same;
        for (const label other : neighbours_[boxi])
        {
            if (stage_[other] == stage_[boxi])
            {
                same.append(other);
            }
        }
        neighbours_[boxi] = same;
    }
    before_.setSize(nStages_);
}


const Foam::pointField& Foam::ffdBoxes::before(const label stage) const
{
    return stage == 0 ? points_ : before_[stage];
}


void Foam::ffdBoxes::checkInside(const label boxi) const
{
    const ffdDeformation& box = boxes_[boxi];
    const label n = returnReduce(box.inside().size(), sumOp<label>());
    if (eachHasSome_ && n == 0)
    {
        const boundBox ofBox(box.lattice(false), false);
        const boundBox ofPoints(before(stage_[boxi]), true);
        FatalIOErrorInFunction(box.dict())
            << "Box '" << box.name() << "' contains no point of the mesh" << nl
            << "    It reaches from " << ofBox.min() << " to " << ofBox.max()
            << ", the mesh from " << ofPoints.min() << " to "
            << ofPoints.max() << nl << exit(FatalIOError);
    }
}


void Foam::ffdBoxes::findShared(const label boxi)
{
    const labelList& inside = boxes_[boxi].inside();
    movedBy_[boxi].setSize(inside.size());
    movedBy_[boxi] = labelPair(-1, -1);
    for (const label other : neighbours_[boxi])
    {
        Map<label> place(2*inside.size());
        forAll(boxes_[other].inside(), i)
        {
            place.insert(boxes_[other].inside()[i], i);
        }
        forAll(inside, i)
        {
            const auto found = place.cfind(inside[i]);
            if (found.found() && movedBy_[boxi][i].first() < 0)
            {
                // One that the other shares in turn has its mover there
                const labelPair& its = movedBy_[other][found.val()];
                movedBy_[boxi][i] =
                    its.first() < 0 ? labelPair(other, found.val()) : its;
            }
        }
    }
}


Foam::boolList Foam::ffdBoxes::carried(const label boxi) const
{
    boolList byNeighbours(points_.size(), false);
    forAll(boxes_, other)
    {
        const bool touching =
            neighbours_[boxi].found(other) || neighbours_[other].found(boxi);
        if (touching)
        {
            UIndirectList<bool>(byNeighbours, boxes_[other].inside()) = true;
        }
    }
    return byNeighbours;
}


void Foam::ffdBoxes::prepare(const label stage)
{
    const pointField& points = before(stage);
    forAll(boxes_, boxi)
    {
        if (stage_[boxi] == stage)
        {
            boxes_[boxi].setPoints(points);
            checkInside(boxi);
            findShared(boxi);
        }
    }

    forAll(boxes_, boxi)
    {
        if (stage_[boxi] != stage)
        {
            continue;
        }
        labelList found
        (
            boxes_[boxi].exits(points, edges_, carried(boxi)).counts()
        );
        foamCompat::allCombineList(found, plusEqOp<label>());
        boxes_[boxi].checkFrozen(ffdExits(found).toFreeze());
    }
}


void Foam::ffdBoxes::checkShared
(
    const label stage,
    const List<vectorField>& displacements
) const
{
    string message;
    bool some = false;
    forAll(boxes_, boxi)
    {
        some = some || (stage_[boxi] == stage && !neighbours_[boxi].empty());
        if (stage_[boxi] != stage || !message.empty())
        {
            continue;
        }
        const vectorField& d = displacements[boxi];
        forAll(d, i)
        {
            const labelPair& mover = movedBy_[boxi][i];
            if (mover.first() < 0)
            {
                continue;
            }
            const vector& its = displacements[mover.first()][mover.second()];
            if (mag(d[i] - its) > 1e-6*max(mag(d[i]), mag(its)) + VSMALL)
            {
                OStringStream text;
                text<< "Boxes '" << boxes_[mover.first()].name() << "' and '"
                    << boxes_[boxi].name() << "' share the point "
                    << before(stage)[boxes_[boxi].inside()[i]]
                    << " but move it differently: by " << its << " and by "
                    << d[i] << nl
                    << "    The mesh would tear there. Let parameters of both"
                    << " boxes move the control points" << nl
                    << "    of the common face alike, or none of them";
                message = text.str();
                break;
            }
        }
    }
    if (some)
    {
        dictionaryChecks::stopIf(dict_.subDict("boxes"), message);
    }
}


Foam::string Foam::ffdBoxes::kink
(
    const label boxi,
    const label other,
    const label order
) const
{
    const ffdBox& box = lattice(boxi);
    const ffdBox& neighbour = lattice(other);
    const pointField& points = before(stage_[boxi]);
    const labelHashSet theirs(neighbour.inside());

    // Differences of third order on each side. Polynomials, and those of
    // neighbours differ by much more than their error where they differ
    const scalar step = 1e-3;
    DynamicList<point> shared;
    DynamicList<vector> mine, its;
    for (const label pointi : box.inside())
    {
        if (theirs.found(pointi))
        {
            const point& x = points[pointi];
            const vector a(step*box.across(neighbour, x));
            const vector b(step*neighbour.across(box, x));
            morph::Vector3 xi;
            if
            (
                mag(a) > 0
             && mag(b) > 0
             && box.within(toEigen(point(x + 3*a)), xi)
             && neighbour.within(toEigen(point(x + 3*b)), xi)
            )
            {
                shared.append(x);
                mine.append(a);
                its.append(b);
            }
        }
    }

    const auto slopes =
        [&](const ffdBox& of, const UList<vector>& steps, const scalar sign)
        {
            FixedList<vectorField, 4> d;
            forAll(d, k)
            {
                d[k] = of.displacementOf
                (
                    pointField(shared) + scalar(k)*vectorField(steps)
                );
            }
            const scalarField h(mag(vectorField(steps)));
            return
                order == 1
              ? vectorField
                (
                    sign*(18.0*d[1] - 11.0*d[0] - 9.0*d[2] + 2.0*d[3])/(6*h)
                )
              : vectorField
                (
                    (2.0*d[0] - 5.0*d[1] + 4.0*d[2] - d[3])/sqr(h)
                );
        };
    const vectorField here(slopes(box, mine, 1));
    const vectorField there(slopes(neighbour, its, -1));

    // Round-off and the error of differences, the same on all ranks
    const scalar largest = Foam::sqrt
    (
        max
        (
            box.control().rowwise().squaredNorm().maxCoeff(),
            neighbour.control().rowwise().squaredNorm().maxCoeff()
        )
    );
    const scalar relative = order == 1 ? 1e-4 : 1e-2;
    forAll(shared, i)
    {
        const scalar length = mag(mine[i])/step;
        if
        (
            mag(here[i] - there[i])
          > relative*max(mag(here[i]), mag(there[i]))
          + 1e-2*relative*largest/pow(length, order)
        )
        {
            OStringStream text;
            text<< "Boxes '" << neighbour.name() << "' and '" << box.name()
                << "' join with a kink at " << shared[i]
                << ", but 'continuity C" << order << "' is asked for" << nl
                << "    Across their common face the "
                << (order == 1 ? "first" : "second")
                << " derivative of the displacement is " << there[i]
                << " and " << here[i] << nl
                << "    Let parameters of both move the control points next to"
                << " the face so that their differences, over the distances"
                << " between them, go on from one box to the other, or set"
                << " 'continuity C" << order - 1 << "'";
            return text.str();
        }
    }
    return string();
}


void Foam::ffdBoxes::checkSmooth(const label stage) const
{
    string message;
    bool some = false;
    forAll(boxes_, boxi)
    {
        if (stage_[boxi] != stage)
        {
            continue;
        }
        for (const label other : neighbours_[boxi])
        {
            const label smooth = max
            (
                boxes_[boxi].frozenLayers(), boxes_[other].frozenLayers()
            ) - 1;
            some = some || smooth > 0;
            for (label order = 1; order <= smooth && message.empty(); ++order)
            {
                message = kink(boxi, other, order);
            }
        }
    }
    if (some)
    {
        dictionaryChecks::stopIf(dict_.subDict("boxes"), message);
    }
}


// ************************************************************************* //
