/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "conservativeMapping.H"
#include "eigenFields.H"
#include "ListOps.H"
#include "tetrahedronOverlap.hpp"

#include <Eigen/Eigenvalues>

// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

namespace Foam
{

namespace
{

//- Cells of tetrahedra, in ascending order
labelList cellsOf(const remeshMap::tetrahedra& all)
{
    labelHashSet cells(all.cells);
    return cells.sortedToc();
}


std::array<morph::Vector3, 4> cornersOf
(
    const remeshMap::tetrahedra& all,
    const label teti
)
{
    std::array<morph::Vector3, 4> corners;
    for (label i = 0; i < 4; ++i)
    {
        corners[i] = toEigen(all.points[all.tets[teti][i]]);
    }
    return corners;
}


//- In ascending order of the places of their cells in the list
morph::CellTetrahedra inOrder
(
    const remeshMap::tetrahedra& all,
    const labelUList& cells
)
{
    Map<label> place(2*cells.size());
    forAll(cells, i)
    {
        place.insert(cells[i], i);
    }
    labelList places(all.cells.size());
    forAll(places, teti)
    {
        places[teti] = place[all.cells[teti]];
    }
    labelList order;
    sortedOrder(places, order);

    morph::CellTetrahedra result;
    result.nCells = cells.size();
    for (const label teti : order)
    {
        result.corners.push_back(cornersOf(all, teti));
        result.cell.push_back(places[teti]);
    }
    return result;
}


} // End anonymous namespace

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::conservativeMapping::findNeighbours()
{
    const labelListList& cellPoints = mesh_.cellPoints();
    const labelListList& pointCells = mesh_.pointCells();

    // Cells that share a point, numbered as they are met
    Map<label> row(4*donors_.size());
    DynamicList<label> cells(donors_);
    forAll(donors_, i)
    {
        row.insert(donors_[i], i);
    }
    neighbours_.setSize(donors_.size());
    forAll(donors_, i)
    {
        labelHashSet found;
        for (const label pointi : cellPoints[donors_[i]])
        {
            for (const label celli : pointCells[pointi])
            {
                if (celli != donors_[i] && found.insert(celli))
                {
                    if (row.insert(celli, cells.size()))
                    {
                        cells.append(celli);
                    }
                }
            }
        }
        labelList all(found.sortedToc());
        for (label& celli : all)
        {
            celli = row[celli];
        }
        neighbours_[i].transfer(all);
    }
    cells_.transfer(cells);

    // What is beyond their faces on patches
    boolList hasValue(mesh_.nFaces(), true);
    DynamicList<label> coupledFaces, patchFaces, patches;
    DynamicList<point> coupledPositions, patchPositions;
    coupledNeighbours_.setSize(donors_.size());
    patchNeighbours_.setSize(donors_.size());
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        if (patch.size() < patch.patch().size())
        {
            // Empty ones have no values
            for (label i = 0; i < patch.patch().size(); ++i)
            {
                hasValue[patch.start() + i] = false;
            }
            continue;
        }
        const labelUList& faceCells = patch.faceCells();
        const vectorField delta(patch.delta());
        forAll(faceCells, i)
        {
            const label donori = row.lookup(faceCells[i], -1);
            if (donori < 0 || donori >= donors_.size())
            {
                continue;
            }
            const label facei = patch.start() + i;
            if (patch.coupled())
            {
                coupledNeighbours_[donori].append(coupledFaces.size());
                coupledFaces.append(facei);
                coupledPositions.append(mesh_.C()[faceCells[i]] + delta[i]);
            }
            else
            {
                patchNeighbours_[donori].append(patchFaces.size());
                patchFaces.append(facei);
                patches.append(patchi);
                patchPositions.append(mesh_.faceCentres()[facei]);
            }
        }
    }
    for (labelList& rows : coupledNeighbours_)
    {
        for (label& row : rows)
        {
            row += cells_.size();
        }
    }
    for (labelList& rows : patchNeighbours_)
    {
        for (label& row : rows)
        {
            row += cells_.size() + coupledFaces.size();
        }
    }
    coupledFaces_.transfer(coupledFaces);
    patchFaces_.transfer(patchFaces);
    patches_.transfer(patches);

