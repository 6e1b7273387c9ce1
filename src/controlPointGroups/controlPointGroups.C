/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointGroups.H"
#include "basicSymmetryPointPatchField.H"
#include "calculatedPointPatchField.H"
#include "cellDisplacementField.H"
#include "constraintPatches.H"
#include "motionOrigin.H"
#include "motionZone.H"
#include "otherSolvers.H"
#include "pointDisplacementField.H"
#include "pointFields.H"
#include "rigidMotion.H"
#include "velocityFields.H"
#include "zeroGradientPointPatchField.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static bool slidingCondition(const pointPatchVectorField& condition)
{
    return isA<basicSymmetryPointPatchField<vector>>(condition);
}


} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::controlPointGroups::controlPointGroups
(
    const polyMesh& mesh,
    const dictionary& dict,
    const dictionary& coeffs,
    const word& solver,
    const pointVectorField& pointDisplacement,
    const rigidMotion* rigid
)
:
    mesh_(mesh),
    dict_(dict),
    solver_(solver),
    pointDisplacement_(pointDisplacement),
    rigid_(rigid),
    constraints_(constraintPatches::slidingSurfaces(mesh))
{
    motionOrigin::read(mesh);
    freeze(coeffs);
    const dictionary* groups = coeffs.findDict("controlPoints");
    if (groups)
    {
        readGroups(*groups);
        addConstraintPatches();
    }
    else if (coeffs.found("controlPoints"))
    {
        FatalIOErrorInFunction(coeffs)
            << "Entry 'controlPoints' has to be a dictionary of groups" << nl
            << exit(FatalIOError);
    }
    else
    {
        groupsFromField(coeffs);
    }
    checkThatSomethingMoves(coeffs);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::controlPointGroups::freeze(const dictionary& coeffs)
{
    const word zone(motionZone::frozenZone(coeffs, mesh_));
    if (zone.empty())
    {
        return;
    }
    dictionary group(coeffs, dictionary());
    group.add("type", "fixed");
    group.add("pointZones", wordList(1, zone));
    append(new controlPointGroup(motionZone::frozenKey, group, mesh_));
}


void Foam::controlPointGroups::readGroups(const dictionary& dict)
{
    for (const entry& e : dict)
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' is not a group of control"
                << " points" << nl << "    A group is a dictionary: "
                << e.keyword() << " { type ...; patches (...); }" << nl
                << exit(FatalIOError);
        }
        append(new controlPointGroup(e.keyword(), e.dict(), mesh_));
    }
}


void Foam::controlPointGroups::addConstraintPatches()
{
    labelHashSet selected;
    for (const controlPointGroup& group : *this)
    {
        selected.insert(group.patches());
    }
    for (const label patchi : constraints_.sortedToc())
    {
        if (!selected.found(patchi))
        {
            append
            (
                new controlPointGroup
                (
                    mesh_, patchi, controlPointGroup::role::sliding
                )
            );
        }
    }
}


void Foam::controlPointGroups::groupsFromField(const dictionary& coeffs)
{
    checkConditions(coeffs);

    // Where patches meet the last one wins, as it does when OpenFOAM evaluates
    // the boundary conditions one after the other
    const auto* cells = cellDisplacementField::of(mesh_);
    typedef controlPointGroup::role role;
    for (const role r : {role::moving, role::sliding})
    {
        forAllReverse(mesh_.boundaryMesh(), patchi)
        {
            const pointPatchVectorField& condition =
                pointDisplacementField::condition
                (
                    pointDisplacement_, mesh_.boundaryMesh()[patchi]
                );
            const bool slides =
                slidingCondition(condition) || constraints_.found(patchi);
            if
            (
                r == role::sliding
              ? slides
              : !slides
             && (condition.fixesValue() || (cells && cells->moves(patchi)))
            )
            {
                append(new controlPointGroup(mesh_, patchi, r));
            }
        }
    }
}


void Foam::controlPointGroups::checkConditions
(
    const dictionary& coeffs
) const
{
    for (const pointPatchVectorField& condition
        : pointDisplacement_.boundaryField())
    {
        if (pointDisplacementField::patchIndex(condition) < 0)
        {
            checkPointPatch(coeffs, condition);
            continue;
        }
        const polyPatch& patch = mesh_.boundaryMesh()
        [
            pointDisplacementField::patchIndex(condition)
        ];
        if
        (
            !condition.fixesValue()
         && !slidingCondition(condition)
         && condition.constraintType() == word::null
         && condition.patch().constraintType() == word::null
         && !isA<zeroGradientPointPatchField<vector>>(condition)
         && !isA<calculatedPointPatchField<vector>>(condition)
        )
        {
            FatalIOErrorInFunction(coeffs)
                << "The pointDisplacement condition of patch '"
                << patch.name() << "' has type '" << condition.type()
                << "', which rbfMotionSolver cannot interpret" << nl
                << "    Points move where the condition fixes the value, slide"
                << " with slip and symmetry," << nl
                << "    and are free with zeroGradient and calculated." << nl
                << "    Use one of these, or list in 'controlPoints' which"
                << " patches move, slide or are fixed" << nl
                << exit(FatalIOError);
        }
    }
}


