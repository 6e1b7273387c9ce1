/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foldCertificate.hpp"
#include "ListOps.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

// Points this near to a face, in fractions of the box, are on it
static const scalar onFace = 1e-8;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdBox::ffdBox
(
    const dictionary& dict,
    const objectRegistry* registry
)
:
    dict_(dict),
    name_(dict.dictName()),
    settings_(ffdBoxSettings::read(dict))
{
    readParameters(registry);
    control_.setZero(settings_.lattice->size(), 3);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBox::readParameters(const objectRegistry* registry)
{
    for (const entry& e : dict_.subDict("parameters"))
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict_.subDict("parameters"))
                << "Entry '" << e.keyword() << "' has to be a dictionary: "
                << e.keyword() << " { value 0; moves ( ((i j k) (x y z)) ); }"
                << nl << exit(FatalIOError);
        }
        parameters_.append(new ffdParameter(e.dict(), registry));
        moves_.append(readMoves(parameters_.last()));
    }
}


morph::Vectors Foam::ffdBox::readMoves(const ffdParameter& parameter) const
{
    morph::Vectors moves =
        morph::Vectors::Zero(settings_.lattice->size(), 3);

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
            moves.row(i) += moved.transpose();
        }
    }
    return moves;
}


bool Foam::ffdBox::contains(const Vector3& xi) const
{
    return
        xi.minCoeff() >= -onFace && xi.maxCoeff() <= 1 + onFace
     && !xi.hasNaN();
}


Foam::wordList Foam::ffdBox::offenders
(
    const Vector3& xi,
    const scalar scale
) const
{
    // The derivative of the determinant by the value, times the value: what a
    // parameter contributes to the fold
    const morph::FfdFrame& frame = *settings_.frame;
    Eigen::Matrix3d J = scale*settings_.lattice->gradient(xi, control_);
    for (int d = 0; d < 3; ++d)
    {
        Vector3 from = xi, to = xi;
        from[d] = 0;
        to[d] = 1;
        J.col(d) += frame.frameCoordinates(to) - frame.frameCoordinates(from);
    }
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
            settings_.lattice->gradient(xi, moves_[i])
        ).sum();
        worst = min(worst, contributions[i]);
    }

    labelList order;
    sortedOrder(contributions, order);
    wordList names;
    for (const label i : order)
    {
        // Where none does (a radius that becomes negative): all that act
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
        if (parameters_[i].value() != 0)
        {
            control_ += parameters_[i].value()*moves_[i];
        }
    }
}


void Foam::ffdBox::checkFold() const
{
    morph::FoldCertificate certificate
    (
        *settings_.frame, *settings_.lattice, control_
    );
    if (certificate.valid())
    {
        return;
    }
    const Vector3 where = certificate.where();
    const scalar safe = certificate.safeScale();
    FatalIOErrorInFunction(dict_)
        << "Box '" << name_ << "' folds: at (s t p) = " << toFoam(where)
        << ", which is " << toFoam(settings_.frame->position(where)) << ","
        << nl << "    the Jacobian determinant of its map is not positive."
        << nl << "    Parameters that bring it about: "
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
                const Vector3 rest = frame.position(settings_.rest(p));
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
    const morph::FfdLattice& lattice = *settings_.lattice;
    const morph::Vectors d = lattice.displacement(rows_, control_);
    const morph::Vectors byValue =
        lattice.displacement(rows_, moves_[parameteri]);
    vectorField derivative(inside_.size());
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
           *lattice.gradient(xi, control_)*frame.gradient(x)
          + frame.displacementByPosition(x, di);
        result[i] = toFoam(gradient*toEigen(v[inside_[i]]));
    }
    return result;
}


// ************************************************************************* //
