/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphVersion.H"
#include "argList.H"
#include "IOstreams.H"

#include <cstring>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

const char* Foam::morphVersion::number()
{
    return MORPHFOAM_VERSION;
}


void Foam::morphVersion::announce()
{
    // Of the process, not of a mesh: regions share a log
    static bool told = false;
    if (!told)
    {
        told = true;
        Info<< "morphFoam " << number() << endl;
    }
}


bool Foam::morphVersion::asked(int argc, char** argv)
{
    argList::addBoolOption("version", "Print the version of morphFoam");
    for (int i = 1; i < argc; ++i)
    {
        if (std::strcmp(argv[i], "-version") == 0)
        {
            announce();
            return true;
        }
    }
    return false;
}


// ************************************************************************* //
