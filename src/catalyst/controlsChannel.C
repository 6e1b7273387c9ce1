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

#include "controlsChannel.H"
#include "controlGeometry.H"
#include "dictionaryChecks.H"
#include "vtkConversion.H"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::controlsChannel::controlsChannel
(
    const word& name,
    const dictionary& dict,
    const Time& time
)
:
    catalystChannel(name, dict, time)
{
    dictionaryChecks::onlyKeys(dict, {"type", "region"});
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

vtkSmartPointer<vtkMultiBlockDataSet> Foam::controlsChannel::data()
{
    auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
    if (mesh())
    {
        unsigned block = 0;
        for (const controlShape& s : controlGeometry::shapesOf(*mesh()))
        {
            blocks->SetBlock(block, vtkConversion::shape(s));
            blocks->GetMetaData(block)->Set
            (
                vtkCompositeDataSet::NAME(), s.name.c_str()
            );
            ++block;
        }
    }
    return blocks;
}


// ************************************************************************* //
