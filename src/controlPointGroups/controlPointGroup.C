/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointGroup.H"
#include "cellDisplacementField.H"
#include "dictionaryChecks.H"
#include "pointDisplacementField.H"
#include "finiteNumbers.H"
#include "motionOrigin.H"
#include "processorPolyPatch.H"
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

Foam::pointField Foam::controlPointGroup::origins
(
    const prescribedDisplacement::points& p
) const
{
    pointField from(p.positions);
    if (const pointVectorField* origin = motionOrigin::of(mesh_))
    {
        forAll(from, i)
        {
            if (p.meshPoints[i] >= 0)
            {
                from[i] = (*origin)[p.meshPoints[i]];
            }
        }
    }
    return from;
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

    const pointField from(origins(p));
    tmp<vectorField> td
    (
        displacement_->displacement({from, p.meshPoints, p.listed})
      + (from - p.positions)
    );
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
      ? displacement_->derivative
        (
            {origins(p), p.meshPoints, p.listed}, parameteri
        )
      : tmp<vectorField>::New(p.positions.size(), Zero);
}


// ************************************************************************* //
