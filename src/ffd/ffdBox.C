/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "ffdBulk.H"
#include "foldCertificate.hpp"
#include "ListOps.H"

#include <cmath>
#include <functional>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

// Points closer to a face than this, in fractions of the box, are on it
static const scalar onFace = 1e-8;


// d xi/d x, without looking for xi once more where that takes iterations
static Eigen::Matrix3d gradientAt
(
    const morph::FfdFrame& frame,
    const Vector3& x,
    const Vector3& xi
)
{
    return
        frame.controlPoints()
      ? Eigen::Matrix3d(frame.frameJacobian(xi).inverse())
      : frame.gradient(x);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdBox::ffdBox
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    ffdDeformation(dict),
    settings_(ffdBoxSettings::read(dict)),
    frozenFaces_(false)
{
    control_.setZero(settings_.lattice->size(), 3);
    readParameters(registry);
    readAxis(registry);
}


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
         && settings_.frame->frameCoordinates(Vector3::Zero())[0] <= 0;
        if (onAxis)
        {
            FatalIOErrorInFunction(parameter.dict())
                << "Entry 'moves': point " << point << " of box '" << name_
                << "' is on the axis, where points are at rest" << nl
                << "    Move points from (1 j k) on, or let the radius of"
                << " 'start' be positive" << nl << exit(FatalIOError);
        }

        const Vector3 given = toEigen(move.second());
        const Vector3 moved =
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


morph::Vectors Foam::ffdBox::controlDerivative(const label parameteri) const
{
    morph::Vectors control = morph::Vectors::Zero(control_.rows(), 3);
    if (resting_[parameteri])
    {
        return control;
    }
    for (const auto& move : moves_[parameteri])
    {
        const Vector3 v = toEigen(move.second());
        control.row(move.first()) +=
        (
            axis_.valid()
          ? Vector3
            (
                v
              + axis_->section
                (
                    fractions_[std::size_t(move.first())]
                ).change*v
            )
          : v
        ).transpose();
    }
    if (axis_.valid() && axis_->has(parameteri))
    {
        for (Eigen::Index i = 0; i < control.rows(); ++i)
        {
            const auto section =
                axis_->byParameter(fractions_[std::size_t(i)], parameteri);
            control.row(i) =
            (
                section.shift + section.change*arms_.row(i).transpose()
            ).transpose();
        }
    }
    return projection_ ? projection_(control) : control;
}


morph::Vectors Foam::ffdBox::carriedDerivative
(
    const vectorField& velocity
) const
{
    const Eigen::Index n = rest_.rows();
    const morph::Vectors all = asVectors(velocity);
    const morph::Vectors base =
        axis_->axis().along(fractions_, all.bottomRows(all.rows() - n));
    morph::Vectors control(n, 3);
    for (Eigen::Index i = 0; i < n; ++i)
    {
        control.row(i) =
        (
            axis_->section(fractions_[std::size_t(i)]).change
           *(all.row(i) - base.row(i)).transpose()
        ).transpose();
    }
    return control;
}


bool Foam::ffdBox::contains(const Vector3& xi) const
{
    // Comparisons with what is not a number are trapped: ask for it first
    return
        !xi.hasNaN()
     && xi.minCoeff() >= -onFace && xi.maxCoeff() <= 1 + onFace;
}


Foam::wordList Foam::ffdBox::offenders
(
    const Vector3& xi,
    const scalar scale
) const
{
    // The derivative of the determinant by the value, times the value: what a
    // parameter contributes to the fold
    const Eigen::Matrix3d J =
        settings_.frame->frameJacobian(xi)
      + scale*settings_.lattice->gradient(xi, control_);
    Eigen::Matrix3d cofactors;
    cofactors <<
        J.col(1).cross(J.col(2)), J.col(2).cross(J.col(0)),
        J.col(0).cross(J.col(1));

    scalarField contributions(parameters_.size());
    scalar worst = 0;
    forAll(parameters_, i)
    {
        contributions[i] = parameters_[i].value()*cofactors.cwiseProduct
        (
            settings_.lattice->gradient(xi, controlDerivative(i))
        ).sum();
        worst = min(worst, contributions[i]);
    }

    labelList order;
    sortedOrder(contributions, order);
    wordList names;
    for (const label i : order)
    {
        // If none does (a negative radius): all parameters that act
        const bool contributes = worst == 0 || contributions[i] <= 0.1*worst;
        if (parameters_[i].value() != 0 && contributes)
        {
            names.append(parameters_[i].name());
        }
    }
    return names;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::ffdBox::update()
{
    control_.setZero();
    forAll(parameters_, i)
    {
        const scalar value = parameters_[i].value();
        if (resting_[i])
        {
            checkResting(i, -1);
        }
        if (value != 0)
        {
            for (const auto& move : moves_[i])
            {
                control_.row(move.first()) +=
                    value*toEigen(move.second()).transpose();
            }
        }
    }
    if (!axis_.valid())
    {
        return;
    }

    axis_->update(parameters_);
    const Eigen::Index n = rest_.rows();
    const morph::Vectors carried = asVectors(carried_);
    const morph::Vectors base = axis_->axis().along
    (
        fractions_,
        axis_->axis().points() + carried.bottomRows(carried.rows() - n)
    );
    arms_ = rest_ + carried.topRows(n) + control_ - base;
    for (Eigen::Index i = 0; i < n; ++i)
    {
        const auto section = axis_->section(fractions_[std::size_t(i)]);
        control_.row(i) +=
        (
            section.shift + section.change*arms_.row(i).transpose()
        ).transpose();
    }
}


Foam::labelList Foam::ffdBox::held() const
{
    const bool axis =
        settings_.frame->radial()
     && settings_.frame->frameCoordinates(Vector3::Zero())[0] <= 0;
    labelHashSet numbers;
    labelVector p;
    for (p.z() = 0; p.z() < settings_.nPoints(2); ++p.z())
    {
        for (p.y() = 0; p.y() < settings_.nPoints(1); ++p.y())
        {
            for (p.x() = 0; p.x() < settings_.nPoints(0); ++p.x())
            {
                bool rests = axis && p.x() == 0;
                forAll(frozenFaces_, face)
                {
                    rests = rests || (frozenFaces_[face] && frozen(p, face));
                }
                if (rests)
                {
                    numbers.insert(settings_.numbers(p));
                }
            }
        }
    }
    return numbers.sortedToc();
}


Foam::pointField Foam::ffdBox::carriedPoints() const
{
    if (!axis_.valid())
    {
        return pointField();
    }
    const morph::Vectors& onAxis = axis_->axis().points();
    pointField points(label(rest_.rows() + onAxis.rows()));
    forAll(points, i)
    {
        points[i] = toFoam
        (
            i < rest_.rows()
          ? Vector3(rest_.row(i).transpose())
          : Vector3(onAxis.row(i - rest_.rows()).transpose())
        );
    }
    return points;
}


void Foam::ffdBox::carry(const vectorField& displacement)
{
    carried_ = displacement;
}


Foam::vectorField Foam::ffdBox::displacementOf(const pointField& points) const
{
    vectorField d(points.size(), Zero);
    forAll(points, i)
    {
        const Vector3 x = toEigen(points[i]);
        const Vector3 xi = settings_.frame->coordinates(x);
        if (contains(xi))
        {
            d[i] = toFoam
            (
                settings_.frame->displacement
                (
                    x, settings_.lattice->displacement(xi, control_)
                )
            );
        }
    }
    return d;
}


static Foam::vectorField derivativeAt
(
    const Foam::ffdBoxSettings& settings,
    const Foam::pointField& points,
    const morph::Vectors& control,
    const morph::Vectors& velocity,
    const std::function<bool(const morph::Vector3&)>& contains
)
{
    using namespace Foam;
    vectorField d(points.size(), Zero);
    forAll(points, i)
    {
        const Vector3 x = toEigen(points[i]);
        const Vector3 xi = settings.frame->coordinates(x);
        if (contains(xi))
        {
            const Vector3 v = settings.lattice->displacement(xi, velocity);
            d[i] = toFoam
            (
                settings.frame->displacementByLattice
                (
                    x, settings.lattice->displacement(xi, control)
                )*v
            );
        }
    }
    return d;
}


Foam::vectorField Foam::ffdBox::derivativeOf
(
    const pointField& points,
    const label parameteri
) const
{
    return derivativeAt
    (
        settings_, points, control_, controlDerivative(parameteri),
        [this](const Vector3& xi) { return contains(xi); }
    );
}


Foam::vectorField Foam::ffdBox::derivativeOf
(
    const pointField& points,
    const vectorField& velocity
) const
{
    if (!axis_.valid())
    {
        return vectorField(points.size(), Zero);
    }
    return derivativeAt
    (
        settings_, points, control_, carriedDerivative(velocity),
        [this](const Vector3& xi) { return contains(xi); }
    );
}


Foam::vectorField Foam::ffdBox::carriedDerivative
(
    const pointField& points,
    const vectorField& velocity
) const
{
    if (!axis_.valid())
    {
        return vectorField(inside_.size(), Zero);
    }
    return derivative(points, carriedDerivative(velocity));
}


void Foam::ffdBox::checkFold() const
{
    checkAxisFrozen(frozenFaces_);
    morph::FoldCertificate certificate
    (
        *settings_.frame, *settings_.lattice, control_
    );
    try
    {
        if (certificate.valid())
        {
            return;
        }
    }
    catch (const std::length_error& wrong)
    {
        FatalIOErrorInFunction(dict_)
            << "Box '" << name_ << "', entry 'order': " << wrong.what() << nl
            << "    Use 'basis bSpline' with 'degree (3 3 3)', or a lower order"
            << nl << exit(FatalIOError);
    }
    const Vector3 where = certificate.where();
    const scalar safe = certificate.safeScale();
    FatalIOErrorInFunction(dict_)
        << "Box '" << name_ << "' folds: at (s t p) = " << toFoam(where)
        << ", position " << toFoam(settings_.frame->position(where)) << ","
        << nl << "    the Jacobian determinant of its map is not positive."
        << nl << "    Parameters that cause it: "
        << plainText::listed
           (
               offenders(certificate.where(), safe)
           ).c_str() << nl
        << "    Largest safe scale: " << std::floor(1e4*safe)/1e4
        << " times the values of all parameters of the box" << nl
        << exit(FatalIOError);
}


Foam::pointField Foam::ffdBox::lattice(const bool moved) const
{
    const morph::FfdFrame& frame = *settings_.frame;
    const labelVector& order = settings_.order;
    pointField points((order.x() + 1)*(order.y() + 1)*(order.z() + 1));
    label i = 0;
    labelVector p;
    for (p.z() = 0; p.z() <= order.z(); ++p.z())
    {
        for (p.y() = 0; p.y() <= order.y(); ++p.y())
        {
            for (p.x() = 0; p.x() <= order.x(); ++p.x())
            {
                const Vector3 rest = settings_.restPosition(p);
                labelVector own(p);
                own.y() = p.y() % settings_.nPoints(1);
                const label number = settings_.numbers(own)[0];
                points[i++] = toFoam
                (
                    moved
                  ? Vector3
                    (
                        rest + frame.displacement
                        (
                            rest, control_.row(number).transpose()
                        )
                    )
                  : rest
                );
            }
        }
    }
    return points;
}


Foam::labelListList Foam::ffdBox::latticeLines() const
{
    const labelVector n(settings_.order + labelVector::one);
    const labelVector step(1, n.x(), n.x()*n.y());
    DynamicList<labelList> lines;
    for (direction d = 0; d < 3; ++d)
    {
        for (label i = 0; i < cmptProduct(n); ++i)
        {
            if (n[d] > 1 && i/step[d] % n[d] == 0)
            {
                labelList line(n[d]);
                forAll(line, j)
                {
                    line[j] = i + j*step[d];
                }
                lines.append(line);
            }
        }
    }
    return labelListList(std::move(lines));
}


void Foam::ffdBox::setPoints(const pointField& points)
{
    DynamicList<label> labels;
    DynamicList<vector> coordinates;
    forAll(points, i)
    {
        const Vector3 xi =
            settings_.frame->coordinates(toEigen(points[i]));
        if (contains(xi))
        {
            labels.append(i);
            coordinates.append(toFoam(xi));
        }
    }
    inside_.transfer(labels);
    coordinates_ = asVectors(coordinates);
    rows_ = settings_.lattice->rows(coordinates_);
}


Foam::vectorField Foam::ffdBox::displacement(const pointField& points) const
{
    const morph::Vectors d =
        settings_.lattice->displacement(rows_, control_);
    vectorField displacement(inside_.size());
    forAll(inside_, i)
    {
        displacement[i] = toFoam
        (
            settings_.frame->displacement
            (
                toEigen(points[inside_[i]]), d.row(i).transpose()
            )
        );
    }
    return displacement;
}


Foam::vectorField Foam::ffdBox::derivative
(
    const pointField& points,
    const label parameteri
) const
{
    return derivative(points, controlDerivative(parameteri));
}


Foam::vectorField Foam::ffdBox::derivative
(
    const pointField& points,
    const morph::Vectors& control
) const
{
    const morph::FfdLattice& lattice = *settings_.lattice;
    const morph::Vectors byValue = lattice.displacement(rows_, control);
    vectorField derivative(inside_.size());
    if (!settings_.frame->radial())
    {
        forAll(inside_, i)
        {
            derivative[i] = toFoam(byValue.row(i).transpose());
        }
        return derivative;
    }

    const morph::Vectors d = lattice.displacement(rows_, control_);
    forAll(inside_, i)
    {
        const Eigen::Matrix3d byLattice =
            settings_.frame->displacementByLattice
            (
                toEigen(points[inside_[i]]), d.row(i).transpose()
            );
        derivative[i] = toFoam(byLattice*byValue.row(i).transpose());
    }
    return derivative;
}


Foam::vectorField Foam::ffdBox::directional
(
    const pointField& points,
    const vectorField& v
) const
{
    const morph::FfdFrame& frame = *settings_.frame;
    const morph::FfdLattice& lattice = *settings_.lattice;
    const morph::Vectors d = lattice.displacement(rows_, control_);
    vectorField result(inside_.size());
    forAll(inside_, i)
    {
        const Vector3 x = toEigen(points[inside_[i]]);
        const Vector3 di = d.row(i).transpose();
        const Vector3 xi = coordinates_.row(i).transpose();
        const Eigen::Matrix3d gradient =
            frame.displacementByLattice(x, di)
           *lattice.gradient(xi, control_)*gradientAt(frame, x, xi)
          + frame.displacementByPosition(x, di);
        result[i] = toFoam(gradient*toEigen(v[inside_[i]]));
    }
    return result;
}


// ************************************************************************* //
