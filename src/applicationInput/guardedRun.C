/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "guardedRun.H"
#include "Pstream.H"
#include "throwing.H"

#include <csignal>
#include <new>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::guardedRun::prepare()
{
    std::signal(SIGXFSZ, SIG_IGN);
    std::set_new_handler(nullptr);
}


bool Foam::guardedRun::run
(
    const char* name,
    const std::function<bool()>& application
)
{
    try
    {
        const throwing errors;
        return application();
    }
    catch (const Foam::error& wrong)
    {
        report(wrong);
        Pstream::exit(1);
    }
    catch (const std::exception& wrong)
    {
        FatalErrorInFunction
            << name << " stops: " << wrong.what() << nl
            << "    A file asks for more memory than there is, or has contents"
            << " of another kind; the last line above says which was being"
            << " read" << nl << exit(FatalError);
    }
    return false;
}


// ************************************************************************* //
