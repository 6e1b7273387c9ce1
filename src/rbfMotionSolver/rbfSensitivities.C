/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfSensitivities.H"
#include "boundBox.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "HashTable.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Parameters that are differentiated together: their fields are in memory
static const label batchSize = 8;

// Of derivatives of the conditions, what a selection may leave of them without
// a word
static const scalar resolved = 0.1;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rbfSensitivities::rbfSensitivities
(
    const PtrList<controlPointGroup>& groups,
    oneStepMotion& oneStep,
    const motion& made,
    const vectorField& displacement
)
:
    dict_(oneStep.problem().dict()),
    problem_(oneStep.problem()),
    groups_(groups),
    displacement_(displacement.size()),
    parameters_(parameters(groups, sources_)),
    fields_(oneStep.fields().size()),
    own_(oneStep.fields().size()),
    first_(-1),
    batch_()
{
    check(made);
    checkThatSurfacesStay();
    forAll(displacement_, pointi)
    {
        displacement_[pointi] = problem_.reduced().reduce
        (
            problem_.points0()[pointi], displacement[pointi]
        );
    }
    forAll(fields_, regioni)
    {
        if (oneStep.fields()[regioni].active())
        {
            fields_.set(regioni, &oneStep.fields()[regioni]);
        }
    }
    selectWhereAtRest();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::rbfSensitivities::check(const motion& made) const
{
    if (made.nSteps > 1)
    {
        FatalIOErrorInFunction(dict_)
            << "The motion was made in " << made.nSteps << " steps: dx/dmu is that"
            << " of motions in one step" << nl
            << "    Use 'subSteps 1', with a larger 'supportRadius' where the"
            << " mesh is invalid then" << nl << exit(FatalIOError);
    }
    if (problem_.settings().movingReference)
    {
        FatalIOErrorInFunction(dict_)
            << "With 'reference moving' a mesh depends on all steps before: there"
            << " is no dx/dmu of one" << nl
            << "    Use 'reference fixed'" << nl << exit(FatalIOError);
    }
    if (made.optimised)
    {
        FatalIOErrorInFunction(dict_)
            << "The mesh was optimised after the motion: dx/dmu is that of the"
            << " motion alone" << nl
            << "    Remove 'optimise', or ask for derivatives of a smaller"
            << " motion, which needs none" << nl << exit(FatalIOError);
    }
    if (made.fraction < 1)
    {
        FatalIOErrorInFunction(dict_)
            << "The motion was limited to " << made.fraction << " of what is"
            << " prescribed ('onInvalidMesh limit'), which depends on no"
            << " parameter smoothly" << nl
            << "    " << problem_.remedy().c_str() << nl
            << exit(FatalIOError);
    }
}


void Foam::rbfSensitivities::checkThatSurfacesStay() const
{
    for (const controlPointGroup& group : groups_)
    {
        if (group.slides() && group.moves())
        {
            FatalIOErrorInFunction(group.dict())
                << "Group '" << group.name() << "' slides on a surface that"
                << " moves: there are no derivatives of such a motion" << nl
                << "    Let the points of that surface move instead ('type"
                << " moving'), or let it stay (no 'displacement')" << nl
                << exit(FatalIOError);
        }
    }
}


Foam::rbfControlPoints::conditionDerivatives
Foam::rbfSensitivities::conditions(const label parameteri) const
{
    const auto derivative =
        [&](const label groupi, const prescribedDisplacement::points& p)
        {
            for (const labelPair& source : sources_[parameteri])
            {
                if (source.first() == groupi)
                {
                    return groups_[groupi].derivative(p, source.second());
                }
            }
            return tmp<vectorField>::New(p.positions.size(), Zero);
        };
    return problem_.controlPoints().derivatives(derivative);
}


Foam::scalar Foam::rbfSensitivities::movedSpan
(
    const List<rbfControlPoints::conditionDerivatives>& all
) const
{
    scalar span = 0;
    forAll(fields_, regioni)
    {
        boundBox moving;
        for (const rbfControlPoints::conditionDerivatives& d : all)
        {
            for (const morph::ControlPoint& p : d.candidates[regioni])
            {
                if (p.g().norm() > 0)
                {
                    moving.add(toFoam(p.position));
                }
            }
        }
        moving.reduce();
        span = max(span, moving.valid() ? moving.mag() : 0);
    }
    return span;
}


void Foam::rbfSensitivities::selectWhereAtRest()
{
    bool some = false;
    forAll(fields_, regioni)
    {
        some = some || !fields_.set(regioni);
    }
    if (!some)
    {
        return;
    }

    List<rbfControlPoints::conditionDerivatives> all(parameters_.size());
    forAll(all, i)
    {
        all[i] = conditions(i);
    }
    const scalar span = movedSpan(all);
    if (span > 0 && problem_.radius() == 0)
    {
        problem_.provideRadius(span);

        // Without images, there are other candidates
        forAll(all, i)
        {
            all[i] = conditions(i);
        }
    }
    forAll(fields_, regioni)
    {
        if (fields_.set(regioni))
        {
            continue;
        }
        std::vector<morph::ControlPoints> sets;
        for (const rbfControlPoints::conditionDerivatives& d : all)
        {
            scalar largest = 0;
            for (const morph::ControlPoint& p : d.candidates[regioni])
            {
                largest = max(largest, p.g().norm());
            }
            if (returnReduce(largest, maxOp<scalar>()) > 0)
            {
                sets.push_back(d.candidates[regioni]);
            }
        }
        if (!sets.empty())
        {
            own_.set(regioni, new rbfField(problem_, regioni));
            own_[regioni].selectFor(sets);
            fields_.set(regioni, &own_[regioni]);
        }
    }
}


void Foam::rbfSensitivities::compute(const label first)
{
    const label n = min(batchSize, parameters_.size() - first);
    first_ = first;
    batch_.clear();
    batch_.setSize(n);
    List<rbfControlPoints::conditionDerivatives> told(n);
    for (label k = 0; k < n; ++k)
    {
        batch_.set(k, new vectorField(displacement_.size(), Zero));
        told[k] = conditions(first + k);
    }

    scalarList largest(n, Zero), open(n, Zero);
    forAll(fields_, regioni)
    {
        if (fields_.set(regioni))
        {
            std::vector<morph::ControlPoints> sets;
            for (const rbfControlPoints::conditionDerivatives& d : told)
            {
                sets.push_back(d.candidates[regioni]);
            }
            fields_[regioni].differentiate(sets, batch_, largest, open);
        }
    }
    foamCompat::allCombineList(largest, maxEqOp<scalar>());
    foamCompat::allCombineList(open, maxEqOp<scalar>());

    for (label k = 0; k < n; ++k)
    {
        problem_.constrainDerivative
        (
            told[k].controlled, displacement_, batch_[k]
        );
        batch_[k] = problem_.expand(batch_[k]);
        if (open[k] > resolved*largest[k])
        {
            WarningInFunction
                << "The control points selected for the motion leave "
                << 100*open[k]/largest[k] << " % of what parameter '"
                << parameters_[first + k].name << "' does to others" << nl
                << "    Its dx/dmu is exact with these points, but rough beside"
                << " the surfaces. Lower 'tolerance' of 'greedy', or use"
                << " 'selection all'" << endl;
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::motionParameter> Foam::rbfSensitivities::parameters
(
    const PtrList<controlPointGroup>& groups,
    List<DynamicList<labelPair>>& sources
)
{
    DynamicList<motionParameter> all;
    DynamicList<DynamicList<labelPair>> from;
    HashTable<label> place;
    forAll(groups, groupi)
    {
        const List<motionParameter> its(groups[groupi].parameters());
        forAll(its, i)
        {
            if (place.insert(its[i].name, all.size()))
            {
                all.append(its[i]);
                from.append(DynamicList<labelPair>());
            }
            const label parameteri = place[its[i].name];
            if (all[parameteri].value != its[i].value)
            {
                FatalIOErrorInFunction(groups[groupi].dict())
                    << "Parameter '" << its[i].name << "' is "
                    << its[i].value << " in group '" << groups[groupi].name()
                    << "', but " << all[parameteri].value << " in another"
                    << nl
                    << "    Groups with boxes of one name share their"
                    << " parameters. Give the boxes other names, or the"
                    << " parameter one value" << nl << exit(FatalIOError);
            }
            from[parameteri].append(labelPair(groupi, i));
        }
    }
    sources.transfer(from);
    return List<motionParameter>(all);
}


Foam::tmp<Foam::vectorField> Foam::rbfSensitivities::operator()
(
    const label parameteri
)
{
    if (first_ < 0 || parameteri < first_ || parameteri >= first_ + batch_.size())
    {
        compute(parameteri);
    }
    return tmp<vectorField>::New(batch_[parameteri - first_]);
}


// ************************************************************************* //
