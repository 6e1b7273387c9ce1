/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "triangulatedSurface.H"
#include "triPointRef.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Barycentric coordinates below this count as zero
static const scalar onEdge = 1e-9;


static scalar angleAt(const point& x, const point& a, const point& b)
{
    const vector u = a - x;
    const vector v = b - x;
    return Foam::atan2(mag(u ^ v), u & v);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::triangulatedSurface::triangulatedSurface
(
    const triSurface& surface,
    const scalar featureAngle
)
:
    surface_(surface),
    search_(surface_),
    normals_(surface_.size()),
    rimEdge_(surface_.size()),
    rimCorner_(surface_.size()),
    edges_(nullptr)
{
    findNormals(featureAngle);
    findEdges(featureAngle);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::triangulatedSurface::findNormals(const scalar featureAngle)
{
    const pointField& x = surface_.localPoints();
    const List<labelledTri>& triangles = surface_.localFaces();
    vectorField unit(triangles.size());
    forAll(triangles, i)
    {
        unit[i] = normalised(triangles[i].areaNormal(x));
    }

    const scalar least = Foam::cos(featureAngle);
    forAll(triangles, i)
    {
        for (label corner = 0; corner < 3; ++corner)
        {
            const label pointi = triangles[i][corner];
            vector sum(Zero);
            for (const label j : surface_.pointFaces()[pointi])
            {
                const labelledTri& t = triangles[j];
                const scalar cosine = unit[i] & unit[j];
                if (j == i || cosine > least)
                {
                    const label k = t.find(pointi);
                    sum += unit[j]*angleAt
                    (
                        x[pointi], x[t[(k + 1) % 3]], x[t[(k + 2) % 3]]
                    );
                }
            }
            normals_[i][corner] = mag(sum) > VSMALL ? normalised(sum) : unit[i];
        }
    }
}


void Foam::triangulatedSurface::findEdges(const scalar featureAngle)
{
    const pointField& x = surface_.localPoints();
    const List<labelledTri>& triangles = surface_.localFaces();
    HashSet<edge, Hash<edge>> rim;
    labelHashSet rimPoints;
    DynamicList<edge> sharp;
    forAll(surface_.edges(), i)
    {
        const edge& e = surface_.edges()[i];
        const labelList& faces = surface_.edgeFaces()[i];
        if (faces.size() == 1)
        {
            rim.insert(e);
            rimPoints.insert(e.start());
            rimPoints.insert(e.end());
            continue;
        }
        const vector n = normalised(triangles[faces[0]].areaNormal(x));
        for (label f = 1; f < faces.size(); ++f)
        {
            const vector m = normalised(triangles[faces[f]].areaNormal(x));
            const bool some = n != vector(Zero) && m != vector(Zero);
            if (some && (n & m) < Foam::cos(featureAngle))
            {
                sharp.append(e);
                break;
            }
        }
    }

    forAll(triangles, i)
    {
        for (label corner = 0; corner < 3; ++corner)
        {
            const edge opposite
            (
                triangles[i][(corner + 1) % 3], triangles[i][(corner + 2) % 3]
            );
            rimEdge_[i][corner] = rim.found(opposite);
            rimCorner_[i][corner] = rimPoints.found(triangles[i][corner]);
        }
    }
    if (sharp.size())
    {
        edges_.reset(new slidingCurve(x, edgeList(sharp), featureAngle));
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::slidingSurface::contact Foam::triangulatedSurface::nearest
(
    const point& x
) const
{
    const pointIndexHit hit = search_.tree().findNearest(x, sqr(GREAT));
    const label i = hit.index();
    const point& c = hit.hitPoint();
    const triPointRef triangle(surface_[i].tri(surface_.points()));

    // Barycentric coordinates are fractions of the area
    const vector area = triangle.areaNormal();
    const scalar size = max(magSqr(area), VSMALL);
    FixedList<scalar, 3> w;
    w[0] = (triPointRef(c, triangle.b(), triangle.c()).areaNormal() & area)/size;
    w[1] = (triPointRef(triangle.a(), c, triangle.c()).areaNormal() & area)/size;
    w[2] = 1 - w[0] - w[1];

    vector normal(Zero);
    label nZero = 0;
    bool onRim = false;
    for (label corner = 0; corner < 3; ++corner)
    {
        normal += w[corner]*normals_[i][corner];
        if (w[corner] < onEdge)
        {
            ++nZero;
            onRim = onRim || rimEdge_[i][corner];
        }
    }
    if (nZero == 2)
    {
        const label corner = w[0] >= onEdge ? 0 : w[1] >= onEdge ? 1 : 2;
        onRim = rimCorner_[i][corner];
    }
    return {c, normalised(normal), onRim};
}


// ************************************************************************* //
