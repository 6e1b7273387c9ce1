/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdBox.H"
#include "eigenFields.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

using morph::Vector3;

// A line that moves by less than this across a face runs along it, in
// fractions of the box
static const scalar along = 1e-8;

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdBox::markExit
(
    const point& a,
    const point& b,
    faceFlags& faces
) const
{
    // Lines of space are curved in some boxes: from as near to the exit as
    // round-off allows they are straight
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
    for (label d = 0; d < 3; ++d)
    {
        if (mag(direction[d]) > along)
        {
            const label face = direction[d] > 0 ? d + 3 : d;
            const scalar wall = direction[d] > 0 ? 1 : 0;
            reached[face] = max((wall - xi[d])/direction[d], scalar(0));
            first = min(first, reached[face]);
        }
    }
    forAll(faces, face)
    {
        faces[face] = faces[face] || reached[face] < first + 1e-6;
    }
}


bool Foam::ffdBox::frozen(const labelVector& point, const label face) const
{
    const direction d = face % 3;
    const label layer =
        face < 3 ? point[d] : settings_.order[d] - point[d];
    return layer < settings_.frozenLayers;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::string Foam::ffdBox::faceName(const label face)
{
    const char* names[] = {"s = 0", "t = 0", "p = 0", "s = 1", "t = 1", "p = 1"};
    return names[face];
}


Foam::ffdBox::faceFlags Foam::ffdBox::crossed
(
    const pointField& points,
    const edgeList& edges
) const
{
    boolList isIn(points.size(), false);
    UIndirectList<bool>(isIn, inside_) = true;

    faceFlags faces(false);
    for (const edge& e : edges)
    {
        if (isIn[e.start()] != isIn[e.end()])
        {
            const label in = isIn[e.start()] ? e.start() : e.end();
            markExit(points[in], points[e.otherVertex(in)], faces);
        }
    }
    return faces;
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


void Foam::ffdBox::checkFrozen(const faceFlags& shared) const
{
    forAll(shared, face)
    {
        for (const ffdParameter& parameter : parameters_)
        {
            for (const auto& move : parameter.moves())
            {
                if (!shared[face] || !frozen(move.first(), face))
                {
                    continue;
                }
                FatalIOErrorInFunction(parameter.dict())
                    << "Entry 'moves': point " << move.first() << " of box '"
                    << name_ << "' is in a frozen layer: there is mesh beyond"
                    << " the face " << faceName(face).c_str() << "," << nl
                    << "    where 'continuity "
                    << ffdBoxSettings::continuityNames[settings_.frozenLayers]
                    << "' keeps " << settings_.frozenLayers
                    << " layer(s) of control points at rest" << nl
                    << "    Move points further inside, make the box larger"
                    << " than the mesh there, or ask for less continuity" << nl
                    << exit(FatalIOError);
            }
        }
    }
}

// ************************************************************************* //
