/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "ffdBulk.H"
#include "ListOps.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBox::readParameters(const objectRegistry* registry)
{
    if (dict_.found("parameters"))
    {
        const dictionary& given =
            dictionaryChecks::subDict(dict_, "parameters");
        for (const entry& e : given)
        {
            if (!e.isDict())
            {
                FatalIOErrorInFunction(given)
                    << "Entry '" << e.keyword() << "' has to be a dictionary: "
                    << e.keyword() << " { value 0; moves ( ((i j k) (x y z))"
                    << " ); }" << nl << exit(FatalIOError);
            }
            parameters_.append(new ffdParameter(e.dict(), registry));
        }
    }
    if (dict_.found("bulk"))
    {
        ffdBulk::append
        (
            dictionaryChecks::subDict(dict_, "bulk"), settings_, parameters_,
            registry
        );
    }
    moves_.setSize(parameters_.size());
    forAll(parameters_, i)
    {
        moves_[i] = readMoves(parameters_[i]);
    }

    const bool some =
        dict_.found("parameters") || dict_.found("bulk")
     || (!settings_.frame->radial() && dict_.found("axis"));
    if (!some)
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'parameters' is missing: box '" << name_
            << "' moves nothing" << nl
            << "    Write parameters { mu { value 0.1; moves ( ((1 1 1)"
            << " (1 0 0)) ); } }, or 'bulk' for many at once, or 'axis'" << nl
            << exit(FatalIOError);
    }
}


void Foam::ffdBox::readAxis(const objectRegistry* registry)
{
    // That of a cylindrical box is its own
    if (!settings_.frame->radial() && dict_.found("axis"))
    {
        const dictionary& given = dictionaryChecks::subDict(dict_, "axis");
        dictionaryChecks::onlyKeys(given, ffdAxis::keys());
        axis_.reset(new ffdAxis(given, parameters_, registry));
    }
    moves_.setSize(parameters_.size());
    resting_.setSize(parameters_.size(), false);
    if (!axis_.valid())
    {
        return;
    }

    rest_.resize(settings_.lattice->size(), 3);
    labelVector p;
    for (p.z() = 0; p.z() <= settings_.order.z(); ++p.z())
    {
        for (p.y() = 0; p.y() <= settings_.order.y(); ++p.y())
        {
            for (p.x() = 0; p.x() <= settings_.order.x(); ++p.x())
            {
                rest_.row
                (
                    settings_.lattice->number(p.x(), p.y(), p.z())
                ) = settings_.restPosition(p).transpose();
            }
        }
    }
    scalar least = GREAT;
    scalar most = -GREAT;
    for (Eigen::Index i = 0; i < rest_.rows(); ++i)
    {
        fractions_.push_back
        (
            axis_->axis().fraction(rest_.row(i).transpose())
        );
        least = min(least, fractions_.back());
        most = max(most, fractions_.back());
    }
    axis_->checkMet(least, most);
    carried_.setSize(carriedPoints().size(), Zero);
    arms_.setZero(rest_.rows(), 3);
}


Foam::ffdBox::latticeMoves Foam::ffdBox::readMoves
(
    const ffdParameter& parameter
) const
{
    DynamicList<Tuple2<label, vector>> moves;
    for (const auto& move : parameter.moves())
    {
        const labelVector& point = move.first();
        const labelList numbers(settings_.numbers(point));
        if (numbers.empty())
        {
            FatalIOErrorInFunction(parameter.dict())
                << "Entry 'moves': there is no point " << point
                << " in the lattice of box '" << name_ << "'" << nl
                << "    Indices are from (0 0 0) to ("
                << settings_.nPoints(0) - 1 << ' '
                << settings_.nPoints(1) - 1 << ' '
                << settings_.nPoints(2) - 1 << ')' << nl
                << exit(FatalIOError);
        }
        const bool onAxis =
            settings_.frame->radial() && point.x() == 0
         && settings_.frame->frameCoordinates(morph::Vector3::Zero())[0] <= 0;
        if (onAxis)
        {
            FatalIOErrorInFunction(parameter.dict())
                << "Entry 'moves': point " << point << " of box '" << name_
                << "' is on the axis, where points are at rest" << nl
                << "    Move points from (1 j k) on, or let the radius of"
                << " 'start' be positive" << nl << exit(FatalIOError);
        }

        const morph::Vector3 given = toEigen(move.second());
        const morph::Vector3 moved =
            settings_.units == ffdBoxSettings::unitType::metres
          ? settings_.frame->fromUnits(given)
          : settings_.frame->fromFractions(settings_.rest(point), given);
        for (const label i : numbers)
        {
            moves.append(Tuple2<label, vector>(i, toFoam(moved)));
        }
    }
    return latticeMoves(std::move(moves));
}


void Foam::ffdBox::checkResting
(
    const label parameteri,
    const label face
) const
{
    if (parameters_[parameteri].value() != 0)
    {
        FatalIOErrorInFunction(parameters_[parameteri].dict())
            << "Parameter '" << parameters_[parameteri].name() << "' of box '"
            << name_ << "' has the value " << parameters_[parameteri].value()
            << " but moves a frozen layer: there is mesh beyond a face," << nl
            << "    where 'continuity "
            << ffdBoxSettings::continuityNames[settings_.frozenLayers]
            << "' keeps " << settings_.frozenLayers
            << " layer(s) of control points at rest"
            << (face < 0 ? "" : ": ")
            << (face < 0 ? string() : ffdExits::faceName(face)).c_str() << nl
            << "    Leave those layers out by 'i', 'j' and 'k', or ask for"
            << " less continuity" << nl << exit(FatalIOError);
    }
}


// ************************************************************************* //
