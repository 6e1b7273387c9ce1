/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "bodyTree.H"
#include "dictionaryChecks.H"
#include "plainText.H"
#include "rigidBodyModel.H"
#include "rigidBodyModelState.H"
#include "symmTensor.H"
#include "tensor.H"

#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const word root("root");


// What a body is joined to or merged with
static word parent(const dictionary& body)
{
    for (const char* key : {"parent", "mergeWith"})
    {
        const entry* e = body.findEntry(key);
        if (!e)
        {
            continue;
        }
        if (!e->isStream() || e->stream().size() != 1 || !e->stream()[0].isWord())
        {
            FatalIOErrorInFunction(body)
                << "Entry '" << key << "' has to be the name of one body" << nl
                << "    Joints make a tree: a body has one parent. What holds it"
                << " elsewhere is a spring in 'restraints'" << nl
                << exit(FatalIOError);
        }
        return e->stream()[0].wordToken();
    }
    FatalIOErrorInFunction(body)
        << "Body '" << body.dictName() << "' is joined to nothing" << nl
        << "    Give it 'parent' (root is the frame of the mesh) and 'joint',"
        << " or 'mergeWith'" << nl << exit(FatalIOError);
    return word::null;
}


static void checkParents(const dictionary& bodies)
{
    wordList before(1, root);
    for (const entry& e : bodies)
    {
        const word& name = e.keyword();
        const word above(parent(e.dict()));
        if (above != root && !bodies.found(above))
        {
            FatalIOErrorInFunction(e.dict())
                << "Body '" << name << "' is joined to '" << above
                << "', which is no body" << nl
                << "    Bodies: root "
                << plainText::listed(bodies.toc()).c_str() << nl
                << exit(FatalIOError);
        }

        // Upwards, until the root or a body for the second time
        wordList chain(1, name);
        for (word up = above; up != root; up = parent(bodies.subDict(up)))
        {
            if (chain.found(up))
            {
                chain.append(up);
                FatalIOErrorInFunction(e.dict())
                    << "The joints of body '" << name << "' close a loop: "
                    << plainText::listed(chain).c_str() << nl
                    << "    Joints make a tree that starts at root. Take one"
                    << " joint of the loop away, and hold the bodies together"
                    << " there by a linearSpring in 'restraints'" << nl
                    << exit(FatalIOError);
            }
            chain.append(up);
            if (up != root && !bodies.found(up))
            {
                break;
            }
        }
        if (!before.found(above))
        {
            FatalIOErrorInFunction(e.dict())
                << "Body '" << name << "' comes before '" << above
                << "', which it is joined to" << nl
                << "    Write '" << above << "' first" << nl
                << exit(FatalIOError);
        }
        before.append(name);
    }
}


static void checkMass(const dictionary& body)
{
    if (!body.found("mass"))
    {
        FatalIOErrorInFunction(body)
            << "Body '" << body.dictName() << "' needs the entry 'mass'" << nl
            << "    A body that only joins others is of type masslessBody" << nl
            << exit(FatalIOError);
    }
    dictionaryChecks::getPositive(body, "mass");
    if (body.get<word>("type") != "rigidBody")
    {
        return;
    }
    const symmTensor inertia(body.get<symmTensor>("inertia"));
    const vector principal(eigenValues(inertia));
    if (!(cmptMin(principal) > -SMALL*mag(inertia)))
    {
        FatalIOErrorInFunction(body)
            << "Entry 'inertia' is " << inertia << ", of which a principal"
            << " value is negative: " << principal << nl
            << "    Give (xx xy xz yy yz zz) about the centre of mass" << nl
            << exit(FatalIOError);
    }
}


