/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "movedPart.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::movedPart::movedPart(const polyMesh& mesh)
:
    mesh_(mesh),
    points_(mesh.nPoints(), false)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::movedPart::make()
{
    boolList moved(mesh_.nCells(), false);
    forAll(mesh_.faces(), facei)
    {
        bool moves = false;
        for (const label pointi : mesh_.faces()[facei])
        {
            moves = moves || points_[pointi];
        }
        if (moves)
        {
            moved[mesh_.faceOwner()[facei]] = true;
            if (mesh_.isInternalFace(facei))
            {
                moved[mesh_.faceNeighbour()[facei]] = true;
            }
        }
    }

    cells_ = findIndices(moved, true);
    labelList place(mesh_.nCells(), -1);
    forAll(cells_, i)
    {
        place[cells_[i]] = i;
    }

    DynamicList<label> faces;
    DynamicList<label> owner;
    DynamicList<label> neighbour;
    forAll(mesh_.faces(), facei)
    {
        const label own = place[mesh_.faceOwner()[facei]];
        const label nei =
            mesh_.isInternalFace(facei)
          ? place[mesh_.faceNeighbour()[facei]]
          : -1;
        if (own >= 0 || nei >= 0)
        {
            faces.append(facei);
            owner.append(own);
            neighbour.append(nei);
        }
    }
    faces_.transfer(faces);
    owner_.transfer(owner);
    neighbour_.transfer(neighbour);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::movedPart::update(const vectorField& displacement)
{
    bool more = false;
    forAll(displacement, pointi)
    {
        // What is not a number moves
        const vector& d = displacement[pointi];
        const bool rests = d.x() == 0 && d.y() == 0 && d.z() == 0;
        if (!rests && !points_[pointi])
        {
            points_[pointi] = true;
            more = true;
        }
    }
    if (more)
    {
        make();
    }
}


// ************************************************************************* //
