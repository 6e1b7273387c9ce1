/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionRecord.H"
#include "validFraction.H"
#include "Time.H"
#include "wholeFile.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(motionRecord, 0);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionRecord::motionRecord
(
    const polyMesh& mesh,
    const fileName& folder,
    const bool reports
)
:
    IOdictionary
    (
        IOobject
        (
            typeName,
            mesh.time().timeName(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE
        )
    ),
    folder_(folder),
    reports_(reports)
{
    set("attainable", 1);
    set("moved", 1);
    set("stoppedBy", validFraction::criterionNames[validFraction::criterion::none]);
    set("subSteps", 1);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::motionRecord* Foam::motionRecord::of(const polyMesh& mesh)
{
    return mesh.thisDb().getObjectPtr<motionRecord>(typeName);
}


Foam::fileName Foam::motionRecord::folder(const polyMesh& mesh)
{
    const motionRecord* record = of(mesh);
    if (record)
    {
        return record->folder_;
    }

    fileName folder("postProcessing");
    if (mesh.name() != polyMesh::defaultRegion)
    {
        folder = folder/mesh.name();
    }
    return folder/"invalidMotion"/mesh.time().timeName();
}


bool Foam::motionRecord::reports(const polyMesh& mesh)
{
    const motionRecord* record = of(mesh);
    return !record || record->reports_;
}


void Foam::motionRecord::note
(
    const validFraction& fraction,
    const scalar attainable,
    const scalar moved,
    const label nSteps
)
{
    set("attainable", attainable);
    set("moved", moved);
    set("subSteps", nSteps);
    set("stoppedBy", validFraction::criterionNames[fraction.stoppedBy()]);
    if (fraction.stoppedBy() != validFraction::criterion::none)
    {
        set("where", fraction.where());
    }
}


void Foam::motionRecord::writeReport() const
{
    if (!reports_)
    {
        return;
    }
    if (Pstream::master())
    {
        wholeFile::writeOrStop
        (
            time().globalPath()/folder_/"motion",
            [&](Ostream& os)
            {
                os.precision(17);
                IOobject header(*this, "motion");
                header.writeHeader(os, dictionary::typeName);
                dictionary::write(os, false);
                IOobject::writeEndDivider(os);
            }
        );
    }
    Info<< "Wrote " << (folder_/"motion").c_str() << endl;
    returnReduce(true, andOp<bool>());
}


// ************************************************************************* //
