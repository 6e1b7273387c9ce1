/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionImages.H"
#include "foamCompat.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"

#include <limits>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::motionImages::policy> Foam::motionImages::policyNames
({
    { policy::automatic, "auto" },
    { policy::yes, "yes" },
    { policy::no, "no" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Above this number images are not worthwhile
static const morph::Index mostImages = 200;


// Planes of symmetry, which keep their points whatever groups say
static labelHashSet mirrorPatches(const polyMesh& mesh)
{
    labelHashSet mirrors;
    forAll(mesh.boundaryMesh(), patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        if (isA<symmetryPolyPatch>(patch) || isA<symmetryPlanePolyPatch>(patch))
        {
            mirrors.insert(patchi);
        }
    }
    return mirrors;
}


static labelHashSet movingPoints(const controlPointGroups& groups)
{
    labelHashSet moving;
    for (const controlPointGroup& group : groups)
    {
        if (group.moves())
        {
            moving |= group.meshPoints();
        }
    }
    return moving;
}


static pointField listedPoints(const controlPointGroups& groups)
{
    pointField listed;
    for (const controlPointGroup& group : groups)
    {
        listed.append(group.listed());
    }
    return listed;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionImages::motionImages
(
    const polyMesh& mesh,
    const dictionary& dict,
    const pointField& points0,
    const planarReduction& plane,
    const controlPointGroups& groups,
    const settings& s
)
:
    dict_(dict),
    settings_(s),
    found_
    (
        mesh, points0, plane, mirrorPatches(mesh), movingPoints(groups),
        listedPoints(groups)
    ),
    supportRadius_(0)
{
    if (settings_.images == policy::no)
    {
        return;
    }
    for (const string& why : found_.reasons())
    {
        disable(why);
    }
    if (found_.generators().empty())
    {
        if (found_.reasons().empty() && asked())
        {
            disable("the mesh has neither symmetry planes nor periodic sides");
        }
        return;
    }
    if (settings_.refusal.size())
    {
        disable(settings_.refusal);
        return;
    }
    try
    {
        touching_ = within(found_.touch());
    }
    catch (const morph::TooManyImages& tooMany)
    {
        disable
        (
            "more than " + name(label(tooMany.most)) + " of them are within"
            " reach: the mesh is too thin between its periodic sides"
        );
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::motionImages::asked() const
{
    return settings_.images == policy::yes;
}


void Foam::motionImages::disable(const string& why)
{
    if (asked())
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'images' is yes, but " << why.c_str() << nl
            << "    Use 'images auto' for those there can be, or 'images no'"
            << nl << exit(FatalIOError);
    }
    Info<< "rbfMotionSolver: no images: " << why.c_str() << endl;
}


morph::ImageGroup Foam::motionImages::within(const scalar reach) const
{
    return morph::ImageGroup
    (
        found_.generators(), found_.box(), reach, mostImages
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::motionImages::disableIf(const string& why)
{
    List<string> all(Pstream::nProcs());
    all[Pstream::myProcNo()] = why;
    foamCompat::allGatherList(all);
    for (const string& one : all)
    {
        if (one.size())
        {
            touching_ = inReach_ = morph::ImageGroup();
            disable(one);
            return;
        }
    }
}


bool Foam::motionImages::reach(const scalar supportRadius)
{
    if (!active())
    {
        return true;
    }
    supportRadius_ =
        settings_.compactKernel ? supportRadius : std::numeric_limits<scalar>::infinity();
    try
    {
        inReach_ = within(supportRadius_);
    }
    catch (const morph::TooManyImages& tooMany)
    {
        touching_ = inReach_ = morph::ImageGroup();
        disable
        (
            settings_.compactKernel
          ? "more than " + name(label(tooMany.most)) + " of them are within"
            " the support radius of " + name(supportRadius) + " m"
          : "periodic sides have endlessly many, and the kernel is nowhere"
            " zero"
        );
        return false;
    }
    Info<< "rbfMotionSolver: " << label(inReach_.maps().size() - 1)
        << " images within reach, of " << found_.nMirrors()
        << " symmetry planes and " << label(found_.periods().size())
        << " pairs of periodic sides" << endl;
    return true;
}


morph::ImageGroup Foam::motionImages::inReach
(
    const scalar displacement
) const
{
    return
        active() ? within(supportRadius_ + 2*displacement)
      : morph::ImageGroup();
}


// ************************************************************************* //
