/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdDisplacement.H"
#include "ffdCorrection.H"
#include "ffdFit.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "points0MotionSolver.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(ffdDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        ffdDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdDisplacement::ffdDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    prescribedDisplacement(dict, mesh),
    nListed_(nListed),
    boxes_(ffdFit::fitted(dict, mesh), &mesh)
{
    wordList keys(ffdBoxes::keys());
    keys.append("type");
    dictionaryChecks::onlyKeys(dict, keys);
    if (boxes_.keeps() && mesh.nGeometricD() == 3)
    {
        boxes_.setKept
        (
            pointIOField(points0MotionSolver::points0IO(mesh)),
            ffdCorrection::faces(boxes_.keep(), mesh)
        );
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::edgeList Foam::ffdDisplacement::edgesBetween
(
    const labelList& meshPoints
) const
{
    labelList place(mesh().nPoints(), -1);
    forAll(meshPoints, i)
    {
        if (meshPoints[i] >= 0)
        {
            place[meshPoints[i]] = i;
        }
    }
    DynamicList<edge> edges;
    for (const edge& e : mesh().edges())
    {
        if (place[e.start()] >= 0 && place[e.end()] >= 0)
        {
            edges.append(edge(place[e.start()], place[e.end()]));
        }
    }
    return edgeList(std::move(edges));
}


bool Foam::ffdDisplacement::prepare(const points& p) const
{
    const bool moved = boxes_.update(mesh().time().timeOutputValue());
    const bool same = p.positions == positions_;
    if (returnReduce(same, andOp<bool>()))
    {
        return moved;
    }
    positions_ = p.positions;

    // A caller may ask for some of the listed points only; an empty box is an
    // error only if all were given
    const bool onMesh = !p.meshPoints.empty() && max(p.meshPoints) >= 0;
    const bool whole =
        returnReduce(onMesh, orOp<bool>())
     || returnReduce(p.positions.size(), sumOp<label>()) >= nListed_;
    boxes_.setPoints(p.positions, edgesBetween(p.meshPoints), whole);
    return true;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::ffdDisplacement::displacement
(
    const points& p
) const
{
    prepare(p);
    return boxes_.displacement();
}


Foam::List<Foam::motionParameter> Foam::ffdDisplacement::parameters
(
    const word& group
) const
{
    boxes_.update(mesh().time().timeOutputValue());
    return boxes_.parameterList();
}


Foam::tmp<Foam::vectorField> Foam::ffdDisplacement::derivative
(
    const points& p,
    const label parameteri
) const
{
    if (prepare(p))
    {
        boxes_.displacement();
    }
    return boxes_.derivative(parameteri);
}


// ************************************************************************* //
