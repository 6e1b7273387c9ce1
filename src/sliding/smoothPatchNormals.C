/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "smoothPatchNormals.H"
#include "cyclicPolyPatch.H"
#include "dictionaryChecks.H"
#include "StringStream.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static vector normalOf(const face& f, const pointField& x, const label k)
{
    // Edges without length are passed over: the corner is between those that
    // have one
    const label n = f.size();
    const point& here = x[f[k]];
    label next = 1;
    while (next < n && x[f[(k + next) % n]] == here)
    {
        ++next;
    }
    label former = 1;
    while (former < n && x[f[(k + n - former) % n]] == here)
    {
        ++former;
    }
    return surfaceNormals::cornerNormal
    (
        x[f[(k + next) % n]] - here,
        x[f[(k + n - former) % n]] - here,
        f.areaNormal(x)
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::smoothPatchNormals::smoothPatchNormals
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const planarReduction& plane,
    const smoothPatches& patches,
    const scalar featureAngle,
    const labelList& controlled,
    const boolList& onAxis
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    plane_(plane),
    smoothPatches_(patches),
    featureAngle_(featureAngle),
    controlled_(controlled),
    onAxis_(onAxis)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::List<Foam::List<Foam::surfaceNormals::taggedNormal>>
Foam::smoothPatchNormals::ofFaces() const
{
    Map<label> place(2*controlled_.size());
    forAll(controlled_, i)
    {
        place.insert(controlled_[i], i);
    }

    const gatheredFaces& faces = smoothPatches_.faces();

    const faceList& meshFaces = mesh_.faces();
    const labelList& mine = smoothPatches_.myFaces();
    labelList number(controlled_.size(), Zero);
    for (const label facei : mine)
    {
        for (const label pointi : meshFaces[facei])
        {
            const label p = place.lookup(pointi, -1);
            if (p >= 0)
            {
                ++number[p];
            }
        }
    }

    // One list per communication: cyclics rotate the normals
    List<List<vector>> around(controlled_.size());
    List<labelList> patchesAround(controlled_.size());
    forAll(number, p)
    {
        around[p].setSize(number[p]);
        patchesAround[p].setSize(number[p]);
    }
    number = Zero;
    forAll(mine, facei)
    {
        const label i = faces.mine()[facei];
        const face& f = faces.faces()[i];
        const label smoothPatchi = faces.smoothPatches()[i];
        const smoothPatches::smoothPatch& s = smoothPatches_[smoothPatchi];
        const pointField& x = smoothPatches_.vertices(s);
        for (const label pointi : meshFaces[mine[facei]])
        {
            const label p = place.lookup(pointi, -1);
            if (p < 0)
            {
                continue;
            }
            const label k = f.find(faces.vertices()[pointi]);
            const vector n =
                plane_.reduce(points0_[pointi], normalOf(f, x, k));
            const label j = number[p]++;
            around[p][j] = s.planar ? mag(n)*s.normal : n;
            patchesAround[p][j] = smoothPatchi;
        }
    }
    syncTools::syncPointList
    (
        mesh_,
        controlled_,
        around,
        ListOps::appendEqOp<vector>(),
        List<vector>(),
        mapDistribute::transform()
    );
    syncTools::syncPointList
    (
        mesh_,
        controlled_,
        patchesAround,
        ListOps::appendEqOp<label>(),
        labelList()
    );

    return distinct(around, patchesAround);
}


Foam::List<Foam::List<Foam::surfaceNormals::taggedNormal>>
Foam::smoothPatchNormals::distinct
(
    const List<List<vector>>& around,
    const List<labelList>& patchesAround
) const
{
    // A rotational cyclic leaves round-off that depends on the side
    bool turned = false;
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        const auto* cyclic = isA<cyclicPolyPatch>(patch);
        turned = turned || (cyclic && !cyclic->parallel());
    }
    turned = returnReduce(turned, orOp<bool>());

    OStringStream message;
    List<List<surfaceNormals::taggedNormal>> normals(controlled_.size());
    forAll(normals, i)
    {
        List<surfaceNormals::taggedNormal> all(around[i].size());
        forAll(all, j)
        {
            const vector& n = around[i][j];
            all[j] =
            {
                turned ? surfaceNormals::withoutLastBits(n) : n,
                patchesAround[i][j]
            };
        }
        normals[i] = surfaceNormals::distinct(all, featureAngle_);
        if (normals[i].empty() && all.size() && message.str().empty())
        {
            message
                << "None of the faces that slide at the point "
                << points0_[controlled_[i]] << " has an area" << nl
                << "    Repair the mesh there (checkMesh lists such faces), or"
                << " let other patches slide";
        }
        for (surfaceNormals::taggedNormal& n : normals[i])
        {
            n.normal = turned ? surfaceNormals::rounded(n.normal) : n.normal;
        }
        if (onAxis_[i])
        {
            normals[i].append({plane_.radial(), -1});
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
    return normals;
}


void Foam::smoothPatchNormals::takeNamed
(
    List<List<surfaceNormals::taggedNormal>>& present
) const
{
    OStringStream message;
    forAll(present, i)
    {
        List<surfaceNormals::taggedNormal>& normals = present[i];
        if (fixed(normals) || onAxis_[i])
        {
            continue;
        }
        const point& x = points0_[controlled_[i]];
        const bool folded =
            normals.size() == 2 && normals[0].surface == normals[1].surface;
        for (surfaceNormals::taggedNormal& n : normals)
        {
            const smoothPatches::smoothPatch& s = smoothPatches_[n.surface];
            if (!smoothPatches_.isNamed(s))
            {
                continue;
            }
            if (folded && !smoothPatches_.named(s).hasEdges() && message.str().empty())
            {
                message
                    << "Group '" << smoothPatches_.group(s).name() << "' has an edge at "
                    << x << " but the surface that '"
                    << smoothPatches_.group(s).namedSurface().keyword()
                    << "' names has none" << nl
                    << "    Give the two sides groups of their own, or name a"
                    << " file whose triangles have the edge";
            }
            const vector m =
                plane_.reduce(x, smoothPatches_.named(s).nearest(x).normal);
            if (!folded && mag(m) > 0.5)
            {
                n.normal = m/mag(m);
            }
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::List<Foam::surfaceNormals::taggedNormal>>
Foam::smoothPatchNormals::present() const
{
    List<List<surfaceNormals::taggedNormal>> normals(ofFaces());
    takeNamed(normals);
    return normals;
}


bool Foam::smoothPatchNormals::fixed
(
    const List<surfaceNormals::taggedNormal>& normals
) const
{
    // In a plane there are only two directions
    return normals.empty() || normals.size() >= (plane_.active() ? 2 : 3);
}


// ************************************************************************* //
