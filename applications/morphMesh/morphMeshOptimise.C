/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshOptimise.H"
#include "dictionaryChecks.H"
#include "fvMesh.H"
#include "IOdictionary.H"
#include "meshOptimiser.H"
#include "pointIOField.H"
#include "referencePoints.H"
#include "Time.H"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The dictionary system/optimiseDict; empty if there is none
static IOdictionary readDict(const fvMesh& mesh)
{
    const untrapped numbers;
    const IOobject io
    (
        "optimiseDict",
        mesh.time().system(),
        mesh,
        IOobject::READ_IF_PRESENT,
        IOobject::NO_WRITE,
        false
    );
    IOdictionary dict(io);
    dictionaryChecks::restoreNames(dict, dict.objectPath());
    dictionaryChecks::checkNumbers(dict);
    return dict;
}


//- points0 of the mesh, or null
static autoPtr<pointIOField> reference(const fvMesh& mesh)
{
    const untrapped numbers;
    const referencePoints::referenceFile reference
    (
        referencePoints::find(mesh)
    );
    if (!reference.found)
    {
        return autoPtr<pointIOField>(nullptr);
    }
    autoPtr<pointIOField> points0(new pointIOField(reference.file));
    const string fault
    (
        points0->size() == mesh.nPoints()
      ? string()
      : string
        (
            "points0 is of another mesh: it has "
          + Foam::name(points0->size()) + " points, the mesh "
          + Foam::name(mesh.nPoints()) + "\n    Remove it"
        )
    );
    dictionaryChecks::stopIf(points0->objectPath(), fault);
    return points0;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Functions  * * * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::morphMeshOptimise::points
(
    const fvMesh& mesh,
    const pointField& given,
    const bool moved
)
{
    const IOdictionary dict(readDict(mesh));
    optimiseSettings settings(optimiseSettings::read(dict));
    if (!dict.found("when"))
    {
        settings.when = optimiseSettings::trigger::always;
    }

    // Cells of a mesh that has not moved have their own shape: no target
    const autoPtr<pointIOField> points0(reference(mesh));
    if (!moved && !points0.valid())
    {
        if (dict.found("target") && settings.target == morph::SimplexTarget::reference)
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'target' is reference, but there is no points0: the"
                << " mesh would be its own reference" << nl
                << "    Use 'target orthogonal', or keep the points of the mesh"
                << " before it was moved as points0" << nl
                << exit(FatalIOError);
        }
        settings.target = morph::SimplexTarget::orthogonal;
        Info<< "optimise: there is no points0, the target are orthogonal cells"
            << endl;
    }
    const pointField& target = points0.valid() ? points0() : mesh.points();

    const reducedMesh reduced(mesh, given);
    const pointFreedom freedom(mesh, given, reduced);
    const meshOptimiser optimiser(mesh, settings, target, reduced);
    vectorField inPlane(given.size(), Zero);
    if (optimiser.improve(freedom, given, inPlane))
    {
        return tmp<pointField>::New(given + reduced.expand(inPlane));
    }
    return tmp<pointField>::New(given);
}


// ************************************************************************* //
