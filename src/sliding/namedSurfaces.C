/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "namedSurfaces.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Largest distance of a point from the surface it is on, in face sizes, and
// from one that it is to slide onto, in spans of its group
static const scalar onSurface = 0.5;
static const scalar nearTarget = 0.5;

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::namedSurfaces::namedSurfaces
(
    const polyMesh& mesh,
    const PtrList<controlPointGroup>& groups,
    const scalar featureAngle
)
:
    groups_(groups),
    surfaces_(groups.size())
{
    forAll(groups_, groupi)
    {
        const controlPointGroup& group = groups_[groupi];
        if (group.surface() == controlPointGroup::surfaceType::named)
        {
            surfaces_.set
            (
                groupi,
                slidingSurface::New
                (
                    group.namedSurface(), group.dict(), mesh, featureAngle
                ).ptr()
            );
        }
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::boundBox Foam::namedSurfaces::extent
(
    const gatheredFaces& faces,
    const label groupi
)
{
    boundBox box;
    forAll(faces.faces(), i)
    {
        if (faces.tags()[i] == groupi)
        {
            for (const label v : faces.faces()[i])
            {
                box.add(faces.points()[v]);
            }
        }
    }
    return box;
}


Foam::scalar Foam::namedSurfaces::largestEdge
(
    const gatheredFaces& faces,
    const label groupi
)
{
    scalar largest = 0;
    forAll(faces.faces(), i)
    {
        const face& f = faces.faces()[i];
        for (label k = 0; faces.tags()[i] == groupi && k < f.size(); ++k)
        {
            largest = max(largest, f.faceEdge(k).mag(faces.points()));
        }
    }
    return largest;
}


Foam::scalar Foam::namedSurfaces::largestDistance
(
    const gatheredFaces& faces,
    const label groupi,
    point& where
) const
{
    scalar largest = 0;
    labelHashSet done;
    forAll(faces.faces(), i)
    {
        if (faces.tags()[i] != groupi)
        {
            continue;
        }
        for (const label v : faces.faces()[i])
        {
            const point& x = faces.points()[v];
            const scalar distance =
                done.insert(v)
              ? mag(x - surfaces_[groupi].nearest(x).position)
              : 0;
            if (distance > largest)
            {
                largest = distance;
                where = x;
            }
        }
    }
    return largest;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::namedSurfaces::checkDistances(const gatheredFaces& faces) const
{
    forAll(groups_, groupi)
    {
        if (!surfaces_.set(groupi))
        {
            continue;
        }
        const controlPointGroup& group = groups_[groupi];
        const scalar allowed =
            group.hasTarget()
          ? nearTarget*extent(faces, groupi).mag()
          : onSurface*largestEdge(faces, groupi);

        // Every rank has all vertices and gets the same result
        point where(Zero);
        const scalar largest = largestDistance(faces, groupi, where);
        if (largest > allowed)
        {
            FatalIOErrorInFunction(group.dict())
                << "Points of group '" << group.name() << "' are up to "
                << largest << " m from the surface that '"
                << group.namedSurface().keyword() << "' names, at " << where
                << nl
                << (
                        group.hasTarget()
                      ? "    Is it in other units, or another place? It has to"
                        " be within half the size of the group ("
                      : "    Points slide on a surface that they are on: it has"
                        " to be within half a face ("
                   )
                << allowed << " m)"
                << (
                        group.hasTarget()
                      ? ""
                      : "; to move them onto another one, name it as 'target'"
                   )
                << nl << exit(FatalIOError);
        }
    }
}


// ************************************************************************* //
