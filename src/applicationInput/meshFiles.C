/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "meshFiles.H"
#include "dictionaryChecks.H"
#include "finiteNumbers.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "throwing.H"
#include "Time.H"
#include "untrapped.H"

#include <csignal>
#include <cstring>
#include <fstream>
#include <unistd.h>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace meshFiles
{

static char lastWords[2048];

// Only what a signal handler may call
static void onSignal(int)
{
    if (::write(STDERR_FILENO, lastWords, std::strlen(lastWords)) < 0)
    {
        ::_exit(2);
    }
    ::_exit(1);
}


//- While one lives a signal ends the program with this message
class lastMessage
{
    static const int n = 4;
    const int signals_[n] = {SIGSEGV, SIGFPE, SIGABRT, SIGBUS};
    struct sigaction former_[n];

public:

    explicit lastMessage(const string& text)
    {
        std::strncpy(lastWords, text.c_str(), sizeof(lastWords) - 1);
        struct sigaction mine;
        std::memset(&mine, 0, sizeof(mine));
        mine.sa_handler = onSignal;
        for (int i = 0; i < n; ++i)
        {
            ::sigaction(signals_[i], &mine, &former_[i]);
        }
    }

    ~lastMessage()
    {
        for (int i = 0; i < n; ++i)
        {
            ::sigaction(signals_[i], &former_[i], nullptr);
        }
    }
};


//- The largest number before a bracket of a text
static scalar longestList(const fileName& path)
{
    std::ifstream is(path);
    scalar longest = 0;
    scalar number = 0;
    bool digits = false;
    for (char c; is.get(c);)
    {
        if (c >= '0' && c <= '9')
        {
            number = min(10*(digits ? number : 0) + (c - '0'), GREAT);
            digits = true;
        }
        else if (c == '(' || c == '{')
        {
            longest = digits ? max(longest, number) : longest;
            digits = false;
        }
        else if (c != ' ' && c != '\n')
        {
            digits = false;
        }
    }
    return longest;
}


//- A list that claims more entries than its file has bytes, found before any of
//  them is allocated
static string faultOfSizes(const Time& runTime, const fileName& folder)
{
    for
    (
        const char* file
      : {
            "points", "faces", "owner", "neighbour", "boundary", "pointZones",
            "faceZones", "cellZones"
        }
    )
    {
        IOobject io
        (
            file,
            runTime.findInstance(folder, file, IOobject::READ_IF_PRESENT),
            folder,
            runTime
        );
        const fileName path(io.objectPath());
        if (!isFile(path, false))
        {
            continue;
        }
        string fault;
        try
        {
            const throwing errors;
            IFstream is(path);
            const bool header = io.readHeader(is);
            const token first(is);
            if (!header)
            {
                fault = "it has no header of OpenFOAM";
            }
            else if
            (
                first.isLabel()
             && (
                    first.labelToken() < 0
                 || first.labelToken() > fileSize(path)
                )
            )
            {
                fault =
                    "it cannot have " + Foam::name(first.labelToken())
                  + " entries";
            }
            else if
            (
                fileName(file).ends_with("Zones")
             && is.format() == IOstream::ASCII
             && longestList(path) > scalar(fileSize(path))
            )
            {
                fault = "a zone has more labels than the file has letters";
            }
        }
        catch (const Foam::error& wrong)
        {
            fault = said(wrong);
        }
        if (!fault.empty())
        {
            return path + ": " + fault;
        }
    }
    return string();
}


static string faultOfPoints(const polyMesh& mesh)
{
    OStringStream fault;
    const pointField& x = mesh.points();
    forAll(x, i)
    {
        if (!finiteNumbers::usable(x[i]))
        {
            fault<< "points: point " << i << " is at " << x[i];
            return fault.str();
        }
    }
    return string();
}


static string faultOfFaces(const polyMesh& mesh)
{
    OStringStream fault;
    forAll(mesh.faces(), i)
    {
        const face& f = mesh.faces()[i];
        if (f.size() < 3)
        {
            fault<< "faces: face " << i << " has " << f.size() << " points";
            return fault.str();
        }
        for (const label pointi : f)
        {
            if (pointi < 0 || pointi >= mesh.nPoints())
            {
                fault
                    << "faces: face " << i << " has point " << pointi
                    << ", but there are " << mesh.nPoints();
                return fault.str();
            }
        }
    }
    return string();
}


static string faultOfCells(const polyMesh& mesh)
{
    OStringStream fault;
    const labelList& owner = mesh.faceOwner();
    const labelList& neighbour = mesh.faceNeighbour();
    if (owner.size() != mesh.nFaces() || neighbour.size() > mesh.nFaces())
    {
        fault
            << "owner, neighbour: they have " << owner.size() << " and "
            << neighbour.size() << " labels for " << mesh.nFaces() << " faces";
        return fault.str();
    }
    labelList nFaces(mesh.nCells(), 0);
    forAll(owner, i)
    {
        const label other = i < neighbour.size() ? neighbour[i] : owner[i];
        for (const label celli : {owner[i], other})
        {
            if (celli < 0 || celli >= mesh.nCells())
            {
                fault
                    << "owner, neighbour: face " << i << " belongs to cell "
                    << celli << ", but there are " << mesh.nCells();
                return fault.str();
            }
        }
        ++nFaces[owner[i]];
        if (i < neighbour.size())
        {
            ++nFaces[other];
        }
    }
    forAll(nFaces, celli)
    {
        if (nFaces[celli] < 4)
        {
            fault
                << "owner, neighbour: cell " << celli << " has "
                << nFaces[celli] << " faces";
            return fault.str();
        }
    }
    return string();
}


static string faultOfBoundary(const polyMesh& mesh)
{
    label start = mesh.nInternalFaces();
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (patch.start() != start || patch.size() < 0)
        {
            return
                "boundary: patch " + patch.name() + " starts at face "
              + Foam::name(patch.start()) + ", but the one before ends at "
              + Foam::name(start);
        }
        start += patch.size();
    }
    return
        start == mesh.nFaces()
      ? string()
      : string
        (
            "boundary: its patches end at face " + Foam::name(start)
          + " of " + Foam::name(mesh.nFaces())
        );
}


