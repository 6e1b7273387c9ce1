/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "eigenFields.H"
#include "plainText.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

// A line that crosses a face by less than this runs along it, in fractions of
// the box
static const scalar along = 1e-8;

// What is this near to a face is on it, in fractions of the box or of a line
static const scalar near = 1e-6;


// Is there a direction with which all of these have an acute angle?
static bool haveCommonSide(const std::vector<Vector3>& normals)
{
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if (normals[i].dot(normals[j]) < -1 + near)
            {
                return false;
            }
        }
    }

    // Rosenblatt's perceptron: it ends if there is one
    const label most = 400;
    Vector3 side = Vector3::Zero();
    for (const Vector3& normal : normals)
    {
        side += normal;
    }
    for (label i = 0; i < most; ++i)
    {
        const Vector3* worst = nullptr;
        scalar least = 1e-3*side.norm();
        for (const Vector3& normal : normals)
        {
            if (normal.dot(side) <= least)
            {
                least = normal.dot(side);
                worst = &normal;
            }
        }
        if (!worst)
        {
            return true;
        }
        side += *worst;
    }
    return false;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBox::addExit
(
    const point& a,
    const point& b,
    ffdExits& exits
) const
{
    // Straight lines are curved in the coordinates of some boxes: close enough
    // to the exit, as far as round-off allows, they are straight
    const morph::FfdFrame& frame = *settings_.frame;
    const Vector3 from = toEigen(a);
    const Vector3 line = toEigen(b) - from;
    scalar in = 0;
    scalar out = 1;
    while (out - in > 1e-9)
    {
        const scalar middle = 0.5*(in + out);
        const bool isIn = contains(frame.coordinates(from + middle*line));
        (isIn ? in : out) = middle;
    }
    const Vector3 exit = from + in*line;
    const Vector3 xi = frame.coordinates(exit);
    const Vector3 direction = frame.gradient(exit)*line;

    scalar first = GREAT;
    FixedList<scalar, 6> reached(GREAT);
    ffdExits::faceFlags on(false);
    for (label d = 0; d < 3; ++d)
    {
        if (d == 1 && frame.ring())
        {
            continue;
        }
        on[d] = mag(xi[d]) < near;
        on[d + 3] = mag(xi[d] - 1) < near;
        if (mag(direction[d]) > along)
        {
            const label face = direction[d] > 0 ? d + 3 : d;
            const scalar wall = direction[d] > 0 ? 1 : 0;
            reached[face] = max((wall - xi[d])/direction[d], scalar(0));
            first = min(first, reached[face]);
        }
    }
    ffdExits::faceFlags through(false);
    forAll(through, face)
    {
        through[face] = reached[face] < first + near;
    }
    exits.add(on, through);
}


std::vector<morph::Vector3> Foam::ffdBox::inwards(const Vector3& xi) const
{
    const Eigen::Matrix3d gradient =
        settings_.frame->gradient(settings_.frame->position(xi));
    std::vector<Vector3> normals;
    for (label d = 0; d < 3; ++d)
    {
        const bool isFace = d != 1 || !settings_.frame->ring();
        const Vector3 normal = gradient.row(d).transpose();
        if (isFace && normal.norm() > 0)
        {
            if (xi[d] < near)
            {
                normals.push_back(normal.normalized());
            }
            if (xi[d] > 1 - near)
            {
                normals.push_back(-normal.normalized());
            }
        }
    }
    return normals;
}


Foam::label Foam::ffdBox::contact(const ffdBox& other) const
{
    const label n = 8;
    label found = 0;
    for (label i = 0; i <= n; ++i)
    {
        for (label j = 0; j <= n; ++j)
        {
            for (label k = 0; k <= n; ++k)
            {
                const Vector3 xi = Vector3(i, j, k)/n;
                const Vector3 x = settings_.frame->position(xi);
                const Vector3 there = other.settings_.frame->coordinates(x);
                if (!other.contains(there))
                {
                    continue;
                }
                std::vector<Vector3> normals = inwards(xi);
                for (const Vector3& normal : other.inwards(there))
                {
                    normals.push_back(normal);
                }
                if (haveCommonSide(normals))
                {
                    return 2;
                }
                found = 1;
            }
        }
    }
    return found;
}


