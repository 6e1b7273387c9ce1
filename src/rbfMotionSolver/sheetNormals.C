/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

\*---------------------------------------------------------------------------*/

#include "sheetNormals.H"
#include "cyclicPolyPatch.H"
#include "dictionaryChecks.H"
#include "StringStream.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static vector normalOf(const face& f, const pointField& x, const label k)
{
    const label n = f.size();
    const point& here = x[f[k]];
    return surfaceNormals::cornerNormal
    (
        x[f[(k + 1) % n]] - here, x[f[(k + n - 1) % n]] - here, f.areaNormal(x)
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sheetNormals::sheetNormals
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const planarReduction& plane,
    const slidingSheets& sheets,
    const scalar featureAngle,
    const labelList& controlled,
    const boolList& onAxis
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    plane_(plane),
    sheets_(sheets),
    featureAngle_(featureAngle),
    controlled_(controlled),
    onAxis_(onAxis)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::List<Foam::List<Foam::surfaceNormals::ofSurface>>
Foam::sheetNormals::ofFaces() const
{
    Map<label> place(2*controlled_.size());
    forAll(controlled_, i)
    {
        place.insert(controlled_[i], i);
    }

    const gatheredFaces& faces = sheets_.faces();

    // Two lists for one communication each: normals are turned at cyclics
    List<List<vector>> around(controlled_.size());
    List<labelList> sheetsAround(controlled_.size());
    forAll(sheets_.myFaces(), facei)
    {
        const label i = faces.mine()[facei];
        const face& f = faces.faces()[i];
        const label sheeti = faces.sheets()[i];
        const slidingSheets::sheet& s = sheets_[sheeti];
        const pointField& x = sheets_.vertices(s);
        for (const label pointi : mesh_.faces()[sheets_.myFaces()[facei]])
        {
            const auto found = place.cfind(pointi);
            if (!found.found())
            {
                continue;
            }
            const label k = f.find(faces.vertices()[pointi]);
            const vector n =
                plane_.reduce(points0_[pointi], normalOf(f, x, k));
            around[found.val()].append
            (
                s.planar ? mag(n)*s.normal : n
            );
            sheetsAround[found.val()].append(sheeti);
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
        sheetsAround,
        ListOps::appendEqOp<label>(),
        labelList()
    );

    return distinct(around, sheetsAround);
}


Foam::List<Foam::List<Foam::surfaceNormals::ofSurface>>
Foam::sheetNormals::distinct
(
    const List<List<vector>>& around,
    const List<labelList>& sheetsAround
) const
{
    // A rotational cyclic leaves round-off that depends on who asks
    bool turned = false;
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        const auto* cyclic = isA<cyclicPolyPatch>(patch);
        turned = turned || (cyclic && !cyclic->parallel());
    }
    turned = returnReduce(turned, orOp<bool>());

    List<List<surfaceNormals::ofSurface>> normals(controlled_.size());
    forAll(normals, i)
    {
        List<surfaceNormals::ofSurface> all(around[i].size());
        forAll(all, j)
        {
            const vector& n = around[i][j];
            all[j] =
            {
                turned ? surfaceNormals::withoutLastBits(n) : n,
                sheetsAround[i][j]
            };
        }
        normals[i] = surfaceNormals::distinct(all, featureAngle_);
        for (surfaceNormals::ofSurface& n : normals[i])
        {
            n.normal = turned ? surfaceNormals::rounded(n.normal) : n.normal;
        }
        if (onAxis_[i])
        {
            normals[i].append({plane_.radial(), -1});
        }
    }
    return normals;
}


void Foam::sheetNormals::takeNamed
(
    List<List<surfaceNormals::ofSurface>>& present
) const
{
    OStringStream message;
    forAll(present, i)
    {
        List<surfaceNormals::ofSurface>& normals = present[i];
        if (fixed(normals) || onAxis_[i])
        {
            continue;
        }
        const point& x = points0_[controlled_[i]];
        const bool folded =
            normals.size() == 2 && normals[0].surface == normals[1].surface;
        for (surfaceNormals::ofSurface& n : normals)
        {
            const slidingSheets::sheet& s = sheets_[n.surface];
            if (!sheets_.isNamed(s))
            {
                continue;
            }
            if (folded && !sheets_.named(s).hasEdges() && message.str().empty())
            {
                message
                    << "Group '" << sheets_.group(s).name() << "' has an edge at "
                    << x << " but the surface that '"
                    << sheets_.group(s).namedSurface().keyword()
                    << "' names has none" << nl
                    << "    Give the two sides groups of their own, or name a"
                    << " file whose triangles have the edge";
            }
            const vector m =
                plane_.reduce(x, sheets_.named(s).nearest(x).normal);
            if (!folded && mag(m) > 0.5)
            {
                n.normal = m/mag(m);
            }
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::List<Foam::List<Foam::surfaceNormals::ofSurface>>
Foam::sheetNormals::present() const
{
    List<List<surfaceNormals::ofSurface>> normals(ofFaces());
    takeNamed(normals);
    return normals;
}


bool Foam::sheetNormals::fixed
(
    const List<surfaceNormals::ofSurface>& normals
) const
{
    // In a plane two directions are all there are
    return normals.empty() || normals.size() >= (plane_.active() ? 2 : 3);
}


// ************************************************************************* //
