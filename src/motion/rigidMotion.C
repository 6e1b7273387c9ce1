/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rigidMotion.H"
#include "dictionaryChecks.H"
#include "finiteNumbers.H"
#include "plainText.H"
#include "polyMesh.H"
#include "transformField.H"
#include "UIndirectList.H"
#include "untrappedHere.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const functionKey = "solidBodyMotionFunction";
static const char* const zonesEntry = "multiSolidBodyMotionSolverCoeffs";


// Does it have a function for a zone of the mesh?
static bool hasZones(const dictionary& dict, const polyMesh& mesh)
{
    for (const entry& e : dict)
    {
        if (e.isDict() && mesh.cellZones().findZoneID(e.keyword()) >= 0)
        {
            return true;
        }
    }
    return false;
}


// Entries with a rigid motion, of other solvers
static wordList others(const dictionary& dict, const polyMesh& mesh)
{
    wordList found;
    if (dict.found(functionKey))
    {
        found.append(functionKey);
    }
    for
    (
        const word& name
      : {word("solidBodyCoeffs"), word("solidBodyDisplacementLaplacianCoeffs")}
    )
    {
        const dictionary* coeffs = dict.findDict(name);
        if (coeffs && coeffs->found(functionKey))
        {
            found.append(name);
        }
    }
    const dictionary* zones = dict.findDict(zonesEntry);
    if (zones && hasZones(*zones, mesh))
    {
        found.append(zonesEntry);
    }
    return found;
}


// Are there entries of solvers that deform, beside that of a rigid motion?
static bool deforms(const dictionary& dict, const word& rigid)
{
    for (const entry& e : dict)
    {
        if
        (
            e.isDict()
          ? e.keyword() != rigid && e.dict().found("diffusivity")
          : e.keyword() == "diffusivity" && rigid != functionKey
        )
        {
            return true;
        }
    }
    return false;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rigidMotion::rigidMotion
(
    const dictionary& dict,
    const dictionary& coeffs,
    const dictionary& source,
    const word& entry,
    const polyMesh& mesh
)
:
    entry_(entry),
    zoned_
    (
        source.found("cellZone") || source.found("cellSet") ? source : coeffs
    ),
    zones_(entry == zonesEntry),
    alone_
    (
        zones_
     || (
            (&source != &coeffs || &source == &dict)
         && !source.found("diffusivity")
        )
    )
{
    if (!zones_)
    {
        parts_.append(new motionZone(dict, zoned_, mesh));
        add(source, mesh);
        return;
    }
    for (const Foam::entry& e : source)
    {
        if (!e.isDict())
        {
            continue;
        }
        if (mesh.cellZones().findZoneID(e.keyword()) < 0)
        {
            FatalIOErrorInFunction(source)
                << "Entry '" << e.keyword() << "': no cellZone is called so"
                << nl << "    There are: "
                << flatOutput(mesh.cellZones().names()) << nl
                << exit(FatalIOError);
        }
        dictionary zone(source.name());
        zone.add("cellZone", e.keyword());
        parts_.append(new motionZone(zone, zone, mesh));
        add(e.dict(), mesh);
    }
}


Foam::autoPtr<Foam::rigidMotion> Foam::rigidMotion::New
(
    const dictionary& dict,
    const dictionary& coeffs,
    const polyMesh& mesh
)
{
    if (&coeffs != &dict && coeffs.found(functionKey))
    {
        return autoPtr<rigidMotion>
        (
            new rigidMotion(dict, coeffs, coeffs, functionKey, mesh)
        );
    }
    const wordList found(others(dict, mesh));
    if
    (
        found.empty()
     || coeffs.found("controlPoints")
     || deforms(dict, found[0])
    )
    {
        return nullptr;
    }
    if (found.size() > 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entries " << plainText::listed(found).c_str()
            << " each have a rigid motion" << nl
            << "    Remove those that did not move the mesh before" << nl
            << exit(FatalIOError);
    }
    const word& name = found[0];
    return autoPtr<rigidMotion>
    (
        new rigidMotion
        (
            dict,
            coeffs,
            name == functionKey ? dict : dict.subDict(name),
            name,
            mesh
        )
    );
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::rigidMotion::add(const dictionary& dict, const polyMesh& mesh)
{
    functions_.append
    (
        dictionaryChecks::naming
        (
            dict,
            functionKey,
            [&]
            {
                return solidBodyMotionFunction::New(dict, mesh.time());
            }
        ).release()
    );
}


Foam::septernion Foam::rigidMotion::transformation(const label i) const
{
    const untrappedHere numbers;
    const septernion t(functions_[i].transformation());
    if
    (
        !finiteNumbers::usable(t.t())
     || !finiteNumbers::usable(t.r().w())
     || !finiteNumbers::usable(t.r().v())
    )
    {
        FatalErrorInFunction
            << "The rigid motion " << functions_[i].type() << " of entry '"
            << entry_ << "' is not finite, or too large to calculate with"
            << nl << "    Look at its coefficients: amplitudes, tables, and the"
            << " times for which they are given" << nl << exit(FatalError);
    }
    return t;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::wordList Foam::rigidMotion::keys(const dictionary& coeffs)
{
    wordList keys;
    if (coeffs.found("solidBodyMotionFunction"))
    {
        keys.append(functionKey);
        keys.append(coeffs.get<word>(functionKey) + "Coeffs");
    }
    return keys;
}


void Foam::rigidMotion::report() const
{
    forAll(functions_, i)
    {
        Info<< "Rigid motion " << functions_[i].type() << " of "
            << (
                   parts_[i].wholeMesh()
                 ? string("the mesh")
                 : Foam::name
                   (
                       returnReduce
                       (
                           parts_[i].pointLabels().size(), sumOp<label>()
                       )
                   )
                 + " points"
               ).c_str()
            << ", by " << entry_
            << (alone_ ? "; pointDisplacement is not read" : "") << endl;
    }
}


Foam::tmp<Foam::pointField> Foam::rigidMotion::moved
(
    const pointField& points0,
    const pointField& present
) const
{
    if (wholeMesh())
    {
        return transformPoints(transformation(0), points0);
    }
    auto points = tmp<pointField>::New(present);
    forAll(functions_, i)
    {
        const labelList& labels = parts_[i].pointLabels();
        UIndirectList<point>(points.ref(), labels) = transformPoints
        (
            transformation(i), pointField(points0, labels)
        )();
    }
    return points;
}


// ************************************************************************* //
