/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "referencePoints.H"
#include "dictionaryChecks.H"
#include "finiteNumbers.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "throwing.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace referencePoints
{

static const char* const remedy =
    "    Restore it. Where the mesh has not moved yet, remove it: the points"
    " are the reference then";


//- A file that is there but no file of points is not the same as none
static string faultOfFile(const polyMesh& mesh, const fileName& instance)
{
    IOobject io
    (
        "points0",
        instance,
        polyMesh::meshSubDir,
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
    const untrapped numbers;
    const fileName path(io.objectPath());
    return
        exists(path) && !io.typeHeaderOk<pointIOField>(true)
      ? path + " is there, but is no file of points (class vectorField)"
      : string();
}


//- What is wrong with them; every rank looks at its own
static string faultOf(const polyMesh& mesh, const pointIOField& points0)
{
    OStringStream fault;
    const fileName path(points0.objectPath());
    if (points0.size() != mesh.nPoints())
    {
        fault
            << path.c_str() << " has " << points0.size() << " points, but the"
            << " mesh has " << mesh.nPoints();
        return fault.str();
    }
    forAll(points0, i)
    {
        if (!finiteNumbers::usable(points0[i]))
        {
            fault
                << path.c_str() << ": point " << i << " is at " << points0[i]
                << ", which is no position";
            return fault.str();
        }
    }
    if (points0.size() && boundBox(points0, false).mag() < finiteNumbers::least)
    {
        fault
            << path.c_str() << ": all " << points0.size() << " points are at "
            << points0[0] << ", to within " << finiteNumbers::least << " m";
    }
    return fault.str();
}

} // End namespace referencePoints
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::referencePoints::checkFile
(
    const polyMesh& mesh,
    const fileName& instance
)
{
    const string fault(faultOfFile(mesh, instance));
    dictionaryChecks::stopIf
    (
        polyMesh::meshSubDir,
        fault.empty() ? fault : string(fault + '\n' + remedy)
    );
}


Foam::referencePoints::referenceFile Foam::referencePoints::find
(
    const polyMesh& mesh
)
{
    // Looking for a file reads its head, where any number may be
    const untrapped numbers;
    const fileName instance
    (
        mesh.time().findInstance
        (
            mesh.meshDir(), "points0", IOobject::READ_IF_PRESENT
        )
    );
    checkFile(mesh, instance);
    IOobject file
    (
        "points0",
        instance,
        polyMesh::meshSubDir,
        mesh,
        IOobject::MUST_READ,
        IOobject::NO_WRITE,
        false
    );
    const bool found = file.typeHeaderOk<pointIOField>(true);
    return {file, returnReduce(found, andOp<bool>())};
}



Foam::autoPtr<Foam::pointIOField> Foam::referencePoints::read
(
    const polyMesh& mesh,
    IOobject (*points0IO)(const polyMesh&)
)
{
    const untrapped numbers;
    const fileName folder(polyMesh::meshSubDir);
    autoPtr<pointIOField> points0(nullptr);
    string fault;
    try
    {
        const throwing errors;
        const IOobject io(points0IO(mesh));
        fault = faultOfFile(mesh, io.instance());
        if (fault.empty())
        {
            points0.reset(new pointIOField(io));
            fault = faultOf(mesh, points0());
        }
    }
    catch (const Foam::error& wrong)
    {
        fault =
            mesh.meshDir() + "/points0 cannot be read: " + said(wrong);
    }
    catch (const std::exception&)
    {
        fault = mesh.meshDir() + "/points0: its number of points is wrong";
    }
    dictionaryChecks::stopIf
    (
        folder, fault.empty() ? fault : string(fault + '\n' + remedy)
    );
    return points0;
}


// ************************************************************************* //
