/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellGeometry.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellGeometry::cellGeometry
(
    const polyMesh& mesh,
    const pointField& points
)
:
    cells_(mesh.cells()),
    faces_(mesh.faces()),
    owner_(mesh.faceOwner()),
    points_(points),
    centre_(Zero),
    volume_(0),
    smallestPyramid_(0),
    farthest_(0),
    size_(0)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::cellGeometry::calculate(const face& f, point& centre, vector& area)
{
    const pointField& x = points_;
    if (f.size() == 3)
    {
        centre = (1.0/3.0)*(x[f[0]] + x[f[1]] + x[f[2]]);
        area = 0.5*((x[f[1]] - x[f[0]])^(x[f[2]] - x[f[0]]));
        return;
    }
    point middle(x[f[0]]);
    for (label i = 1; i < f.size(); ++i)
    {
        middle += x[f[i]];
    }
    middle /= f.size();

    vector sum(Zero);
    vector moment(Zero);
    scalar weight = 0;
    forAll(f, i)
    {
        const point& here = x[f[i]];
        const point& next = x[f.nextLabel(i)];
        const vector n((next - here)^(middle - here));
        const scalar a = mag(n);
        sum += n;
        weight += a;
        moment += a*(here + next + middle);
    }
    const bool none = weight < ROOTVSMALL;
    centre = none ? middle : point((1.0/3.0)*moment/weight);
    area = none ? vector(Zero) : vector(0.5*sum);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::cellGeometry::set(const label celli)
{
    const cell& c = cells_[celli];
    centres_.setSize(c.size());
    areas_.setSize(c.size());
    const point& origin = points_[faces_[c[0]][0]];
    point estimate(Zero);
    farthest_ = 0;
    size_ = 0;
    forAll(c, i)
    {
        const face& f = faces_[c[i]];
        calculate(f, centres_[i], areas_[i]);
        if (owner_[c[i]] != celli)
        {
            areas_[i] = -areas_[i];
        }
        estimate += centres_[i];
        for (const label pointi : f)
        {
            const point& x = points_[pointi];
            farthest_ = max(farthest_, cmptMax(cmptMag(x)));
            size_ = max(size_, magSqr(x - origin));
        }
    }
    estimate /= c.size();

    centre_ = Zero;
    volume_ = 0;
    forAll(c, i)
    {
        const scalar pyramid = areas_[i] & (centres_[i] - estimate);
        centre_ += pyramid*((3.0/4.0)*centres_[i] + (1.0/4.0)*estimate);
        volume_ += pyramid;
    }
    centre_ = mag(volume_) > VSMALL ? point(centre_/volume_) : estimate;
    volume_ *= 1.0/3.0;

    smallestPyramid_ = GREAT;
    forAll(c, i)
    {
        const scalar pyramid = areas_[i] & (centres_[i] - centre_);
        if (!(pyramid >= smallestPyramid_))
        {
            smallestPyramid_ = pyramid;
        }
    }
}


// ************************************************************************* //
