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

#include "cyclicPoints.H"
#include "cyclicPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "syncTools.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::scalar Foam::cyclicPoints::match
(
    const polyMesh& mesh,
    vectorField& displacement
)
{
    boolList isCyclic(mesh.nPoints(), false);
    bool some = false;
    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        if (isA<cyclicPolyPatch>(patch) || isA<processorCyclicPolyPatch>(patch))
        {
            some = true;
            UIndirectList<bool>(isCyclic, patch.meshPoints()) = true;
        }
    }
    if (!returnReduce(some, orOp<bool>()))
    {
        return 0;
    }
    syncTools::syncPointList(mesh, isCyclic, orEqOp<bool>(), false);

    // Mean of both sides as half of smallest plus largest: ranks that share a
    // point leave no trace in it
    const vector none = vector::uniform(GREAT);
    vectorField smallest(displacement);
    vectorField largest(displacement);
    syncTools::syncPointList(mesh, smallest, minEqOp<vector>(), none);
    syncTools::syncPointList(mesh, largest, maxEqOp<vector>(), -none);
    scalar difference = 0;
    forAll(displacement, pointi)
    {
        if (isCyclic[pointi])
        {
            displacement[pointi] = 0.5*(smallest[pointi] + largest[pointi]);
            difference = max(difference, mag(largest[pointi] - smallest[pointi]));
        }
    }
    return returnReduce(difference, maxOp<scalar>());
}


// ************************************************************************* //
