/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBoxes.H"
#include "ffdCorrection.H"
#include "dictionaryEntries.H"
#include "throwing.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::ffdBoxes::combination>
Foam::ffdBoxes::combinationNames
({
    { combination::chain, "chain" },
    { combination::sum, "sum" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Names of files have at most 255 characters
static const std::size_t longestName = 100;


static const dictionary& checked(const dictionary& dict)
{
    dictionaryChecks::checkNumbers(dict);
    dictionaryChecks::checkValues(dict, {"combine"});
    return dict;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdBoxes::ffdBoxes
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    dict_(checked(dict)),
    registry_(registry),
    combine_
    (
        dictionaryChecks::getChoice
        (
            dict, "combine", combinationNames, combination::chain
        )
    ),
    eachHasSome_(true),
    prepared_(false),
    hasKept_(false),
    uncorrected_(true)
{
    readBoxes();
    findParents();
    findStages();
    if (keeps())
    {
        checkKeep();
    }
}


// * * * * * * * * * * * * * * * * Destructor  * * * * * * * * * * * * * * * //

Foam::ffdBoxes::~ffdBoxes()
{}


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
        if (e.keyword().size() > longestName)
        {
            FatalIOErrorInFunction(boxes)
                << "The name of a box has " << label(e.keyword().size())
                << " characters: " << e.keyword() << nl
                << "    Files are called after it: give it at most "
                << longestName << nl << exit(FatalIOError);
        }
        boxes_.append(ffdDeformation::New(e.dict(), registry_));
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
    movedBy_.setSize(boxes_.size());
}


void Foam::ffdBoxes::checkKeep() const
{
    const bool one =
        boxes_.size() == 1 && dynamic_cast<const ffdBox*>(&boxes_[0]);
    if (!one)
    {
        FatalIOErrorInFunction(keep())
            << "Entry 'keep' is for one box with a lattice, whose control"
            << " points then move further; here are "
            << plainText::counted(boxes_.size(), "deformation").c_str() << nl
            << "    Remove 'keep', or the other boxes" << nl
            << exit(FatalIOError);
    }
}


void Foam::ffdBoxes::correct()
{
    if (!hasKept_)
    {
        FatalIOErrorInFunction(keep())
            << "Entry 'keep' is for surfaces of a mesh in three dimensions and"
            << " for surface files" << nl
            << "    Remove it" << nl << exit(FatalIOError);
    }
    ffdBox& box = dynamic_cast<ffdBox&>(boxes_[0]);
    if (!correction_.valid())
    {
        correction_.reset
        (
            new ffdCorrection(keep(), box, keptPoints_, keptFaces_)
        );
    }
    box.correct(correction_->correction(box.control()));
    box.setProjection
    (
        [this](const morph::Vectors& control)
        {
            return correction_->derivative(control);
        }
    );
    uncorrected_ = false;
    string fold;
    try
    {
        const throwing errors;
        box.checkFold();
    }
    catch (const Foam::error& wrong)
    {
        fold = wrong.message();
    }
    if (!fold.empty())
    {
        FatalIOErrorInFunction(keep())
            << "With the control points that 'keep' moves further: "
            << fold.c_str() << nl
            << "    Make the values of the parameters smaller, free more control"
            << " points, or ask for a value nearer to that at rest" << nl
            << exit(FatalIOError);
    }
}


Foam::vectorField Foam::ffdBoxes::motion
(
    const label boxi,
    const pointField& points
) const
{
    vectorField d(lattice(boxi).displacementOf(points));
    if (parent_[boxi] >= 0)
    {
        d += motion(parent_[boxi], points);
    }
    return d;
}


Foam::vectorField Foam::ffdBoxes::motionDerivative
(
    const label boxi,
    const pointField& points,
    const label parameteri
) const
{
    const ffdBox& box = lattice(boxi);
    if (boxOf_[parameteri] == boxi)
    {
        return box.derivativeOf(points, placeOf_[parameteri]);
    }
    vectorField d(points.size(), Zero);
    if (isAncestor(boxOf_[parameteri], boxi))
    {
        const label above = parent_[boxi];
        d = motionDerivative(above, points, parameteri)
          + box.derivativeOf
            (
                points,
                motionDerivative(above, box.carriedPoints(), parameteri)
            );
    }
    return d;
}


void Foam::ffdBoxes::add
(
    const label boxi,
    const vectorField& d,
    vectorField& total
) const
{
    const labelList& inside = boxes_[boxi].inside();
    forAll(inside, i)
    {
        if (movedBy_[boxi][i].first() < 0)
        {
            total[inside[i]] += d[i];
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::ffdBoxes::keys()
{
    return {"boxes", "combine", "keep"};
}


const Foam::dictionary& Foam::ffdBoxes::keep() const
{
    return dictionaryChecks::subDict(dict_, "keep");
}


void Foam::ffdBoxes::setKept(const pointField& points, const faceList& faces)
{
    if (keeps())
    {
        keptPoints_ = points;
        keptFaces_ = faces;
        hasKept_ = true;
        correction_.clear();
    }
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


Foam::List<Foam::motionParameter> Foam::ffdBoxes::parameterList() const
{
    const wordList names(parameterNames());
    const scalarField now(values());
    List<motionParameter> list(names.size());
    forAll(list, i)
    {
        list[i] = {names[i], now[i]};
    }
    return list;
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
        const label above = parent_[boxi];
        changed[boxi] = changed[boxi] || (above >= 0 && changed[above]);
        if (changed[boxi])
        {
            if (above >= 0)
            {
                ffdBox& box = dynamic_cast<ffdBox&>(boxes_[boxi]);
                box.carry(motion(above, box.carriedPoints()));
            }
            boxes_[boxi].update();
            boxes_[boxi].checkFold();
            uncorrected_ = true;
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
    List<vectorField> displacements(boxes_.size());
    for (label stage = 0; stage < nStages_; ++stage)
    {
        bool changed = !prepared_;
        if (stage > 0)
        {
            pointField now(points_ + total());
            changed = changed || now != before_[stage];
            before_[stage].transfer(now);
        }
        if (returnReduce(changed, orOp<bool>()))
        {
            prepare(stage);
        }

        if (keeps() && uncorrected_)
        {
            correct();
        }
        forAll(boxes_, boxi)
        {
            if (stage_[boxi] == stage)
            {
                displacements[boxi] =
                    boxes_[boxi].displacement(before(stage));
                add(boxi, displacements[boxi], total.ref());
            }
        }
        checkShared(stage, displacements);
        checkSmooth(stage);
    }
    prepared_ = true;
    if (nStages_ == 1)
    {
        // Only boxes that act on moved points need them again
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
    const label from = boxOf_[parameteri];
    for (label stage = stage_[from]; stage < nStages_; ++stage)
    {
        const vectorField velocity(total());
        forAll(boxes_, boxi)
        {
            if (stage_[boxi] != stage)
            {
                continue;
            }
            const ffdDeformation& box = boxes_[boxi];
            if (boxi == from)
            {
                add
                (
                    boxi,
                    box.derivative(before(stage), placeOf_[parameteri]),
                    total.ref()
                );
            }
            else if (isAncestor(from, boxi))
            {
                const ffdBox& child = lattice(boxi);
                add
                (
                    boxi,
                    child.carriedDerivative
                    (
                        before(stage),
                        motionDerivative
                        (
                            parent_[boxi], child.carriedPoints(), parameteri
                        )
                    ),
                    total.ref()
                );
            }
            else if (stage > stage_[from])
            {
                add
                (
                    boxi,
                    box.directional(before(stage), velocity),
                    total.ref()
                );
            }
        }
    }
    return total;
}


Foam::List<Foam::ffdExits> Foam::ffdBoxes::cut(const edgeList& edges) const
{
    List<ffdExits> exits(boxes_.size());
    forAll(boxes_, boxi)
    {
        if (boxes_[boxi].frozenLayers() == 0)
        {
            exits[boxi] = boxes_[boxi].exits
            (
                before(stage_[boxi]), edges, carried(boxi)
            );
        }
    }
    return exits;
}


// ************************************************************************* //
