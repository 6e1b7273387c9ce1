/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "catalystFunctionObject.H"
#include "addToRunTimeSelectionTable.H"
#include "OSspecific.H"
#include "sigFpe.H"
#include "stringOps.H"

#include "vtkCPInputDataDescription.h"
#include "vtkCPPythonPipeline.h"
#include "vtkMultiProcessController.h"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(catalyst, 0);
    addToRunTimeSelectionTable(functionObject, catalyst, dictionary);
}
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::catalyst::catalyst
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    timeFunctionObject(name, runTime)
{
    read(dict);
}


Foam::functionObjects::catalyst::~catalyst()
{
    finalise();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::functionObjects::catalyst::readScripts(const dictionary& dict)
{
    // Python libraries raise harmless floating-point exceptions; suspend
    // trapping
    const sigFpe::ignore ignoring;

    processor_ = vtkSmartPointer<vtkCPProcessor>::New();
    processor_->Initialize(outputDir_.c_str());
    for (fileName script : dict.get<List<string>>("scripts"))
    {
        stringOps::inplaceExpand(script, dict, true, true);
        const bool there = isFile(script);
        if (!returnReduce(there, andOp<bool>()))
        {
            WarningInFunction
                << name() << ": there is no script " << script
                << ". The simulation goes on without it" << endl;
            continue;
        }
        const auto pipeline =
            vtkCPPythonPipeline::CreateAndInitializePipeline(script.c_str());
        if (!returnReduce(bool(pipeline), andOp<bool>()))
        {
            WarningInFunction
                << name() << ": ParaView does not accept the script " << script
                << ". The simulation goes on without it" << endl;
            continue;
        }
        processor_->AddPipeline(pipeline);
    }
}


void Foam::functionObjects::catalyst::describe
(
    vtkCPDataDescription* description
)
{
    for (catalystChannel& channel : channels_)
    {
        vtkCPInputDataDescription* input =
            description->GetInputDescriptionByName(channel.name().c_str());
        const bool wanted = input->GetIfGridIsNecessary();
        if (returnReduce(wanted, orOp<bool>()))
        {
            input->SetGrid(channel.data());
        }
    }
}


void Foam::functionObjects::catalyst::finalise()
{
    if (processor_)
    {
        const sigFpe::ignore ignoring;
        processor_->Finalize();
        processor_ = nullptr;
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::catalyst::read(const dictionary& dict)
{
    functionObject::read(dict);

    channels_.clear();
    for (const entry& e : dict.subDict("inputs"))
    {
        if (!e.isDict())
        {
            FatalIOErrorInFunction(dict)
                << "Entry '" << e.keyword() << "' of 'inputs' has to be a"
                << " dictionary: <channel> { fields (...); }" << nl
                << exit(FatalIOError);
        }
        channels_.append
        (
            catalystChannel::New(e.keyword(), e.dict(), time_).ptr()
        );
    }
    if (channels_.empty())
    {
        FatalIOErrorInFunction(dict)
            << "'inputs' names no channel: the scripts would receive nothing"
            << nl << "    Add one, for example region { fields (p U); }" << nl
            << exit(FatalIOError);
    }

    outputDir_ = dict.getOrDefault<fileName>
    (
        "outputDir", time_.globalPath()/"postProcessing"/name()
    );
    outputDir_.expand();
    if (Pstream::master())
    {
        mkDir(outputDir_);
    }
    finalise();
    readScripts(dict);
    return true;
}


bool Foam::functionObjects::catalyst::execute()
{
    if (processor_->GetNumberOfPipelines() == 0)
    {
        return true;
    }

    const sigFpe::ignore ignoring;
    auto description = vtkSmartPointer<vtkCPDataDescription>::New();
    description->SetTimeData(time_.value(), time_.timeIndex());
    for (const catalystChannel& channel : channels_)
    {
        description->AddInput(channel.name().c_str());
    }

    const bool wanted = processor_->RequestDataDescription(description);
    if (returnReduce(wanted, orOp<bool>()))
    {
        describe(description);
        const bool done = processor_->CoProcess(description);
        if (!returnReduce(done, andOp<bool>()))
        {
            WarningInFunction
                << name() << ": a script failed at time " << time_.timeName()
                << " (what Python said is above). The simulation goes on"
                << endl;
        }
    }
    return true;
}


bool Foam::functionObjects::catalyst::write()
{
    return true;
}


bool Foam::functionObjects::catalyst::end()
{
    finalise();
    return true;
}


void Foam::functionObjects::catalyst::movePoints(const polyMesh& mesh)
{
    for (catalystChannel& channel : channels_)
    {
        channel.movePoints(mesh);
    }
}


void Foam::functionObjects::catalyst::updateMesh(const mapPolyMesh& map)
{
    for (catalystChannel& channel : channels_)
    {
        channel.updateMesh(map);
    }
}


// ************************************************************************* //
