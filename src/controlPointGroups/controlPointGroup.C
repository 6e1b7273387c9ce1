/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointGroup.H"
#include "cellDisplacementField.H"
#include "constraintPatches.H"
#include "dictionaryChecks.H"
#include "pointDisplacementField.H"
#include "emptyPolyPatch.H"
#include "finiteNumbers.H"
#include "processorPolyPatch.H"
#include "wedgePolyPatch.H"
#include "fixedNormalSlipPointPatchField.H"
#include "fixedValuePointPatchFields.H"
#include "pointFields.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::controlPointGroup::role>
Foam::controlPointGroup::roleNames
({
    { role::moving, "moving" },
    { role::fixed, "fixed" },
    { role::sliding, "sliding" }
});


const Foam::Enum<Foam::controlPointGroup::surfaceType>
Foam::controlPointGroup::surfaceNames
({
    { surfaceType::planar, "planar" },
    { surfaceType::curved, "curved" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{


} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::controlPointGroup::controlPointGroup
(
    const word& name,
    const dictionary& dict,
    const polyMesh& mesh
)
:
    dict_(dict),
    mesh_(mesh),
    name_(name),
    role_(dictionaryChecks::getChoice(dict, "type", roleNames)),
    surface_(surfaceType::found),
    target_(false),
    normal_(Zero),
    displacement_(nullptr)
{
    dictionaryChecks::onlyKeys
    (
        dict,
        {
            "type", "patches", "faceZones", "pointZones", "points"
        },
        {"displacement", "surface", "target"}
    );

    const wordList constrained
    (
        dict.found("patches") ? selectPatches() : wordList()
    );
    if (dict.found("faceZones"))
    {
        faceZones_ =
            dictionaryChecks::select(dict, "faceZones", mesh.faceZones().names());
    }
    if (dict.found("pointZones"))
    {
        pointZones_ = dictionaryChecks::select
        (
            dict, "pointZones", mesh.pointZones().names()
        );
    }
    if (dict.found("points"))
    {
        listed_ = dictionaryChecks::getLengths<pointField>(dict, "points");
    }
    checkSelection(constrained);
    checkZones();
    checkSurface();
    checkConstraints();
    checkDisplacement();
}


Foam::controlPointGroup::controlPointGroup
(
    const polyMesh& mesh,
    const label patchi,
    const role r
)
:
    dict_(),
    mesh_(mesh),
    name_(mesh.boundaryMesh()[patchi].name()),
    role_(r),
    surface_(surfaceType::found),
    target_(false),
    normal_(Zero),
    patches_(1, patchi),
    displacement_(nullptr)
{
    if (r == role::moving)
    {
        const auto* cells = cellDisplacementField::of(mesh);
        const bool fromCells = cells && cells->moves(patchi);
        dictionary field;
        field.add("type", fromCells ? "cellDisplacement" : "pointDisplacement");
        displacement_ =
            prescribedDisplacement::New(field, mesh, patches_, 0);
    }
    else if (r == role::sliding)
    {
        readNormal();
    }
}


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


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::controlPointGroup::moves() const
{
    // What surfaces do is looked at in every step; of points that move by a
    // condition it matters where they may have images
    if (!displacement_.valid())
    {
        return false;
    }
    if (slides() || !fromField())
    {
        return true;
    }

    // A plain fixedValue of zero is zero until somebody fills it
    const auto& field =
        mesh_.lookupObject<pointVectorField>("pointDisplacement");
    bool some = false;
    for (const label patchi : patches_)
    {
        const auto& condition = refCast<const valuePointPatchField<vector>>
        (
            pointDisplacementField::condition
            (
                field, mesh_.boundaryMesh()[patchi]
            )
        );
        some =
            some
         || condition.type() != fixedValuePointPatchField<vector>::typeName;
        for (const vector& d : condition)
        {
            some = some || d != vector(Zero);
        }
    }
    return returnReduce(some, orOp<bool>());
}


bool Foam::controlPointGroup::mayMove() const
{
    return displacement_.valid() || target_;
}


Foam::string Foam::controlPointGroup::mover() const
{
    OStringStream text;
    if (target_)
    {
        text<< "group " << name_ << " (target)";
    }
    else if (!fromField())
    {
        text<< "group " << name_ << " (displacement " << displacement_->type()
            << ')';
    }
    else
    {
        const auto& field =
            mesh_.lookupObject<pointVectorField>("pointDisplacement");
        forAll(patches_, i)
        {
            const polyPatch& patch = mesh_.boundaryMesh()[patches_[i]];
            text<< (i ? ", " : "") << "patch " << patch.name() << " ("
                << pointDisplacementField::condition(field, patch).type()
                << ')';
        }
    }
    return text.str();
}


bool Foam::controlPointGroup::fromField() const
{
    return displacement_.valid() && displacement_->fromField();
}


void Foam::controlPointGroup::update()
{
    if (displacement_.valid())
    {
        displacement_->update();
    }
}


Foam::labelHashSet Foam::controlPointGroup::meshPoints() const
{
    labelHashSet selected;
    for (const label patchi : patches_)
    {
        selected.insert(mesh_.boundaryMesh()[patchi].meshPoints());
    }
    for (const label zonei : faceZones_)
    {
        for (const label facei : mesh_.faceZones()[zonei])
        {
            selected.insert(mesh_.faces()[facei]);
        }
    }
    for (const label zonei : pointZones_)
    {
        selected.insert(mesh_.pointZones()[zonei]);
    }
    return selected;
}


Foam::labelList Foam::controlPointGroup::faces(boolList& flips) const
{
    DynamicList<label> selected;
    DynamicList<bool> flipped;
    for (const label patchi : patches_)
    {
        const polyPatch& patch = mesh_.boundaryMesh()[patchi];
        selected.append(identity(patch.size(), patch.start()));
        flipped.append(boolList(patch.size(), false));
    }
    for (const label zonei : faceZones_)
    {
        const faceZone& zone = mesh_.faceZones()[zonei];
        forAll(zone, i)
        {
            // Faces on processor patches exist on two ranks: count them once
            const label patchi = mesh_.boundaryMesh().whichPatch(zone[i]);
            const auto* between =
                patchi < 0
              ? nullptr
              : isA<processorPolyPatch>(mesh_.boundaryMesh()[patchi]);
            if (!between || between->owner())
            {
                selected.append(zone[i]);
                flipped.append(zone.flipMap()[i]);
            }
        }
    }
    flips.transfer(flipped);
    return labelList(selected);
}


Foam::tmp<Foam::vectorField> Foam::controlPointGroup::displacement
(
    const prescribedDisplacement::points& p
) const
{
    if (!displacement_.valid())
    {
        return tmp<vectorField>::New(p.positions.size(), Zero);
    }

    tmp<vectorField> td(displacement_->displacement(p));
    const vectorField& d = td();
    OStringStream message;
    for (label i = 0; i < d.size() && message.str().empty(); ++i)
    {
        if (!finiteNumbers::usable(d[i]))
        {
            message
                << "Group '" << name_ << "': the prescribed displacement at "
                << p.positions[i] << " is not finite: " << d[i]
                << nl << "    Correct "
                << (fromField() ? "pointDisplacement" : "'displacement'")
                << " of this group";
        }
    }
    dictionaryChecks::stopIf(dict_, message.str());
    return td;
}


Foam::List<Foam::motionParameter> Foam::controlPointGroup::parameters() const
{
    return
        displacement_.valid()
      ? displacement_->parameters(name_)
      : List<motionParameter>();
}


Foam::tmp<Foam::vectorField> Foam::controlPointGroup::derivative
(
    const prescribedDisplacement::points& p,
    const label parameteri
) const
{
    return
        displacement_.valid()
      ? displacement_->derivative(p, parameteri)
      : tmp<vectorField>::New(p.positions.size(), Zero);
}


// ************************************************************************* //
