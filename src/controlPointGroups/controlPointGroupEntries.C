/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointGroup.H"
#include "constraintPatches.H"
#include "dictionaryChecks.H"
#include "emptyPolyPatch.H"
#include "fixedNormalSlipPointPatchField.H"
#include "pointDisplacementField.H"
#include "pointFields.H"
#include "processorPolyPatch.H"
#include "wedgePolyPatch.H"
#include "StringStream.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::wordList Foam::controlPointGroup::selectPatches()
{
    const polyBoundaryMesh& boundary = mesh_.boundaryMesh();
    labelHashSet selected;
    for (const wordRe& pattern : dict_.get<wordRes>("patches"))
    {
        const labelHashSet these
        (
            boundary.patchSet(wordRes(1, pattern), false, true)
        );

        // A pattern may match processor patches that exist on some ranks only
        bool found = false;
        for (const label patchi : these)
        {
            found = found || patchi < boundary.nNonProcessor();
        }
        if (!found)
        {
            wordList names(boundary.names());
            names.setSize(boundary.nNonProcessor());
            FatalIOErrorInFunction(dict_)
                << "Entry 'patches': no patch or patch group is called '"
                << pattern << "'" << nl
                << "    Patches: " << plainText::listed(names).c_str() << nl
                << "    Patch groups: "
                << plainText::listed
                   (
                       boundary.groupPatchIDs().sortedToc()
                   ).c_str()
                << nl
                << exit(FatalIOError);
        }
        selected |= these;
    }

    DynamicList<word> constrained;
    for (const label patchi : selected.sortedToc())
    {
        const polyPatch& patch = boundary[patchi];

        // A pattern such as ".*" means the patches that can be controlled
        if
        (
            patch.coupled()
         || isA<emptyPolyPatch>(patch)
         || isA<wedgePolyPatch>(patch)
        )
        {
            if (patchi < boundary.nNonProcessor())
            {
                constrained.append(patch.name() + " (" + patch.type() + ')');
            }
        }
        else
        {
            patches_.append(patchi);
        }
    }
    return wordList(constrained);
}


void Foam::controlPointGroup::checkSelection
(
    const wordList& constrained
) const
{
    if
    (
        patches_.size() || faceZones_.size() || pointZones_.size()
     || listed_.size()
    )
    {
        return;
    }

    if (constrained.size())
    {
        FatalIOErrorInFunction(dict_)
            << "Group '" << name_ << "' selects no control points: its patches "
            << flatOutput(constrained) << " keep what their types say" << nl
            << "    Remove the group: such patches move with the mesh" << nl
            << exit(FatalIOError);
    }
    FatalIOErrorInFunction(dict_)
        << "Group '" << name_ << "' selects no control points" << nl
        << "    Give it 'patches', 'faceZones', 'pointZones' or 'points'"
        << nl << exit(FatalIOError);
}


void Foam::controlPointGroup::checkConstraints() const
{
    const bool surfaceMoves =
        target_ || surface_ == surfaceType::named
     || dict_.found("displacement");
    if (!slides() || !surfaceMoves)
    {
        return;
    }
    const labelHashSet constraints
    (
        constraintPatches::slidingSurfaces(mesh_)
    );
    for (const label patchi : patches_)
    {
        if (constraints.found(patchi))
        {
            const polyPatch& patch = mesh_.boundaryMesh()[patchi];
            FatalIOErrorInFunction(dict_)
                << "Group '" << name_ << "' moves the surface of patch '"
                << patch.name() << "', but a patch of type " << patch.type()
                << " stays in its own" << nl
                << "    Remove the patch from the group; if it is no "
                << patch.type() << " give it another type in "
                << "constant/polyMesh/boundary" << nl << exit(FatalIOError);
        }
    }
}


