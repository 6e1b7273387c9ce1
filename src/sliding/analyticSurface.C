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

#include "analyticSurface.H"
#include "Time.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::analyticSurface::analyticSurface
(
    const word& type,
    const dictionary& dict,
    const polyMesh& mesh
)
:
    surface_
    (
        searchableSurface::New
        (
            type,
            IOobject
            (
                dict.dictName(),
                mesh.time().constant(),
                "triSurface",
                mesh.time(),
                IOobject::MUST_READ,
                IOobject::NO_WRITE,
                false
            ),
            dict
        )
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::slidingSurface::contact Foam::analyticSurface::nearest
(
    const point& x
) const
{
    List<pointIndexHit> hits;
    vectorField normals;
    surface_->findNearest(pointField(1, x), scalarField(1, sqr(GREAT)), hits);
    surface_->getNormal(hits, normals);
    return {hits[0].rawPoint(), normals[0]/max(mag(normals[0]), VSMALL), false};
}


// ************************************************************************* //
