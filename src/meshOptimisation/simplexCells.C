/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "simplexCells.H"
#include "DynamicList.H"
#include "eigenFields.H"
#include "emptyPolyPatch.H"
#include "globalMeshData.H"
#include "PstreamBuffers.H"
#include "wedgePolyPatch.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Sends one list to every rank and returns what each of them sent
template<class T>
static List<List<T>> swapped(const List<DynamicList<T>>& lists)
{
    List<List<T>> got(Pstream::nProcs());
    PstreamBuffers buffers(Pstream::commsTypes::nonBlocking);
    forAll(lists, ranki)
    {
        if (ranki != Pstream::myProcNo() && lists[ranki].size())
        {
            UOPstream os(ranki, buffers);
            os << static_cast<const List<T>&>(lists[ranki]);
        }
    }
    labelList sizes;
    buffers.finishedSends(sizes);
    forAll(sizes, ranki)
    {
        if (ranki != Pstream::myProcNo() && sizes[ranki] > 0)
        {
            UIPstream is(ranki, buffers);
            is >> got[ranki];
        }
    }
    return got;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::simplexCells::simplexCells
(
    const polyMesh& mesh,
    const pointField& reference,
    const planarReduction& plane,
    const morph::SimplexTarget target
)
:
    mesh_(mesh),
    plane_(plane),
    e1_(Zero),
    e2_(Zero),
    global_(identity(mesh.nPoints())),
    nOwned_(0)
{
    findAxes();
    number();

    const labelList sides(lowerSides());
    List<morph::Vector3> positions(mesh.nPoints());
    forAll(positions, pointi)
    {
        positions[pointi] = toCore(plane_.position(reference[pointi]));
    }
    std::vector<cellFaces> others;
    Map<vector> where;
    exchangeCells(sides, positions, others, where);

    // Also points of other ranks that are none of this mesh
    const label nLocal = points_.size();
    DynamicList<label> ghosts;
    for (label i = nOwned_; i < nLocal; ++i)
    {
        ghosts.append(global_[points_[i]]);
    }
    const labelList foreign(where.sortedToc());
    ghosts.append(foreign);
    morph::Vectors x(nOwned_ + ghosts.size(), 3);
    for (label i = 0; i < nLocal; ++i)
    {
        x.row(i) = positions[points_[i]].transpose();
    }
    forAll(foreign, i)
    {
        x.row(nLocal + i) = toEigen(where[foreign[i]]).transpose();
    }

    // By global number
    Map<label> places(2*ghosts.size());
    forAll(ghosts, i)
    {
        places.insert(ghosts[i], nOwned_ + i);
    }
    labelList owned(numbers_->localSize(), -1);
    for (label i = 0; i < nOwned_; ++i)
    {
        owned[numbers_->toLocal(global_[points_[i]])] = i;
    }

    simplices_.reset
    (
        new morph::SimplexMesh(dimension(), nOwned_, x, target)
    );
    cells_.setSize(mesh.nCells(), -1);
    forAll(cells_, celli)
    {
        cellFaces faces(facesOf(celli, sides));
        if (faces.size())
        {
            for (std::vector<int>& f : faces)
            {
                for (int& p : f)
                {
                    p = place_[p];
                }
            }
            cells_[celli] = label(simplices_->nCells());
            simplices_->add(faces, true);
        }
    }
    for (cellFaces& faces : others)
    {
        for (std::vector<int>& f : faces)
        {
            for (int& p : f)
            {
                p =
                    numbers_->isLocal(p)
                  ? owned[numbers_->toLocal(p)]
                  : places[p];
            }
        }
        simplices_->add(faces, false);
    }
    simplices_->finish();
    schedule(ghosts, owned);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::simplexCells::findAxes()
{
    if (!plane_.active())
    {
        return;
    }
    // The coordinate axis that is most in the plane
    const vector& n = plane_.normal();
    direction least = 0;
    for (direction d = 1; d < vector::nComponents; ++d)
    {
        least = mag(n[d]) < mag(n[least]) ? d : least;
    }
    vector e(Zero);
    e[least] = 1;
    e1_ = normalised(e - (e & n)*n);
    e2_ = n ^ e1_;
}


void Foam::simplexCells::number()
{
    labelList unique;
    numbers_ = mesh_.globalData().mergePoints(global_, unique);

    place_.setSize(mesh_.nPoints(), -1);
    DynamicList<label> points(mesh_.nPoints());
    const labelList& represents = plane_.representative();
    for (const bool own : {true, false})
    {
        forAll(represents, pointi)
        {
            if
            (
                represents[pointi] == pointi
             && numbers_->isLocal(global_[pointi]) == own
            )
            {
                place_[pointi] = points.size();
                points.append(pointi);
            }
        }
        nOwned_ = own ? points.size() : nOwned_;
    }
    points_.transfer(points);
}


Foam::labelList Foam::simplexCells::lowerSides() const
{
    labelList side(plane_.active() ? mesh_.nCells() : 0, -1);
    if (!plane_.active())
    {
        return side;
    }
    const labelList& represents = plane_.representative();
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (!isA<emptyPolyPatch>(patch) && !isA<wedgePolyPatch>(patch))
        {
            continue;
        }
        forAll(patch, i)
        {
            bool lower = true;
            for (const label pointi : patch[i])
            {
                lower = lower && represents[pointi] == pointi;
            }
            if (lower)
            {
                side[patch.faceCells()[i]] = patch.start() + i;
            }
        }
    }
    return side;
}


Foam::simplexCells::cellFaces Foam::simplexCells::facesOf
(
    const label celli,
    const labelList& sideOf
) const
{
    cellFaces faces;
    if (plane_.active())
    {
        if (sideOf[celli] >= 0)
        {
            // Outwards is against the normal of the plane
            const face f(mesh_.faces()[sideOf[celli]].reverseFace());
            faces.emplace_back(f.begin(), f.end());
        }
        return faces;
    }
    for (const label facei : mesh_.cells()[celli])
    {
        const face f
        (
            mesh_.faceOwner()[facei] == celli
          ? mesh_.faces()[facei]
          : mesh_.faces()[facei].reverseFace()
        );
        faces.emplace_back(f.begin(), f.end());
    }
    return faces;
}


void Foam::simplexCells::exchangeCells
(
    const labelList& sideOf,
    const UList<morph::Vector3>& positions,
    std::vector<cellFaces>& others,
    Map<vector>& where
) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    // Cells as the number of faces and, of each, the number of points and those
    const label nRanks = Pstream::nProcs();
    List<DynamicList<label>> cells(nRanks);
    List<DynamicList<label>> points(nRanks);
    List<DynamicList<vector>> at(nRanks);
    List<labelHashSet> told(nRanks);
    forAll(mesh_.cells(), celli)
    {
        const cellFaces faces(facesOf(celli, sideOf));
        labelHashSet ranks;
        for (const std::vector<int>& f : faces)
        {
            for (const int p : f)
            {
                ranks.insert(numbers_->whichProcID(global_[p]));
            }
        }
        ranks.erase(Pstream::myProcNo());
        for (const label ranki : ranks)
        {
            DynamicList<label>& to = cells[ranki];
            to.append(label(faces.size()));
            for (const std::vector<int>& f : faces)
            {
                to.append(label(f.size()));
                for (const int p : f)
                {
                    to.append(global_[p]);
                    if (told[ranki].insert(global_[p]))
                    {
                        points[ranki].append(global_[p]);
                        at[ranki].append(toFoam(positions[p]));
                    }
                }
            }
        }
    }

    const List<labelList> gotCells(swapped(cells));
    const List<labelList> gotPoints(swapped(points));
    const List<List<vector>> gotAt(swapped(at));
    labelHashSet known(2*points_.size());
    for (const label pointi : points_)
    {
        known.insert(global_[pointi]);
    }
    forAll(gotCells, ranki)
    {
        forAll(gotPoints[ranki], i)
        {
            const label p = gotPoints[ranki][i];
            if (!known.found(p))
            {
                where.insert(p, gotAt[ranki][i]);
            }
        }
        const labelList& from = gotCells[ranki];
        for (label i = 0; i < from.size();)
        {
            cellFaces faces(from[i++]);
            for (std::vector<int>& f : faces)
            {
                const label n = from[i++];
                f.assign(from.begin() + i, from.begin() + i + n);
                i += n;
            }
            others.push_back(faces);
        }
    }
}


