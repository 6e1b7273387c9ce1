/*---------------------------------------------------------------------------*\
License
    This file is part of morphFoam.

    morphFoam is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by
    the Free Software Foundation, either version 3 of the License, or
    (at your option) any later version.

    morphFoam is distributed in the hope that it will be useful, but WITHOUT
    ANY WARRANTY; without even the implied warranty of MERCHANTABILITY or
    FITNESS FOR A PARTICULAR PURPOSE.  See the GNU General Public License
    for more details.

    You should have received a copy of the GNU General Public License
    along with morphFoam.  If not, see <http://www.gnu.org/licenses/>.

\*---------------------------------------------------------------------------*/

#include "slidingSurface.H"
#include "analyticSurface.H"
#include "cylinderSurface.H"
#include "triangulatedSurface.H"
#include "Time.H"
#include "triSurface.H"

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
            << nl << "    Files in constant/triSurface: " << flatOutput(there)
            << nl << exit(FatalIOError);
    }
    triSurface surface(path);
    if (surface.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << e.keyword() << "': " << path
            << " has no triangles" << nl << exit(FatalIOError);
    }
    return autoPtr<slidingSurface>
    (
        new triangulatedSurface(surface, featureAngle)
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
