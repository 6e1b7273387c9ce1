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

#include "slidingPoints.H"
#include "cyclicPolyPatch.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "StringStream.H"
#include "syncTools.H"
#include "triangulatedSurface.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A sheet is planar where no face is tilted by more than this [rad]: meshes
// written with six digits have not quite flat planes
static const scalar planarAngle = 1e-3;

// Directions of conditions are kept while the cosine of the angle to the
// surface's normal is larger
static const scalar keptCosine = 0.9;

// A point may be this far from a surface that it is on, in the size of its
// faces, and this far from one it is to slide onto, in the span of its group
static const scalar onSurface = 0.5;
static const scalar nearTarget = 0.5;

// Steps of the last projection onto surfaces, which takes about three
static const label mostSteps = 30;


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

Foam::slidingPoints::slidingPoints
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const planarReduction& plane,
    const scalar featureAngle,
    const labelList& controlled,
    const boolList& onAxis
)
:
    mesh_(mesh),
    dict_(dict),
    points0_(points0),
    groups_(groups),
    plane_(plane),
    featureAngle_(featureAngle),
    controlled_(controlled),
    onAxis_(onAxis),
    displaced_(groups.size()),
    moves_(groups.size()),
    named_(groups.size())
{
    forAll(groups_, groupi)
    {
        moves_[groupi] = groups_[groupi].slides() && groups_[groupi].moves();
    }
    gatherFaces();
    nameSurfaces();
    findVertices();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::slidingPoints::gatherFaces()
{
    // Sheets go on from one group to the next where both are at rest, and what
    // they are is left to the faces
    const label common = groups_.size();
    labelList families(identity(groups_.size()));
    DynamicList<label> faces, tags;
    DynamicList<bool> flips;
    forAll(groups_, groupi)
    {
        const controlPointGroup& group = groups_[groupi];
        typedef controlPointGroup::surfaceType type;
        const bool own =
            group.surface() == type::found || group.surface() == type::curved;
        if (own && !moves_[groupi] && magSqr(group.normal()) == 0)
        {
            families[groupi] = common;
        }
        if (group.slides())
        {
            boolList groupFlips;
            const labelList groupFaces(group.faces(groupFlips));
            faces.append(groupFaces);
            flips.append(groupFlips);
            tags.append(labelList(groupFaces.size(), groupi));
        }
    }
    myFaces_.transfer(faces);
    faces_.reset
    (
        new gatheredFaces
        (
            mesh_,
            points0_,
            myFaces_,
            boolList(flips),
            labelList(tags),
            families,
            featureAngle_
        )
    );

    sheets_.setSize(faces_->nSheets());
    forAll(faces_->faces(), i)
    {
        const label groupi = faces_->tags()[i];
        if (!sheets_.set(faces_->sheets()[i]))
        {
            const bool own = families[groupi] == common;
            sheets_.set
            (
                faces_->sheets()[i],
                new sheet{own ? -1 : groupi, false, Zero, nullptr}
            );
        }
    }
}


void Foam::slidingPoints::nameSurfaces()
{
    forAll(groups_, groupi)
    {
        const controlPointGroup& group = groups_[groupi];
        if (group.surface() == controlPointGroup::surfaceType::named)
        {
            named_.set
            (
                groupi,
                slidingSurface::New
                (
                    group.namedSurface(), group.dict(), mesh_, featureAngle_
                ).ptr()
            );
        }
    }
}


void Foam::slidingPoints::findVertices()
{
    labelList vertex(mesh_.nPoints(), -1);
    forAllConstIters(faces_->vertices(), iter)
    {
        vertex[iter.key()] = iter.val();
    }
    syncTools::syncPointList
    (
        mesh_, vertex, maxEqOp<label>(), label(-1)
    );
    vertex_ = UIndirectList<label>(vertex, controlled_);
}


void Foam::slidingPoints::findChains()
{
    // Chains that meet at a vertex end there: points at it slide along none
    Map<label> chainAt(2*faces_->edges().size());
    forAll(faces_->edges(), i)
    {
        for (const label end : {0, 1})
        {
            const label v = faces_->edges()[i][end];
            const label chaini = faces_->chains()[i];
            if (!chainAt.insert(v, chaini) && chainAt[v] != chaini)
            {
                chainAt[v] = -1;
            }
        }
    }

    chain_.setSize(controlled_.size());
    forAll(chain_, i)
    {
        chain_[i] = chainAt.lookup(vertex_[i], -1);
    }
}


const Foam::pointField& Foam::slidingPoints::vertices(const sheet& s) const
{
    return
        s.group >= 0 && displaced_[s.group].size()
      ? displaced_[s.group]
      : faces_->points();
}


bool Foam::slidingPoints::updateDisplaced()
{
    bool changed = false;
    forAll(groups_, groupi)
    {
        const controlPointGroup& group = groups_[groupi];
        if (!moves_[groupi])
        {
            continue;
        }
        const labelList members(group.meshPoints().sortedToc());
        const pointField positions(points0_, members);
        const labelList listed(members.size(), -1);
        const tmp<vectorField> td
        (
            group.displacement({positions, members, listed})
        );

        // Every rank needs all of them, whichever has them
        List<labelList> allVertices(Pstream::nProcs());
        List<pointField> allPositions(Pstream::nProcs());
        labelList& myVertices = allVertices[Pstream::myProcNo()];
        myVertices.setSize(members.size());
        forAll(members, i)
        {
            myVertices[i] = faces_->vertices().lookup(members[i], -1);
        }
        allPositions[Pstream::myProcNo()] = positions + td();
        foamCompat::allGatherList(allVertices);
        foamCompat::allGatherList(allPositions);
        pointField x(faces_->points());
        forAll(allVertices, ranki)
        {
            forAll(allVertices[ranki], i)
            {
                if (allVertices[ranki][i] >= 0)
                {
                    x[allVertices[ranki][i]] = allPositions[ranki][i];
                }
            }
        }
        changed = changed || x != displaced_[groupi];
        displaced_[groupi].transfer(x);
    }
    return changed;
}


void Foam::slidingPoints::updateSheets()
{
    typedef controlPointGroup::surfaceType type;

    List<DynamicList<vector>> areas(sheets_.size());
    List<DynamicList<vector>> groupAreas(groups_.size());
    boolList curved(sheets_.size(), false);
    forAll(faces_->faces(), i)
    {
        const label sheeti = faces_->sheets()[i];
        const controlPointGroup& group = groups_[faces_->tags()[i]];
        const pointField& x = vertices(sheets_[sheeti]);
        const face& f = faces_->faces()[i];
        vector area = f.areaNormal(x);
        if (magSqr(group.normal()) > 0)
        {
            area = mag(area)*group.normal();
        }
        area = plane_.reduce(f.centre(x), area);
        areas[sheeti].append(area);
        curved[sheeti] =
            curved[sheeti]
         || group.surface() == type::curved || group.surface() == type::named;
        if (group.surface() == type::planar)
        {
            groupAreas[faces_->tags()[i]].append(area);
        }
    }

    forAll(groups_, groupi)
    {
        const surfaceNormals::plane plane =
            surfaceNormals::planeThrough(vectorField(groupAreas[groupi]));
        if (groupAreas[groupi].size() && plane.deviation >= planarAngle)
        {
            FatalIOErrorInFunction(groups_[groupi].dict())
                << "Group '" << groups_[groupi].name() << "' has 'surface"
                << " planar' but its faces deviate by up to "
                << radToDeg(plane.deviation) << " degrees from a plane" << nl
                << "    Use 'surface curved', or one group for each plane"
                << nl << exit(FatalIOError);
        }
    }

    forAll(sheets_, sheeti)
    {
        sheet& s = sheets_[sheeti];
        const surfaceNormals::plane plane =
            surfaceNormals::planeThrough(vectorField(areas[sheeti]));
        s.planar = !curved[sheeti] && plane.deviation < planarAngle;
        s.normal = plane.normal;
        if (s.planar || named(s))
        {
            s.triangles.clear();
        }
        else
        {
            s.triangles.reset
            (
                new triangulatedSurface
                (
                    faces_->sheet(sheeti, vertices(s)), featureAngle_
                )
            );
        }
    }
}


Foam::List<Foam::List<Foam::surfaceNormals::ofSurface>>
Foam::slidingPoints::presentNormals() const
{
    Map<label> place(2*controlled_.size());
    forAll(controlled_, i)
    {
        place.insert(controlled_[i], i);
    }

    // A rotational cyclic leaves round-off that depends on who asks
    bool turned = false;
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        const auto* cyclic = isA<cyclicPolyPatch>(patch);
        turned = turned || (cyclic && !cyclic->parallel());
    }
    turned = returnReduce(turned, orOp<bool>());

    // Two lists for one communication each: normals are turned at cyclics
    List<List<vector>> around(controlled_.size());
    List<labelList> sheetsAround(controlled_.size());
    forAll(myFaces_, facei)
    {
        const label i = faces_->mine()[facei];
        const face& f = faces_->faces()[i];
        const label sheeti = faces_->sheets()[i];
        const sheet& s = sheets_[sheeti];
        const pointField& x = vertices(s);
        for (const label pointi : mesh_.faces()[myFaces_[facei]])
        {
            const auto found = place.cfind(pointi);
            if (!found.found())
            {
                continue;
            }
            const label k = f.find(faces_->vertices()[pointi]);
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


void Foam::slidingPoints::findNamedNormals()
{
    OStringStream message;
    forAll(present_, i)
    {
        List<surfaceNormals::ofSurface>& normals = present_[i];
        if (fixed(normals) || onAxis_[i])
        {
            continue;
        }
        const point& x = points0_[controlled_[i]];
        const bool folded =
            normals.size() == 2 && normals[0].surface == normals[1].surface;
        for (surfaceNormals::ofSurface& n : normals)
        {
            const sheet& s = sheets_[n.surface];
            if (!named(s))
            {
                continue;
            }
            if (folded && !named_[s.group].hasEdges() && message.str().empty())
            {
                message
                    << "Group '" << groupOf(s).name() << "' has an edge at "
                    << x << " but the surface that '"
                    << groupOf(s).namedSurface().keyword()
                    << "' names has none" << nl
                    << "    Give the two sides groups of their own, or name a"
                    << " file whose triangles have the edge";
            }
            const vector m = plane_.reduce(x, named_[s.group].nearest(x).normal);
            if (!folded && mag(m) > 0.5)
            {
                n.normal = m/mag(m);
            }
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
}


bool Foam::slidingPoints::adopt(const bool anew)
{
    bool changed = anew || normals_.size() != present_.size();
    for (label i = 0; i < present_.size() && !changed; ++i)
    {
        changed = normals_[i].size() != present_[i].size();
        for (label j = 0; j < present_[i].size() && !changed; ++j)
        {
            const scalar cosine =
                mag(normals_[i][j].normal & present_[i][j].normal);
            changed =
                cosine < keptCosine
             || normals_[i][j].surface != present_[i][j].surface;
        }
    }
    changed = returnReduce(changed, orOp<bool>());
    if (changed)
    {
        normals_ = present_;
    }
    return changed;
}


bool Foam::slidingPoints::fixed
(
    const List<surfaceNormals::ofSurface>& normals
) const
{
    // In a plane two directions are all there are
    return normals.empty() || normals.size() >= (plane_.active() ? 2 : 3);
}


void Foam::slidingPoints::findWhoFollows()
{
    follows_.setSize(controlled_.size());
    follows_ = false;
    curve_.setSize(controlled_.size());
    curve_ = -1;
    curves_.clear();
    curves_.setSize(faces_->nChains()*(groups_.size() + 1));
    forAll(present_, i)
    {
        if (fixed(present_[i]) || onAxis_[i])
        {
            continue;
        }
        const sheet& first = sheets_[present_[i][0].surface];
        bool planar = true;
        bool oneMotion = true;
        for (const surfaceNormals::ofSurface& n : present_[i])
        {
            const sheet& s = sheets_[n.surface];
            planar = planar && s.planar;
            oneMotion = oneMotion && s.group == first.group && !named(s);
            follows_[i] = follows_[i] || !s.planar || moves(s);
        }
        if (present_[i].size() == 2 && !planar && oneMotion && chain_[i] >= 0)
        {
            curve_[i] = chain_[i]*(groups_.size() + 1) + first.group + 1;
            if (!curves_.set(curve_[i]))
            {
                DynamicList<edge> edges;
                forAll(faces_->edges(), edgei)
                {
                    if (faces_->chains()[edgei] == chain_[i])
                    {
                        edges.append(faces_->edges()[edgei]);
                    }
                }
                curves_.set
                (
                    curve_[i],
                    new slidingCurve
                    (
                        vertices(first), edgeList(edges), featureAngle_
                    )
                );
            }
        }
    }
}


void Foam::slidingPoints::findOffsets()
{
    // Of a surface that the points are said to be on, but for the digits of
    // numbers in files
    offsets_.setSize(controlled_.size(), FixedList<scalar, 2>(Zero));
    forAll(present_, i)
    {
        if (fixed(present_[i]) || onAxis_[i])
        {
            continue;
        }
        forAll(present_[i], j)
        {
            const sheet& s = sheets_[present_[i][j].surface];
            if (named(s) && !groupOf(s).hasTarget())
            {
                const point& x = points0_[controlled_[i]];
                const slidingSurface::contact c = named_[s.group].nearest(x);
                offsets_[i][j] = c.normal & (x - c.position);
            }
        }
    }
}


void Foam::slidingPoints::checkDistances() const
{
    forAll(groups_, groupi)
    {
        if (!named_.set(groupi))
        {
            continue;
        }
        const controlPointGroup& group = groups_[groupi];
        boundBox box;
        scalar faceSize = 0;
        forAll(faces_->faces(), i)
        {
            if (faces_->tags()[i] == groupi)
            {
                const face& f = faces_->faces()[i];
                forAll(f, k)
                {
                    box.add(faces_->points()[f[k]]);
                    faceSize = max
                    (
                        faceSize, f.faceEdge(k).mag(faces_->points())
                    );
                }
            }
        }

        // Every rank has all vertices, and finds the same
        scalar largest = 0;
        point where(Zero);
        labelHashSet done;
        forAll(faces_->faces(), i)
        {
            if (faces_->tags()[i] != groupi)
            {
                continue;
            }
            for (const label v : faces_->faces()[i])
            {
                const point& x = faces_->points()[v];
                const scalar distance =
                    done.insert(v)
                  ? mag(x - named_[groupi].nearest(x).position)
                  : 0;
                if (distance > largest)
                {
                    largest = distance;
                    where = x;
                }
            }
        }
        const scalar allowed =
            group.hasTarget() ? nearTarget*box.mag() : onSurface*faceSize;
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


Foam::slidingSurface::contact Foam::slidingPoints::nearest
(
    const sheet& s,
    const point& y
) const
{
    return named(s) ? named_[s.group].nearest(y) : s.triangles->nearest(y);
}


bool Foam::slidingPoints::nearestOnEdge
(
    const label i,
    const point& y,
    slidingSurface::contact& c
) const
{
    if (curve_[i] >= 0)
    {
        c = curves_[curve_[i]].nearest(y);
        return true;
    }
    const List<surfaceNormals::ofSurface>& n = present_[i];
    if (n.size() == 2 && n[0].surface == n[1].surface)
    {
        const sheet& s = sheets_[n[0].surface];
        if (named(s))
        {
            c = named_[s.group].nearestOnEdge(y);
            return true;
        }
    }
    return false;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::slidingPoints::update(const bool anew)
{
    const bool first = chain_.empty() && normals_.empty();
    const bool moved = updateDisplaced();
    if (!returnReduce(first, andOp<bool>()) && !moved)
    {
        if (anew)
        {
            normals_ = present_;
        }
        return false;
    }

    updateSheets();
    present_ = presentNormals();
    if (returnReduce(first, andOp<bool>()))
    {
        findChains();
        checkDistances();
    }
    findNamedNormals();
    findWhoFollows();
    findOffsets();
    return adopt(anew);
}


Foam::List<Foam::vector> Foam::slidingPoints::normals(const label i) const
{
    List<vector> n(normals_[i].size());
    forAll(n, j)
    {
        n[j] = normals_[i][j].normal;
    }
    return n;
}


morph::TangentPlanes Foam::slidingPoints::planes
(
    const label i,
    const vector& s
) const
{
    const point& x = points0_[controlled_[i]];
    const point y = x + plane_.expand(x, s);
    morph::TangentPlanes planes;

    slidingSurface::contact c;
    if (nearestOnEdge(i, y, c))
    {
        const vector& along = c.normal;
        vector n = present_[i][0].normal;
        n = normalised(n - (n & along)*along);
        const vector m = along ^ n;
        planes.add(toEigen(n), n & (y - c.position));
        planes.add(toEigen(m), m & (y - c.position));
        return planes;
    }

    const bool folded =
        present_[i].size() == 2
     && present_[i][0].surface == present_[i][1].surface;
    forAll(present_[i], j)
    {
        const sheet& sh = sheets_[present_[i][j].surface];
        if (sh.planar || folded)
        {
            // Through where the surface has taken the point
            const vector& n = folded ? present_[i][j].normal : sh.normal;
            const vector d =
                plane_.reduce(x, vertices(sh)[vertex_[i]] - x);
            planes.add(toEigen(n), n & (s - d));
            continue;
        }
        c = nearest(sh, y);
        const vector m = plane_.reduce(x, c.normal);
        const scalar size = max(mag(m), SMALL);
        planes.add
        (
            toEigen(vector(m/size)),
            ((c.normal & (y - c.position)) - offsets_[i][j])/size
        );
    }
    return planes;
}


Foam::vector Foam::slidingPoints::onto(const label i, const vector& s) const
{
    const point& x = points0_[controlled_[i]];
    slidingSurface::contact c;
    if (!plane_.active())
    {
        const sheet& sh = sheets_[present_[i][0].surface];
        if (nearestOnEdge(i, x + s, c))
        {
            if (!c.beyond)
            {
                return c.position - x;
            }
        }
        else if (present_[i].size() == 1 && !sh.planar)
        {
            c = nearest(sh, x + s);
            if (!c.beyond)
            {
                return c.position + offsets_[i][0]*c.normal - x;
            }
        }
    }

    // As long as it gets nearer
    vector d = s;
    scalar former = GREAT;
    for (label step = 0; step < mostSteps; ++step)
    {
        const vector way = toFoam(morph::wayInto(planes(i, d)));
        if (mag(way) >= former)
        {
            break;
        }
        former = mag(way);
        d += way;
    }
    return d;
}


void Foam::slidingPoints::renewDirections(const label i, const vector& s)
{
    const morph::TangentPlanes p = planes(i, s);
    forAll(normals_[i], j)
    {
        const morph::Vector3 n = p.normals.col(j);
        normals_[i][j].normal = toFoam(n);
    }
}


// ************************************************************************* //
