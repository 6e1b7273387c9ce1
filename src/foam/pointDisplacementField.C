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

#include "pointDisplacementField.H"
#include "foamCompat.H"
#include "localIOdictionary.H"

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::IOobject Foam::pointDisplacementField::io(const polyMesh& mesh)
{
    return IOobject
    (
        "pointDisplacement",
        mesh.time().timeName(),
        mesh,
        IOobject::NO_READ,
        IOobject::AUTO_WRITE,
        false
    );
}


void Foam::pointDisplacementField::registerAndRead
(
    pointVectorField& pointDisplacement
)
{
    foamCompat::registerObject(pointDisplacement);

    IOobject file(io(pointDisplacement.mesh()()));
    file.readOpt() = IOobject::MUST_READ;
    if (!file.typeHeaderOk<pointVectorField>(true))
    {
        return;
    }

    // Into the field that is there: some conditions cannot be copied before
    // they were evaluated, for example solidBodyMotionDisplacement
    const localIOdictionary dict(file, pointVectorField::typeName);
    auto& internal = pointDisplacement.ref();
    internal.readField(dict, "internalField");
    pointDisplacement.boundaryFieldRef().readField
    (
        internal, dict.subDict("boundaryField")
    );
}


// ************************************************************************* //