bool Foam::ffdBox::frozen(const labelVector& point, const label face) const
{
    const direction d = face % 3;
    const label layer =
        face < 3 ? point[d] : settings_.order[d] - point[d];
    return layer < settings_.frozenLayers;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::vector Foam::ffdBox::across
(
    const ffdBox& other,
    const point& x
) const
{
    const Vector3 at = toEigen(x);
    const Vector3 xi = settings_.frame->coordinates(at);
    const auto theirs =
        other.inwards(other.settings_.frame->coordinates(at));
    for (const Vector3& normal : inwards(xi))
    {
        for (const Vector3& opposite : theirs)
        {
            if (normal.dot(opposite) < -1 + near)
            {
                const scalar slope =
                    (settings_.frame->gradient(at)*normal)
                   .cwiseAbs().maxCoeff();
                return toFoam(Vector3(normal/slope));
            }
        }
    }
    return Zero;
}


bool Foam::ffdBox::touches(const ffdDeformation& other) const
{
    const ffdBox* box = dynamic_cast<const ffdBox*>(&other);
    if (!box)
    {
        return false;
    }
    return max(contact(*box), box->contact(*this)) == 1;
}


Foam::ffdExits Foam::ffdBox::exits
(
    const pointField& points,
    const edgeList& edges,
    const boolList& carried
) const
{
    boolList isIn(points.size(), false);
    UIndirectList<bool>(isIn, inside_) = true;

    ffdExits found;
    for (const edge& e : edges)
    {
        if (isIn[e.start()] != isIn[e.end()])
        {
            const label in = isIn[e.start()] ? e.start() : e.end();
            const label out = e.otherVertex(in);
            if (!carried[out])
            {
                addExit(points[in], points[out], found);
            }
        }
    }
    return found;
}


Foam::wordList Foam::ffdBox::moving(const label face) const
{
    const direction d = face % 3;
    const label layer = face < 3 ? 0 : settings_.order[d];
    wordList names;
    for (const ffdParameter& parameter : parameters_)
    {
        for (const auto& move : parameter.moves())
        {
            if (move.first()[d] == layer && !names.found(parameter.name()))
            {
                names.append(parameter.name());
            }
        }
    }
    return names;
}


void Foam::ffdBox::checkFrozen(const ffdExits::faceFlags& shared)
{
    resting_ = false;
    frozenFaces_ = shared;
    forAll(parameters_, i)
    {
        const ffdParameter& parameter = parameters_[i];
        forAll(shared, face)
        {
            for (const auto& move : parameter.moves())
            {
                if (!shared[face] || !frozen(move.first(), face))
                {
                    continue;
                }
                if (parameter.generated())
                {
                    checkResting(i, face);
                    resting_[i] = true;
                    continue;
                }
                FatalIOErrorInFunction(parameter.dict())
                    << "Entry 'moves': point " << move.first() << " of box '"
                    << name_ << "' is in a frozen layer: there is mesh beyond"
                    << " the face " << ffdExits::faceName(face).c_str() << ","
                    << nl << "    where 'continuity "
                    << ffdBoxSettings::continuityNames[settings_.frozenLayers]
                    << "' freezes "
                    << plainText::counted
                       (
                           settings_.frozenLayers, "layer"
                       ).c_str()
                    << " of control points" << nl
                    << "    Move points further inside, make the box larger"
                    << " than the mesh there (a face that is meant to lie on a"
                    << " wall has to reach it), or ask for less continuity"
                    << nl << exit(FatalIOError);
            }
        }
    }
    checkAxisFrozen(shared);
}


void Foam::ffdBox::checkAxisFrozen(const ffdExits::faceFlags& shared) const
{
    if (!axis_.valid() || settings_.frozenLayers == 0)
    {
        return;
    }

    // What the axis moves it moves as a whole: its present motion tells
    const scalar largest = control_.rowwise().norm().maxCoeff();
    labelVector p;
    for (p.z() = 0; p.z() <= settings_.order.z(); ++p.z())
    {
        for (p.y() = 0; p.y() <= settings_.order.y(); ++p.y())
        {
            for (p.x() = 0; p.x() <= settings_.order.x(); ++p.x())
            {
                forAll(shared, face)
                {
                    const Vector3 d = control_.row
                    (
                        settings_.lattice->number(p.x(), p.y(), p.z())
                    ).transpose();
                    const bool moves =
                        shared[face] && frozen(p, face)
                     && d.norm() > 1e-12*largest;
                    if (moves)
                    {
                        FatalIOErrorInFunction(dict_.subDict("axis"))
                            << "The variables of the axis move point " << p
                            << " of box '" << name_ << "' by " << toFoam(d)
                            << ", which is in a frozen layer: there is mesh"
                            << " beyond the face "
                            << ffdExits::faceName(face).c_str() << nl
                            << "    Let 'along' of the variables be zero"
                            << " there, make the box larger than the mesh, or"
                            << " set 'continuity none'" << nl
                            << exit(FatalIOError);
                    }
                }
            }
        }
    }
}


// ************************************************************************* //
