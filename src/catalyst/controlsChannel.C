/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
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
