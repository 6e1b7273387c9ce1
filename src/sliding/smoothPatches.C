/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "smoothPatches.H"
#include "foamCompat.H"
#include "surfaceNormals.H"
#include "triangulatedSurface.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A smooth patch is planar if no face is tilted by more than this [rad]: planes
// of meshes written with six digits are not quite flat
static const scalar planarAngle = 1e-3;


// In a wedge use the normals at one of its sides, where the points are, not
// those in the middle of a face. On the axis there is none
static const point& outermost
(
    const face& f,
    const pointField& x,
    const planarReduction& plane
)
{
    label outer = f[0];
    for (const label v : f)
    {
        const vector way = plane.position(x[v]) - plane.position(x[outer]);
        if ((way & plane.radial()) > SMALL)
        {
            outer = v;
        }
    }
    return x[outer];
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::smoothPatches::smoothPatches
(
    const polyMesh& mesh,
    const pointField& points0,
    const PtrList<controlPointGroup>& groups,
    const planarReduction& plane,
    const scalar featureAngle
)
:
    mesh_(mesh),
    points0_(points0),
    groups_(groups),
    plane_(plane),
    featureAngle_(featureAngle),
    moves_(groups.size()),
    displaced_(groups.size()),
    named_(mesh, groups, featureAngle),
    shaped_(false)
{
    forAll(groups_, groupi)
    {
        moves_[groupi] = groups_[groupi].slides() && groups_[groupi].moves();
    }
    gatherFaces();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::smoothPatches::gatherFaces()
{
    // Smooth patches continue from one group to the next if both are at rest
    // and neither says what its surface is
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

    smoothPatches_.setSize(faces_->nSmoothPatches());
    forAll(faces_->faces(), i)
    {
        const label groupi = faces_->tags()[i];
        if (!smoothPatches_.set(faces_->smoothPatches()[i]))
        {
            const bool own = families[groupi] == common;
            smoothPatches_.set
            (
                faces_->smoothPatches()[i],
                new smoothPatch{own ? -1 : groupi, false, Zero, nullptr}
            );
        }
    }
}


bool Foam::smoothPatches::displace()
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

        // Every rank needs all of them
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


void Foam::smoothPatches::checkPlanes
(
    const List<DynamicList<vector>>& groupAreas
) const
{
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
}


void Foam::smoothPatches::findShapes()
{
    typedef controlPointGroup::surfaceType type;

    List<DynamicList<vector>> areas(smoothPatches_.size());
    List<DynamicList<vector>> groupAreas(groups_.size());
    boolList curved(smoothPatches_.size(), false);
    forAll(faces_->faces(), i)
    {
        const label smoothPatchi = faces_->smoothPatches()[i];
        const controlPointGroup& group = groups_[faces_->tags()[i]];
        const pointField& x = vertices(smoothPatches_[smoothPatchi]);
        const face& f = faces_->faces()[i];
        vector area = f.areaNormal(x);
        if (magSqr(group.normal()) > 0)
        {
            area = mag(area)*group.normal();
        }
        area = plane_.reduce(outermost(f, x, plane_), area);
        areas[smoothPatchi].append(area);
        curved[smoothPatchi] =
            curved[smoothPatchi]
         || group.surface() == type::curved || group.surface() == type::named;
        if (group.surface() == type::planar)
        {
            groupAreas[faces_->tags()[i]].append(area);
        }
    }

    checkPlanes(groupAreas);
    forAll(smoothPatches_, smoothPatchi)
    {
        smoothPatch& s = smoothPatches_[smoothPatchi];
        const surfaceNormals::plane plane =
            surfaceNormals::planeThrough(vectorField(areas[smoothPatchi]));
        s.planar = !curved[smoothPatchi] && plane.deviation < planarAngle;
        s.normal = plane.normal;
        if (s.planar || isNamed(s))
        {
            s.triangles.clear();
        }
        else
        {
            s.triangles.reset
            (
                new triangulatedSurface
                (
                    faces_->smoothPatch(smoothPatchi, vertices(s)), featureAngle_
                )
            );
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::smoothPatches::update()
{
    const bool changed = displace();
    if (shaped_ && !changed)
    {
        return false;
    }
    findShapes();
    if (!shaped_)
    {
        named_.checkDistances(faces_());
        shaped_ = true;
    }
    return true;
}


const Foam::pointField& Foam::smoothPatches::vertices(const smoothPatch& s) const
{
    return
        s.group >= 0 && displaced_[s.group].size()
      ? displaced_[s.group]
      : faces_->points();
}


Foam::slidingSurface::contact Foam::smoothPatches::nearest
(
    const smoothPatch& s,
    const point& y
) const
{
    return isNamed(s) ? named(s).nearest(y) : s.triangles->nearest(y);
}


// ************************************************************************* //
