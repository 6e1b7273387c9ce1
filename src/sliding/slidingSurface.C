/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "slidingSurface.H"
#include "analyticSurface.H"
#include "cylinderSurface.H"
#include "plainText.H"
#include "surfaceFile.H"
#include "Time.H"
#include "triangulatedSurface.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static autoPtr<slidingSurface> fromFile
(
    const entry& e,
    const dictionary& dict,
    const polyMesh& mesh,
    const scalar featureAngle
)
{
    const fileName name(dict.get<fileName>(e.keyword()));
    const fileName path(mesh.time().globalPath()/"constant"/"triSurface"/name);
    if (!isFile(path))
    {
        const fileNameList there(readDir(path.path(), fileName::FILE));
        FatalIOErrorInFunction(dict)
            << "Entry '" << e.keyword() << "': there is no surface " << path
            << nl << "    Files in constant/triSurface: "
            << plainText::listed(there).c_str()
            << nl << exit(FatalIOError);
    }
    string wrong;
    const autoPtr<triSurface> surface(surfaceFile::read(path, wrong));
    if (!wrong.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << e.keyword() << "': " << wrong.c_str() << nl
            << "    Repair the file" << nl << exit(FatalIOError);
    }
    return autoPtr<slidingSurface>
    (
        new triangulatedSurface(surface(), featureAngle)
    );
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::slidingSurface> Foam::slidingSurface::New
(
    const entry& e,
    const dictionary& dict,
    const polyMesh& mesh,
    const scalar featureAngle
)
{
    if (!e.isDict())
    {
        return fromFile(e, dict, mesh, featureAngle);
    }

    const word type(e.dict().get<word>("type"));
    return autoPtr<slidingSurface>
    (
        type == cylinderSurface::searchableType
      ? static_cast<slidingSurface*>(new cylinderSurface(e.dict()))
      : new analyticSurface(type, e.dict(), mesh)
    );
}


// ************************************************************************* //