void Foam::simplexCells::schedule
(
    const UList<label>& ghosts,
    const labelList& owned
)
{
    List<DynamicList<label>> asked(Pstream::nProcs());
    List<DynamicList<label>> received(Pstream::nProcs());
    forAll(ghosts, i)
    {
        const label ranki = numbers_->whichProcID(ghosts[i]);
        asked[ranki].append(ghosts[i]);
        received[ranki].append(nOwned_ + i);
    }
    received_.setSize(Pstream::nProcs());
    forAll(received, ranki)
    {
        received_[ranki].transfer(received[ranki]);
    }
    sent_ = swapped(asked);
    for (labelList& list : sent_)
    {
        for (label& p : list)
        {
            p = owned[numbers_->toLocal(p)];
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

morph::Vector3 Foam::simplexCells::toCore(const vector& v) const
{
    return
        plane_.active()
      ? morph::Vector3(v & e1_, v & e2_, 0)
      : toEigen(v);
}


Foam::vector Foam::simplexCells::fromCore
(
    const morph::Vectors& v,
    const label i
) const
{
    return
        plane_.active()
      ? v(i, 0)*e1_ + v(i, 1)*e2_
      : vector(v(i, 0), v(i, 1), v(i, 2));
}


morph::Vectors Foam::simplexCells::positions(const pointField& points) const
{
    morph::Vectors x(simplices_->nPoints(), 3);
    forAll(points_, i)
    {
        x.row(i) = toCore(points[points_[i]]).transpose();
    }
    exchange(x);
    return x;
}


void Foam::simplexCells::exchange(morph::Vectors& v) const
{
    if (!Pstream::parRun())
    {
        return;
    }
    List<DynamicList<vector>> values(Pstream::nProcs());
    forAll(sent_, ranki)
    {
        values[ranki].reserve(sent_[ranki].size());
        for (const label i : sent_[ranki])
        {
            values[ranki].append(vector(v(i, 0), v(i, 1), v(i, 2)));
        }
    }
    const List<List<vector>> got(swapped(values));
    forAll(got, ranki)
    {
        forAll(got[ranki], j)
        {
            v.row(received_[ranki][j]) = toEigen(got[ranki][j]).transpose();
        }
    }
}


std::vector<bool> Foam::simplexCells::exchanged
(
    const boolList& ofMeshPoints
) const
{
    morph::Vectors flags(morph::Vectors::Zero(simplices_->nPoints(), 3));
    forAll(points_, i)
    {
        flags(i, 0) = ofMeshPoints[points_[i]];
    }
    exchange(flags);
    std::vector<bool> all(simplices_->nPoints());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        all[i] = flags(i, 0) > 0.5;
    }
    return all;
}


// ************************************************************************* //