static string faultOf(const polyMesh& mesh)
{
    for (const auto& look :
        {faultOfPoints, faultOfFaces, faultOfCells, faultOfBoundary})
    {
        const string fault(look(mesh));
        if (!fault.empty())
        {
            return fault;
        }
    }
    return string();
}

} // End namespace meshFiles
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::autoPtr<Foam::fvMesh> Foam::meshFiles::read
(
    const Time& runTime,
    const word& regionName
)
{
    const IOobject io
    (
        regionName,
        runTime.timeName(),
        runTime,
        IOobject::MUST_READ
    );
    const fileName local
    (
        regionName == polyMesh::defaultRegion ? word::null : regionName
    );
    const fileName folder
    (
        runTime.path()/runTime.constant()/local/polyMesh::meshSubDir
    );
    const string damaged
    (
        "a file of the mesh in " + folder + " (or of a later time) is damaged:"
        " points, faces, owner, neighbour, boundary, or a file of zones"
    );
    const string remedy("\n    Restore it, or make the mesh again");

    autoPtr<fvMesh> mesh(nullptr);
    string fault;
    {
        const untrapped numbers;
        fault = faultOfSizes(runTime, local/polyMesh::meshSubDir);
    }
    dictionaryChecks::stopIf
    (
        folder, fault.empty() ? fault : string(fault + remedy)
    );
    {
        const untrapped numbers;
        const lastMessage message
        (
            "\n--> FOAM FATAL ERROR:\n" + damaged + remedy + "\n\n"
        );
        try
        {
            mesh.reset(new fvMesh(io));
            fault = faultOf(mesh());
            if (!fault.empty())
            {
                fault = folder + ": " + fault;
            }
        }
        catch (const Foam::error& wrong)
        {
            FatalErrorInFunction
                << "The mesh cannot be read: " << said(wrong).c_str() << nl
                << "    In " << folder << " (or of a later time) a file is"
                << " damaged: restore it, or make the mesh again" << nl
                << exit(FatalError);
        }
        catch (const std::exception& wrong)
        {
            // Of memory, mostly; other ranks may wait for this one
            FatalErrorInFunction
                << "The mesh cannot be read (" << wrong.what() << "): "
                << damaged.c_str() << nl
                << "    Restore it, or make the mesh again" << nl
                << exit(FatalError);
        }
    }
    dictionaryChecks::stopIf
    (
        folder, fault.empty() ? fault : string(fault + remedy)
    );
    return mesh;
}


// ************************************************************************* //