    pointField positions(mesh_.C().primitiveField(), cells_);
    positions.append(coupledPositions);
    positions.append(patchPositions);
    positions_ = asVectors(positions);

    faces_.setSize(cells_.size());
    forAll(cells_, i)
    {
        for (const label facei : mesh_.cells()[cells_[i]])
        {
            if (hasValue[facei] && magSqr(areas_[facei]) > 0)
            {
                faces_[i].append(facei);
            }
        }
    }
    cellPoints_ = labelListList(cellPoints, donors_);
}


const morph::CellSlopes* Foam::conservativeMapping::slopes
(
    const bool coupled,
    const boolList& fixed
)
{
    std::string key(1, coupled ? '1' : '0');
    for (const bool is : fixed)
    {
        key += is ? '1' : '0';
    }
    std::unique_ptr<morph::CellSlopes>& result = slopes_[key];
    if (result)
    {
        return result.get();
    }

    const label firstPatchRow = cells_.size() + coupledFaces_.size();
    std::vector<morph::Index> start(1, 0);
    std::vector<int> all;
    forAll(donors_, i)
    {
        all.insert(all.end(), neighbours_[i].begin(), neighbours_[i].end());
        if (coupled)
        {
            all.insert
            (
                all.end(),
                coupledNeighbours_[i].begin(),
                coupledNeighbours_[i].end()
            );
        }
        for (const label row : patchNeighbours_[i])
        {
            const label patchi = patches_[row - firstPatchRow];
            if (patchi < fixed.size() && fixed[patchi])
            {
                all.push_back(row);
            }
        }
        start.push_back(all.size());
    }
    result.reset(new morph::CellSlopes(positions_, start, all));
    return result.get();
}


const morph::CellSlopes* Foam::conservativeMapping::slopesOfCells()
{
    return slopes(false, boolList());
}


morph::Matrix Foam::conservativeMapping::mapped
(
    const morph::Matrix& values,
    const morph::CellSlopes& slopes,
    const bool bounded
) const
{
    morph::Matrix result(targets_.size(), values.cols());
    for (Eigen::Index k = 0; k < values.cols(); ++k)
    {
        morph::ValueBounds bounds;
        if (bounded)
        {
            // What round-off or a solver leaves beyond a bound counts as one
            const scalar least = values.col(k).minCoeff();
            const scalar most = values.col(k).maxCoeff();
            const scalar little = 1e-3*(most - least);
            if (least >= -little)
            {
                bounds.least = min(least, scalar(0));
                if (most <= 1 + little)
                {
                    bounds.most = max(most, scalar(1));
                }
            }
        }
        result.col(k) = byOverlap_->map(slopes, values.col(k), bounds);
    }
    return result;
}


morph::Matrix Foam::conservativeMapping::means
(
    const morph::Matrix& ofFaces
) const
{
    morph::Matrix result(positions_.rows(), ofFaces.cols());
    result.setZero();
    forAll(cells_, i)
    {
        for (const label facei : faces_[i])
        {
            result.row(i) += ofFaces.row(facei)/faces_[i].size();
        }
    }
    return result;
}


