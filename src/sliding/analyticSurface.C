/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
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
