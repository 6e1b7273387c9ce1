/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
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


// ************************************************************************* //
