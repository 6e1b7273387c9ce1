/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "caseSelection.H"
#include "argList.H"
#include "faceIOList.H"
#include "finiteNumbers.H"
#include "plainText.H"
#include "polyMesh.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The times that have a folder, for messages
static wordList timeNames(const Time& runTime)
{
    DynamicList<word> names;
    for (const instant& time : runTime.times())
    {
        if (time.name() != runTime.constant())
        {
            names.append(time.name());
        }
    }
    return wordList(names);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Functions  * * * * * * * * * * * * * * * //

void Foam::caseSelection::selectTime(const argList& args, Time& runTime)
{
    word name;
    if (!args.readIfPresent("time", name))
    {
        return;
    }

    const untrapped numbers;
    scalar value;
    if (!readScalar(name, value) || !finiteNumbers::usable(value))
    {
        FatalErrorInFunction
            << "The option -time is '" << name << "', which is not a number."
            << " The times of this case are "
            << plainText::listed(timeNames(runTime)).c_str()
            << "; give one time, for example"
            << " -time 0" << exit(FatalError);
    }

    const instantList times(runTime.times());
    const label index = Time::findClosestTimeIndex(times, value, "constant");
    const bool found =
        index >= 0
     && mag(times[index].value() - value) <= 10*SMALL*mag(value);

    if (returnReduce(found, andOp<bool>()))
    {
        runTime.setTime(times[index], 0);
        return;
    }

    runTime.setTime(value, 0);
    Info<< "Time " << runTime.timeName() << " has no folder; those of the case"
        << " are " << plainText::listed(timeNames(runTime)).c_str() << '.' << nl
        << "The mesh is that of the preceding time. A motion solver that reads"
        << " a field at this time will stop." << nl << endl;
}


void Foam::caseSelection::checkRegion(const Time& runTime, const word& regionName)
{
    // Looking for a file reads its head, where any number may be
    const untrapped numbers;
    const fileName local
    (
        regionName == polyMesh::defaultRegion ? word::null : regionName
    );
    const fileName meshDir(local/polyMesh::meshSubDir);

    IOobject io
    (
        "faces",
        runTime.findInstance(meshDir, "faces", IOobject::READ_IF_PRESENT),
        meshDir,
        runTime
    );
    const bool found = io.typeHeaderOk<faceIOList>(false);
    if (!returnReduce(found, andOp<bool>()))
    {
        FatalErrorInFunction
            << "There is no mesh in " << runTime.constant()/meshDir
            << " of case " << runTime.caseName()
            << ": no file faces that can be read. Make the"
            << " mesh, or give the region (-region), the case (-case) or, for a decomposed case,"
            << " -parallel" << exit(FatalError);
    }
}


// ************************************************************************* //
