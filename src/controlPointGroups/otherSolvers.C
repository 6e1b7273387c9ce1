/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "otherSolvers.H"
#include "plainText.H"
#include "primitiveEntry.H"
#include "wordRes.H"
#include "HashSet.H"
#include "StringStream.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const string coeffs("Coeffs");

// What does here what an entry of that name did there
static string counterpart(const word& name)
{
    const auto has = [&](const char* part)
    {
        return name.find(part) != string::npos;
    };

    for (const char* body : {"sixDoFRigidBody", "rigidBody"})
    {
        if (has(body))
        {
            return
                "a body is a group of 'controlPoints' with displacement { type "
              + string(body) + "; ... }";
        }
    }
    if (name == "bodies")
    {
        return counterpart("rigidBody");
    }
    if (has("olidBody"))
    {
        return
            "a rigid motion is a group of 'controlPoints' with displacement"
            " { type solidBody; solidBodyMotionFunction ...; }";
    }
    if (has("Layered") || name == "regions")
    {
        return
            "layers are neither moved nor added; points that are to stay are"
            " a group of type fixed";
    }
    if (name == "code" || name == "codedCoeffs")
    {
        return
            "a coded motion keeps its solver; on patches a codedFixedValue"
            " condition of pointDisplacement prescribes it";
    }
    if (has("elocity") || has("omponent"))
    {
        return
            "a velocity is a group with displacement { type velocity; ... }";
    }
    if (name == "diffusivity" || name == "interpolation")
    {
        return "supportRadius says how far a motion reaches";
    }
    return "not read";
}


// Entries without a dictionary of coefficients that only others read
static bool othersEntry(const word& name)
{
    static const HashSet<word> names
    ({
        "bodies", "code", "component", "diffusivity", "interpolation", "regions",
        "solidBodyMotionFunction"
    });
    return names.found(name);
}


static word chosen(const dictionary& dict, const word& key)
{
    const entry* e = dict.findEntry(key);
    return
        e && e->isStream() && e->stream().size() && e->stream()[0].isWord()
      ? e->stream()[0].wordToken()
      : word::null;
}


static const dictionary* coefficients
(
    const dictionary& dict,
    const word& solver,
    const word& key
)
{
    const dictionary* coeffs = dict.findDict(solver + "Coeffs");
    return
        coeffs ? coeffs
      : dict.found(key) && dict.found("patches") ? &dict
      : nullptr;
}


// Of a body's entries, what is about the body; not about the mesh around it, or
// about the solver where its coefficients are beside these
static bool bodysOwn(const entry& e)
{
    static const HashSet<word> others
    ({
        "FoamFile", "dynamicFvMesh", "innerDistance", "motionSolver",
        "motionSolverLibs", "outerDistance", "patches", "updateControl",
        "updateInterval"
    });
    return !others.found(e.keyword()) && (e.keyword() != "solver" || e.isDict());
}


// A group that moves these patches, to copy
static string group(const entry& patches, const dictionary& displacement)
{
    dictionary group;
    group.add("type", "moving");
    group.add(patches);
    group.add("displacement", displacement);

    OStringStream text;
    text<< "    A body that floats is a group of 'controlPoints':" << nl
        << nl << "body";
    group.write(text, true);
    text<< nl << "    The patches that stay are a group of type fixed there";
    return text.str();
}


// The entries of a solver for bodies, as those of a displacement
static dictionary displacement(const word& type, const dictionary& coeffs)
{
    dictionary result;
    result.add("type", type);
    for (const entry& e : coeffs)
    {
        if (bodysOwn(e))
        {
            result.add(e);
        }
    }
    return result;
}


// The same of bodies with joints, whose patches and distances are in each
static string joined(const dictionary& coeffs)
{
    dictionary displacement(Foam::displacement("rigidBody", coeffs));
    wordRes patches;
    for (const word& name : coeffs.subDict("bodies").toc())
    {
        dictionary* body =
            displacement.subDict("bodies").findDict(name, keyType::LITERAL);
        if (!body)
        {
            continue;
        }
        body->remove("innerDistance");
        body->remove("outerDistance");
        if (body->found("patches"))
        {
            patches.append(body->get<wordRes>("patches"));
        }
    }
    return group(primitiveEntry("patches", patches), displacement);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::otherSolvers::leftovers
(
    const dictionary& dict,
    const word& own,
    const word& heard,
    bool& tells
)
{
    tells = false;
    string lines;
    for (const entry& e : dict)
    {
        const word& name = e.keyword();
        const bool others =
            name.ends_with(coeffs) && e.isDict()
         && name != own + coeffs
         && name != chosen(dict, "dynamicFvMesh") + coeffs;
        if (name == heard || (!others && !othersEntry(name)))
        {
            continue;
        }

        lines += "        " + name;
        string meaning(counterpart(name));
        bool says = name != "diffusivity" && name != "interpolation";
        if (others)
        {
            lines += ' ' + plainText::listed(e.dict().toc());
            const bool freezes = e.dict().found("frozenPointsZone");
            if (freezes)
            {
                meaning =
                    "write 'frozenPointsZone' into " + own + coeffs
                  + " to keep its points";
            }
            else if (meaning == "not read" && e.dict().found("diffusivity"))
            {
                meaning = counterpart("diffusivity");
                says = false;
            }
        }
        lines += ": " + meaning + '\n';
        tells = tells || says;
    }
    return lines;
}


Foam::string Foam::otherSolvers::bodies(const dictionary& dict)
{
    const dictionary* six =
        coefficients(dict, "sixDoFRigidBodyMotion", "momentOfInertia");
    if (six)
    {
        return group
        (
            *six->findEntry("patches"),
            displacement("sixDoFRigidBody", *six)
        );
    }

    const dictionary* coeffs = dict.findDict("rigidBodyMotionCoeffs");
    if (!coeffs)
    {
        coeffs = &dict;
    }
    return coeffs->findDict("bodies") ? joined(*coeffs) : string::null;
}


// ************************************************************************* //