morph::Matrix Foam::conservativeMapping::velocities
(
    const morph::Matrix& fluxes
) const
{
    // min sum (u . S - phi)^2/|S|; directions of empty patches stay zero
    morph::Matrix result(positions_.rows(), 3);
    result.setZero();
    forAll(cells_, i)
    {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        morph::Vector3 right = morph::Vector3::Zero();
        for (const label facei : faces_[i])
        {
            const morph::Vector3 area = toEigen(areas_[facei]);
            sum += area*area.transpose()/area.norm();
            right += area*fluxes(facei, 0)/area.norm();
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
        morph::Vector3 parts = solver.eigenvectors().transpose()*right;
        for (label k = 0; k < 3; ++k)
        {
            const scalar lambda = solver.eigenvalues()[k];
            parts[k] =
                lambda > 1e-10*solver.eigenvalues()[2] ? parts[k]/lambda : 0;
        }
        result.row(i) = solver.eigenvectors()*parts;
    }
    return result;
}


Eigen::RowVectorXd Foam::conservativeMapping::between
(
    const label facei,
    const morph::Matrix& ofTargets
) const
{
    const label own = target_[mesh_.faceOwner()[facei]];
    const label nei = target_[mesh_.faceNeighbour()[facei]];
    if (own < 0 || nei < 0)
    {
        FatalErrorInFunction
            << "Face " << facei << " is new, but one of its cells is not" << nl
            << "    This is a fault of morphFoam: please report it" << nl
            << exit(FatalError);
    }
    const scalar w = mesh_.weights().primitiveField()[facei];
    return w*ofTargets.row(own) + (1 - w)*ofTargets.row(nei);
}


Foam::label Foam::conservativeMapping::donorAround(const point& p) const
{
    morph::Box box = morph::Box::empty();
    box.extend(toEigen(p));
    label best = -1;
    scalar deepest = -GREAT;
    tree_->forAllTouching
    (
        box,
        [&](const int teti)
        {
            const morph::Tetrahedron tet(tetrahedra_.corners[teti]);
            if (tet.sign() == 0)
            {
                return;
            }
            scalar depth = GREAT;
            for (label face = 0; face < 4; ++face)
            {
                depth = min
                (
                    depth,
                    tet.inside(face, toEigen(p))
                   /tet.inside(face, tet.corner(face))
                );
            }
            if (depth > deepest)
            {
                deepest = depth;
                best = tetrahedra_.cell[teti];
            }
        }
    );
    return best;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::conservativeMapping::conservativeMapping
(
    fvMesh& mesh,
    const remeshMap& map
)
:
    mesh_(mesh),
    map_(map),
    donors_(cellsOf(map.before)),
    tetrahedra_(inOrder(map.before, donors_)),
    volumes_(mesh.cellVolumes(), donors_),
    areas_(mesh.faceAreas()),
    points_(mesh.points()),
    nOldInternalFaces_(mesh.nInternalFaces()),
    boundaryFaces_
    (
        SubList<face>
        (
            mesh.faces(),
            mesh.nFaces() - mesh.nInternalFaces(),
            mesh.nInternalFaces()
        )
    )
{
    std::vector<morph::Box> boxes;
    for (const auto& corners : tetrahedra_.corners)
    {
        morph::Box box = morph::Box::empty();
        for (const morph::Vector3& corner : corners)
        {
            box.extend(corner);
        }
        boxes.push_back(box);
    }
    tree_.reset(new morph::BoxTree(std::move(boxes)));

    findNeighbours();
    keepAll();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::conservativeMapping::map()
{
    targets_ = cellsOf(map_.after);
    target_.setSize(mesh_.nCells());
    target_ = -1;
    forAll(targets_, i)
    {
        target_[targets_[i]] = i;
    }
    byOverlap_.reset
    (
        new morph::ConservativeMap
        (
            morph::OverlapTable(tetrahedra_, inOrder(map_.after, targets_))
        )
    );
    giveAll();
}


Foam::scalar Foam::conservativeMapping::mismatch() const
{
    const morph::OverlapTable& table = byOverlap_->table();
    const auto ofDonors = table.donorSums();
    const auto ofTargets = table.targetSums();
    scalar worst = 0;
    forAll(donors_, i)
    {
        worst = max(worst, mag(ofDonors.volume[i]/volumes_[i] - 1));
    }
    forAll(targets_, i)
    {
        worst = max
        (
            worst,
            mag(ofTargets.volume[i]/mesh_.cellVolumes()[targets_[i]] - 1)
        );
    }
    return returnReduce(worst, maxOp<scalar>());
}


// ************************************************************************* //