static void checkBody(const dictionary& bodies, const word& name)
{
    const dictionary& body = bodies.subDict(name);
    if (body.get<word>("type") == "masslessBody")
    {
        bool carries = false;
        for (const entry& e : bodies)
        {
            carries = carries || parent(e.dict()) == name;
        }
        if (!carries)
        {
            FatalIOErrorInFunction(body)
                << "Body '" << name << "' has no mass, and nothing that has"
                << " one is joined to it" << nl
                << "    Give it a type with 'mass', or join a body to it" << nl
                << exit(FatalIOError);
        }
    }
    else
    {
        if (!body.found("centreOfMass"))
        {
            FatalIOErrorInFunction(body)
                << "Body '" << name << "' needs the entry 'centreOfMass'" << nl
                << "    Where it is seen from the joint: centreOfMass (x y z);"
                << nl << exit(FatalIOError);
        }
        checkMass(body);
    }

    if (!body.found("transform"))
    {
        FatalIOErrorInFunction(body)
            << "Body '" << name << "' needs the entry 'transform'" << nl
            << "    Its axes and where its joint is, in the frame of its parent:"
            << " transform (1 0 0 0 1 0 0 0 1) (x y z);" << nl
            << exit(FatalIOError);
    }
    if (body.found("parent") && !body.findDict("joint"))
    {
        FatalIOErrorInFunction(body)
            << "Body '" << name << "' needs the dictionary 'joint'" << nl
            << "    A hinge about its y axis is joint { type Ry; }; to fix it to"
            << " its parent write 'mergeWith' in place of 'parent'" << nl
            << exit(FatalIOError);
    }
}


static void checkRestraints(const dictionary& dict)
{
    const dictionary* restraints = dict.findDict("restraints");
    if (!restraints)
    {
        return;
    }
    for (const entry& e : *restraints)
    {
        if (!e.isDict())
        {
            continue;
        }
        const word body(e.dict().get<word>("body"));
        if (!dict.subDict("bodies").found(body))
        {
            FatalIOErrorInFunction(e.dict())
                << "Restraint '" << e.keyword() << "' holds '" << body
                << "', which is no body" << nl
                << "    Bodies: "
                << plainText::listed(dict.subDict("bodies").toc()).c_str()
                << nl << exit(FatalIOError);
        }
    }
}


// The equations of motion, to see whether they can be solved
class equations
:
    public RBD::rigidBodyModel
{
public:

    using RBD::rigidBodyModel::rigidBodyModel;

    // The body next to the last joint that no mass resists, or nothing
    word unresisted(const dictionary& dict) const
    {
        const untrapped numbers;
        RBD::rigidBodyModelState state(*this, dict);
        forwardDynamics
        (
            state, scalarField(nDoF(), Zero), Field<spatialVector>()
        );
        for (label i = nBodies() - 1; i > 0; --i)
        {
            const bool single = joints()[i].nDoF() == 1;
            for (direction d = 0; d < (single ? 1 : 9); ++d)
            {
                if (!std::isfinite(Dinv_[i][d]))
                {
                    return name(i);
                }
            }
        }
        return word::null;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::bodyTree::check(const dictionary& dict, const Time& time)
{
    const dictionary& bodies = dict.subDict("bodies");
    for (const entry& e : bodies)
    {
        if (!e.isDict() || e.keyword() == root)
        {
            FatalIOErrorInFunction(bodies)
                << "Entry '" << e.keyword() << "' is no body" << nl
                << "    A body is a dictionary with a name of its own:"
                << " <name> { type rigidBody; parent root; ... }. Variables go"
                << " outside of 'bodies'" << nl << exit(FatalIOError);
        }
    }
    checkParents(bodies);
    for (const word& name : bodies.toc())
    {
        checkBody(bodies, name);
    }
    checkRestraints(dict);

    const word body
    (
        dictionaryChecks::naming
        (
            dict,
            "bodies",
            [&] { return equations(time, dict).unresisted(dict); }
        )
    );
    if (body.size())
    {
        FatalIOErrorInFunction(bodies)
            << "No mass resists the joint of body '" << body << "'" << nl
            << "    Give it 'inertia' about the axes of its joint, or a"
            << " 'centreOfMass' off them" << nl << exit(FatalIOError);
    }
}


// ************************************************************************* //
