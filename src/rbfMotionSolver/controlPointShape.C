/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "controlPointShape.H"
#include "eigenFields.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::controlShape Foam::controlPointShape()
{
    controlShape shape;
    shape.name = "controlPoints";
    shape.scalars.insert("conditions", scalarField());
    shape.scalars.insert("selected", scalarField());
    shape.scalars.insert("error", scalarField());
    shape.scalars.insert("offMesh", scalarField());
    shape.scalars.insert("region", scalarField());
    shape.vectors.insert("displacement", vectorField());
    shape.vectors.insert("weight", vectorField());
    return shape;
}


Foam::controlShape Foam::controlPointShape
(
    const rbfMotionProblem& problem,
    const std::vector<rbfMotion::selection>& selections,
    const vectorField& displacement
)
{
    controlShape shape(controlPointShape());
    scalarField& conditions = shape.scalars["conditions"];
    scalarField& selected = shape.scalars["selected"];
    scalarField& error = shape.scalars["error"];
    scalarField& offMesh = shape.scalars["offMesh"];
    scalarField& region = shape.scalars["region"];
    vectorField& moved = shape.vectors["displacement"];
    vectorField& weight = shape.vectors["weight"];
    for (const rbfMotion::selection& made : selections)
    {
        const controlCandidates& candidates =
            problem.controlPoints().candidates(made.region);
        const morph::Vectors gamma
        (
            made.last->weights
            (
                made.candidates ? *made.candidates : candidates.conditions
            )
        );
        const label start = conditions.size();
        for (label i = 0; i < candidates.size(); ++i)
        {
            const morph::ControlPoint& p = candidates.conditions[i];
            const label pointi = candidates.meshPoints[i];
            moved.append
            (
                pointi < 0 ? toFoam(p.C()*p.g()) : displacement[pointi]
            );
            shape.points.append
            (
                moved.last()
              + (pointi < 0 ? toFoam(p.position) : problem.points0()[pointi])
            );
            conditions.append(p.k);
            error.append(made.last->errors()[i]);
            offMesh.append(pointi < 0);
            region.append(made.region);
            weight.append(toFoam(gamma.row(i).transpose()));
            selected.append(0);
        }
        for (const morph::Index i : made.last->selected())
        {
            selected[start + i] = 1;
        }
    }
    return shape;
}


// ************************************************************************* //
