/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "movingCells.H"
#include "eigenFields.H"

#include <algorithm>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A tetrahedron is flat below this fraction of the largest of its cell
static const scalar flat = 1e-3;

// Roots further apart than this cannot change order by round-off
static const scalar clearance = 1e-9;


//- The mean of the points, independent of their order
template<class Labels>
static point orderlessAverage(const pointField& points, const Labels& labels)
{
    point average;
    DynamicList<scalar> terms(labels.size());
    for (direction component = 0; component < point::nComponents; ++component)
    {
        terms.clear();
        for (const label pointi : labels)
        {
            terms.append(points[pointi][component]);
        }
        std::sort(terms.begin(), terms.end());
        scalar sum = 0;
        for (const scalar term : terms)
        {
            sum += term;
        }
        average[component] = sum/labels.size();
    }
    return average;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::movingCells::movingCells
(
    const polyMesh& mesh,
    const pointField& before,
    const pointField& after
)
:
    mesh_(mesh),
    before_(before),
    after_(after),
    faceBefore_(mesh.nFaces()),
    faceAfter_(mesh.nFaces())
{
    forAll(mesh.faces(), facei)
    {
        faceBefore_[facei] = orderlessAverage(before, mesh.faces()[facei]);
        faceAfter_[facei] = orderlessAverage(after, mesh.faces()[facei]);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::movingCells::appendVolumes
(
    const label celli,
    const label facei,
    const point& centreBefore,
    const point& centreAfter
) const
{
    const face& f = mesh_.faces()[facei];
    const bool owns = mesh_.faceOwner()[facei] == celli;
    const point& x = faceBefore_[facei];
    const point& y = faceAfter_[facei];

    forAll(f, i)
    {
        label a = f[i];
        label b = f.nextLabel(i);
        if (!owns)
        {
            Swap(a, b);
        }
        volumes_.append
        (
            morph::movingVolume
            (
                toEigen(before_[a] - x),
                toEigen(before_[b] - x),
                toEigen(x - centreBefore),
                toEigen(after_[a] - y),
                toEigen(after_[b] - y),
                toEigen(y - centreAfter)
            )
        );
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::movingCells::positiveUpTo(const label celli) const
{
    const point centreBefore(average(mesh_, celli, before_));
    const point centreAfter(average(mesh_, celli, after_));

    volumes_.clear();
    for (const label facei : mesh_.cells()[celli])
    {
        appendVolumes(celli, facei, centreBefore, centreAfter);
    }

    scalar largest = 0;
    for (const morph::Cubic& volume : volumes_)
    {
        largest = max(largest, volume[0]);
    }

    scalar fraction = morph::noRoot;
    for (const morph::Cubic& volume : volumes_)
    {
        // Skip what is beyond the first root so far by more than round-off, so
        // that the result does not depend on the order of the tetrahedra
        const bool later =
            fraction <= 1
         && morph::surelyPositive(volume, (1 + clearance)*fraction);

        if (!later && !(volume[0] <= flat*largest))
        {
            fraction = min(fraction, morph::positiveUpTo(volume));
        }
    }
    return fraction;
}


Foam::point Foam::movingCells::average
(
    const polyMesh& mesh,
    const label celli,
    const pointField& points
)
{
    return orderlessAverage(points, mesh.cells()[celli].labels(mesh.faces()));
}


// ************************************************************************* //
