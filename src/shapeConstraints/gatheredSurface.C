/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "gatheredSurface.H"
#include "foamCompat.H"
#include "ListListOps.H"
#include "ListOps.H"
#include "Map.H"
#include "Pstream.H"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

template<class Type>
static List<Type> gathered(const List<Type>& mine)
{
    List<List<Type>> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = mine;
    Pstream::gatherList(all);
    return ListListOps::combine<List<Type>>(all, accessOp<List<Type>>());
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::gatheredSurface::gatheredSurface
(
    const pointField& points,
    const faceList& faces
)
:
    nPoints_(0)
{
    Map<label> local(4*faces.size());
    DynamicList<label> used;
    DynamicList<label> corners;
    for (const face& f : faces)
    {
        for (const label pointi : f)
        {
            if (local.insert(pointi, used.size()))
            {
                used.append(pointi);
            }
        }
        for (label i = 1; i < f.size() - 1; ++i)
        {
            corners.append(local[f[0]]);
            corners.append(local[f[i]]);
            corners.append(local[f[i + 1]]);
        }
    }
    used_.transfer(used);

    // From here on numbers of all ranks' points together
    labelList sizes(Pstream::nProcs(), Zero);
    sizes[Pstream::myProcNo()] = used_.size();
    foamCompat::allGatherList(sizes);
    label offset = 0;
    for (label proc = 0; proc < Pstream::myProcNo(); ++proc)
    {
        offset += sizes[proc];
    }
    for (label& corner : corners)
    {
        corner += offset;
    }
    const List<vector> all(gathered(List<vector>(points, used_)));
    const labelList allCorners(gathered(labelList(corners)));
    if (!Pstream::master())
    {
        return;
    }

    labelList order(identity(all.size()));
    std::sort
    (
        order.begin(), order.end(),
        [&](const label a, const label b) { return before(all[a], all[b]); }
    );
    place_.setSize(all.size());
    forAll(order, i)
    {
        if (i == 0 || before(all[order[i - 1]], all[order[i]]))
        {
            ++nPoints_;
        }
        place_[order[i]] = nPoints_ - 1;
    }
    points_.resize(nPoints_, 3);
    forAll(all, i)
    {
        points_.row(place_[i]) = toEigen(all[i]).transpose();
    }

    // Each from its lowest corner on, which keeps its direction
    std::vector<std::array<label, 3>> triangles;
    for (label i = 0; i + 2 < allCorners.size(); i += 3)
    {
        std::array<label, 3> t
        {{
            place_[allCorners[i]],
            place_[allCorners[i + 1]],
            place_[allCorners[i + 2]]
        }};
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        triangles.push_back(t);
    }
    std::sort(triangles.begin(), triangles.end());
    triangles_.resize(Eigen::Index(triangles.size()), 3);
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
        triangles_.row(Eigen::Index(i)) <<
            triangles[i][0], triangles[i][1], triangles[i][2];
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

morph::Vectors Foam::gatheredSurface::gather(const vectorField& values) const
{
    const List<vector> all(gathered(List<vector>(values, used_)));
    morph::Vectors result(nPoints_, 3);
    if (Pstream::master())
    {
        forAll(all, i)
        {
            result.row(place_[i]) = toEigen(all[i]).transpose();
        }
    }
    return result;
}


bool Foam::gatheredSurface::closed() const
{
    // By the sum of area vectors, which is zero where they enclose something
    bool result = false;
    if (Pstream::master())
    {
        morph::Vector3 sum(morph::Vector3::Zero());
        scalar size = 0;
        for (Eigen::Index t = 0; t < triangles_.rows(); ++t)
        {
            const morph::Vector3 a = points_.row(triangles_(t, 0)).transpose();
            const morph::Vector3 b = points_.row(triangles_(t, 1)).transpose();
            const morph::Vector3 c = points_.row(triangles_(t, 2)).transpose();
            const morph::Vector3 area = 0.5*(b - a).cross(c - a);
            sum += area;
            size += area.norm();
        }
        result = size > 0 && sum.norm() < 1e-8*size;
    }
    foamCompat::broadcast(result);
    return result;
}


// ************************************************************************* //