void Foam::controlPointGroups::checkPointPatch
(
    const dictionary& coeffs,
    const pointPatchVectorField& condition
) const
{
    if (!condition.fixesValue() && !slidingCondition(condition))
    {
        return;
    }
    FatalIOErrorInFunction(coeffs)
        << "The pointDisplacement condition of '" << condition.patch().name()
        << "' has type '" << condition.type() << "'," << nl
        << "    but that is a patch of points without faces, which is not"
        << " controlled by its condition" << nl
        << "    Make its condition calculated, put its points into a pointZone"
        << " and add to 'controlPoints'" << nl
        << "    " << condition.patch().name() << " { type moving; pointZones"
        << " (...); displacement { ... } }" << nl << exit(FatalIOError);
}


void Foam::controlPointGroups::checkThatSomethingMoves
(
    const dictionary& coeffs
) const
{
    bool moves = false, may = false;
    for (const controlPointGroup& group : *this)
    {
        moves = moves || group.moves() || group.hasTarget();
        may = may || group.mayMove();
    }
    if (moves || rigid_)
    {
        return;
    }

    const fileName field
    (
        mesh_.time().relativePath(pointDisplacement_.objectPath())
    );
    const string bodies(otherSolvers::bodies(dict_));
    if (bodies.size())
    {
        FatalIOErrorInFunction(dict_)
            << "Nothing moves the mesh: " << solver_ << " does not move the"
            << " body of this dictionary by itself" << nl
            << "    Let a group move it:" << nl << bodies.c_str() << nl
            << exit(FatalIOError);
    }
    if (!may)
    {
        FatalIOErrorInFunction(coeffs)
            << "Nothing moves the mesh: no patch or group prescribes a motion"
            << nl << others().c_str()
            << "    Give a patch a moving condition in " << field.c_str()
            << ": fixedValue (a coupling may fill it)," << nl
            << "    uniformFixedValue, solidBodyMotionDisplacement,"
            << " oscillatingDisplacement, ...;" << nl
            << "    or add a group of type moving to 'controlPoints', with"
            << " displacement { type sixDoFRigidBody; ... }" << nl
            << "    or { type rigidBody; ... } if it is a body that floats" << nl << exit(FatalIOError);
    }
}


Foam::string Foam::controlPointGroups::leftovers(bool& tells) const
{
    return otherSolvers::leftovers
    (
        dict_, solver_, rigid_ ? rigid_->entry() : word::null, tells
    );
}


Foam::string Foam::controlPointGroups::others() const
{
    bool tells = false;
    const string lines(leftovers(tells));
    string text(velocityFields::asGroups(mesh_));
    if (lines.size())
    {
        text +=
            "    " + mesh_.time().relativePath(dict_.name())
          + " has entries of other motion solvers:\n" + lines;
    }
    return text;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::controlPointGroups::fromField() const
{
    for (const controlPointGroup& group : *this)
    {
        if (group.fromField())
        {
            return true;
        }
    }
    return false;
}


bool Foam::controlPointGroups::mayMove() const
{
    for (const controlPointGroup& group : *this)
    {
        if (group.mayMove())
        {
            return true;
        }
    }
    return false;
}


void Foam::controlPointGroups::report(const bool moves) const
{
    const fileName file(mesh_.time().relativePath(dict_.name()));
    bool tells = false;
    const string left(leftovers(tells));
    if ((moves || rigid_) && tells)
    {
        IOWarningInFunction(dict_)
            << solver_ << " does not read what " << file.c_str()
            << " has for other motion solvers:" << nl
            << left.c_str()
            << "    Remove it, or write what does the same here" << endl;
    }
    else if ((moves || rigid_) && left.size())
    {
        Info<< solver_ << " does not read what " << file.c_str()
            << " has for other motion solvers:" << nl << left.c_str() << flush;
    }
    if (moves || rigid_)
    {
        return;
    }

    string movers;
    for (const controlPointGroup& group : *this)
    {
        if (group.mayMove())
        {
            movers += "        " + group.mover() + '\n';
        }
    }
    const string lines(others());
    IOWarningInFunction(dict_)
        << "Nothing moves the mesh: at time " << mesh_.time().timeName()
        << " every displacement is zero" << nl
        << "    Nothing is to be done if it is to rest or a coupling is about to"
        << " move it. It follows what these say:" << nl
        << movers.c_str() << lines.c_str() << endl;
}


void Foam::controlPointGroups::update()
{
    for (controlPointGroup& group : *this)
    {
        group.update();
    }
}


// ************************************************************************* //
