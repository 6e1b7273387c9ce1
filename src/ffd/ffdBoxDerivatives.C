/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "eigenFields.H"

#include <functional>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;


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


static vectorField derivativeAt
(
    const ffdBoxSettings& settings,
    const pointField& points,
    const morph::Vectors& control,
    const morph::Vectors& velocity,
    const std::function<bool(const morph::Vector3&)>& contains
)
{
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

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

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
