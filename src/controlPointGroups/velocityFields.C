/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "velocityFields.H"
#include "localIOdictionary.H"
#include "pointPatchField.H"
#include "StringStream.H"
#include "velocityDisplacement.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// A field of another solver
struct othersField
{
    word name;
    word className;
    bool velocity;

    // Of the component it is, or zero for a vector
    vector direction;
};


static List<othersField> othersFields()
{
    List<othersField> fields;
    const vector none(Zero);
    fields.append({"pointMotionU", "pointVectorField", true, none});
    for (direction d = 0; d < vector::nComponents; ++d)
    {
        vector axis(Zero);
        axis[d] = 1;
        const word suffix(vector::componentNames[d]);
        fields.append
        (
            {"pointMotionU" + suffix, "pointScalarField", true, axis}
        );
        fields.append
        (
            {"pointDisplacement" + suffix, "pointScalarField", false, axis}
        );
    }
    fields.append({"cellMotionU", "volVectorField", true, none});
    return fields;
}


// The tokens of an entry, as they are
static string tokens(const dictionary& dict, const word& key)
{
    OStringStream text;
    bool first = true;
    for (const token& t : dict.findEntry(key)->stream())
    {
        text<< (first ? "" : " ") << t;
        first = false;
    }
    return text.str();
}


static bool isZero(const string& text)
{
    return text.find_first_of("123456789") == string::npos;
}


// What the value of a 'fixedValue' or 'uniformFixedValue' is, as an entry of
// another name: a number, or a function with its coefficients. Empty for others
static string valueAs(const word& key, const dictionary& condition)
{
    const word type(condition.get<word>("type"));
    if (type == "fixedValue" && condition.found("value"))
    {
        const string value(tokens(condition, "value"));
        return
            value.starts_with("uniform ")
          ? string(key + ' ' + value.substr(8) + ';')
          : string::null;
    }
    if (type != "uniformFixedValue" || !condition.found("uniformValue"))
    {
        return string::null;
    }

    OStringStream text;
    text<< key << ' ' << tokens(condition, "uniformValue").c_str() << ';';
    const dictionary* coeffs = condition.findDict("uniformValueCoeffs");
    if (coeffs)
    {
        text<< ' ' << key << "Coeffs { ";
        for (const entry& e : *coeffs)
        {
            text<< e;
        }
        text<< '}';
    }
    string line(text.str());
    line.replaceAll("\n", " ");
    return line;
}


static string displacement
(
    const othersField& field,
    const dictionary& condition
)
{
    const bool component = magSqr(field.direction) > 0;
    const bool scaled = component && !field.velocity;
    const string value(valueAs(scaled ? "scale" : "value", condition));
    if (value.empty())
    {
        return
            "displacement { type uniform; value (0 0 0); } /* instead of "
          + condition.get<word>("type")
          + ": the displacement, a function of time */";
    }

    OStringStream text;
    text<< "displacement { type "
        << (field.velocity ? "velocity" : "uniform") << "; ";
    if (scaled)
    {
        text<< "value scale; valueCoeffs { " << value.c_str() << " value "
            << field.direction << "; }";
    }
    else if (component)
    {
        text<< "direction " << field.direction << "; " << value.c_str();
    }
    else
    {
        text<< value.c_str();
    }
    text<< " }";
    return text.str();
}


// The group of a patch with this condition
static string group
(
    const othersField& field,
    const word& patch,
    const dictionary& dict
)
{
    const word type(dict.get<word>("type"));
    const string select(" patches (" + patch + ");");
    if (type == "slip" || type == "fixedNormalSlip" || type == "symmetry")
    {
        return "type sliding;" + select;
    }
    if (type == "zeroGradient" || type == "calculated")
    {
        return string::null;
    }
    const string value(valueAs("value", dict));
    const bool rests =
        value.size() && !dict.found("uniformValueCoeffs") && isZero(value);
    return
        rests
      ? "type fixed;" + select
      : "type moving;" + select + ' ' + displacement(field, dict);
}


static string asGroups(const polyMesh& mesh, const othersField& field)
{
    const IOobject file
    (
        field.name,
        mesh.time().timeName(),
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
    IOobject header(file, file.name());
    const untrapped numbers;
    if (!returnReduce(header.typeHeaderOk<localIOdictionary>(false), orOp<bool>()))
    {
        return string::null;
    }

    OStringStream text;
    text<< "    "
        << mesh.time().relativePath(file.objectPath()).c_str()
        << (field.velocity ? " prescribes velocities"
            : " prescribes one component of the displacement")
        << ", which another motion solver reads." << nl;
    const localIOdictionary read(file, field.className);
    const dictionary& conditions = read.subDict("boundaryField");

    // Where groups share a point the first has it: those that say where it
    // goes, of these the last patch, as in OpenFOAM's fields
    string groups, sliding;
    bool moves = false;
    for (label patchi = 0; patchi < mesh.boundaryMesh().nNonProcessor(); ++patchi)
    {
        const polyPatch& patch = mesh.boundaryMesh()[patchi];
        const dictionary* condition =
            conditions.findDict(patch.name(), keyType::REGEX);
        if (!condition || polyPatch::constraintType(patch.type()))
        {
            continue;
        }
        const string body(group(field, patch.name(), *condition));
        moves = moves || body.find("moving") != string::npos;
        const string line("    " + patch.name() + " { " + body + " }\n");
        if (body.find("type sliding") == 0)
        {
            sliding += line;
        }
        else if (body.size())
        {
            groups = line + groups;
        }
    }
    groups += sliding;


    text<< "    Write what it says into the coefficients:" << nl << nl
        << "controlPoints" << nl << '{' << nl << groups.c_str() << '}' << nl;
    if (!moves)
    {
        text<< nl
            << "    All of its values are zero: if a program fills them while"
            << " it runs, it has to fill fixedValue conditions" << nl
            << "    of pointDisplacement; one that needs a solver for"
            << " velocities (interfaceTrackingFvMesh) keeps that solver" << nl;
    }
    return text.str();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::velocityFields::asGroups(const polyMesh& mesh)
{
    string text;
    for (const othersField& field : othersFields())
    {
        text += Foam::asGroups(mesh, field);
    }
    return text;
}


// ************************************************************************* //