void Foam::controlPointGroup::checkZones() const
{
    string message;
    const auto check = [&](const zone& z, const label n, const char* file)
    {
        for (const label i : z)
        {
            if ((i < 0 || i >= n) && message.empty())
            {
                message =
                    "Group '" + name_ + "': zone '" + z.name() + "' of "
                  + mesh_.facesInstance()/polyMesh::meshSubDir/file
                  + " has the label " + Foam::name(i) + ", but there are "
                  + Foam::name(n)
                  + "\n    The file is that of another mesh: make the zone"
                    " again";
            }
        }
    };
    for (const label zonei : faceZones_)
    {
        check(mesh_.faceZones()[zonei], mesh_.nFaces(), "faceZones");
    }
    for (const label zonei : pointZones_)
    {
        check(mesh_.pointZones()[zonei], mesh_.nPoints(), "pointZones");
    }
    dictionaryChecks::stopIf(dict_, message);
}


void Foam::controlPointGroup::readNormal()
{
    const auto& field =
        mesh_.lookupObject<pointVectorField>("pointDisplacement");
    const pointPatchVectorField& condition =
        pointDisplacementField::condition
        (
            field, mesh_.boundaryMesh()[patches_[0]]
        );

    if (isA<fixedNormalSlipPointPatchField<vector>>(condition))
    {
        // The condition has no accessor: write it and read it back
        OStringStream written;
        condition.write(written);
        IStringStream entries(written.str());
        const vector n(dictionary(entries).get<vector>("n"));
        normal_ = n/max(mag(n), VSMALL);
    }
}


void Foam::controlPointGroup::readSurface()
{
    target_ = dict_.found("target");
    if (target_)
    {
        surface_ = surfaceType::named;
        return;
    }

    // A file name has an extension, the keywords have none
    const entry& e = *dict_.findEntry("surface");
    const token first(e.isStream() ? e.stream()[0] : token());
    const bool isFile =
        first.isString()
     || (first.isWord() && first.wordToken().find('.') != string::npos);
    surface_ =
        e.isDict() || isFile
      ? surfaceType::named
      : dictionaryChecks::getChoice(dict_, "surface", surfaceNames);
}


void Foam::controlPointGroup::checkSurface()
{
    for (const char* key : {"surface", "target"})
    {
        if (dict_.found(key) && !slides())
        {
            FatalIOErrorInFunction(dict_)
                << "Entry '" << key << "' is for groups of type sliding; this"
                << " one is " << roleNames[role_] << nl << exit(FatalIOError);
        }
    }
    if (dict_.found("surface") && dict_.found("target"))
    {
        FatalIOErrorInFunction(dict_)
            << "Both 'surface' and 'target' are given" << nl
            << "    Give one of them: 'surface' is the surface that the points"
            << " are on, 'target' another one to slide onto" << nl
            << exit(FatalIOError);
    }
    if (dict_.found("surface") || dict_.found("target"))
    {
        readSurface();
    }
    if (surface_ == surfaceType::named && dict_.found("displacement"))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry '" << namedSurface().keyword() << "' names a surface,"
            << " which a 'displacement' cannot move" << nl
            << "    Remove one of them: 'displacement' moves the patch's own"
            << " surface, 'target' names the one to slide onto" << nl
            << exit(FatalIOError);
    }
    if (slides() && (pointZones_.size() || listed_.size()))
    {
        FatalIOErrorInFunction(dict_)
            << "A sliding group needs a surface to slide on, which 'points'"
            << " and 'pointZones' do not have" << nl
            << "    Select 'patches' or 'faceZones'" << nl
            << exit(FatalIOError);
    }
}


void Foam::controlPointGroup::checkDisplacement()
{
    const dictionary* given = dict_.findDict("displacement");
    if (given && role_ == role::fixed)
    {
        FatalIOErrorInFunction(dict_)
            << "A fixed group cannot have a 'displacement'" << nl
            << "    Remove the entry, or make the group moving or sliding"
            << nl << exit(FatalIOError);
    }
    if (!given && dict_.found("displacement"))
    {
        FatalIOErrorInFunction(dict_)
            << "Entry 'displacement' has to be a dictionary:"
            << " displacement { type ...; }" << nl << exit(FatalIOError);
    }

    if (given)
    {
        displacement_ = prescribedDisplacement::New
        (
            *given, mesh_, patches_, listed_.size()
        );
    }
    else if (role_ == role::moving)
    {
        dictionary field(dict_, dictionary());
        field.add("type", "pointDisplacement");
        displacement_ = prescribedDisplacement::New
        (
            field, mesh_, patches_, listed_.size()
        );
    }
}


// ************************************************************************* //
