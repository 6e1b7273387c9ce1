/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "otherSolvers.H"
#include "plainText.H"
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

    if (has("sixDoF") || has("rigidBody"))
    {
        return
            "a body is a group of 'controlPoints' with displacement"
            " { type sixDoFRigidBody; ... }";
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
        "bodies", "component", "diffusivity", "interpolation", "regions",
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

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::otherSolvers::leftovers
(
    const dictionary& dict,
    const word& own,
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
        if (!others && !othersEntry(name))
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
    OStringStream text;
    const dictionary* six =
        coefficients(dict, "sixDoFRigidBodyMotion", "momentOfInertia");
    if (six)
    {
        dictionary displacement;
        displacement.add("type", "sixDoFRigidBody");
        for (const entry& e : *six)
        {
            if (bodysOwn(e))
            {
                displacement.add(e);
            }
        }
        dictionary group;
        group.add("type", "moving");
        group.add(*six->findEntry("patches"));
        group.add("displacement", displacement);

        text<< "    A body that floats is a group of 'controlPoints':" << nl
            << nl << "body";
        group.write(text, true);
        text<< nl << "    The patches that stay are a group of type fixed there";
        return text.str();
    }

    const dictionary* joined = dict.findDict("rigidBodyMotionCoeffs");
    if (!joined)
    {
        joined = dict.findDict("bodies") ? &dict : nullptr;
    }
    if (joined)
    {
        const dictionary* list = joined->findDict("bodies");
        const wordList names(list ? list->toc() : wordList());
        text<< "    A body that floats is a group of 'controlPoints' with"
            << " displacement { type sixDoFRigidBody; ... }" << nl
            << "    (mass, centreOfMass, momentOfInertia; what a joint allows"
            << " is said by 'constraints': line, plane, point, axis,"
            << " orientation)." << nl
            << "    Bodies: " << plainText::listed(names).c_str() << '.';
        if (names.size() > 1)
        {
            text<< " Bodies joined to each other have no such type: keep"
                << " the solver rigidBodyMotion for them";
        }
        return text.str();
    }
    return string::null;
}


// ************************************************************************* //
