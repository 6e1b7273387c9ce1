/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshOutput.H"
#include "displacementMotionSolver.H"
#include "fvMesh.H"
#include "pointIOField.H"
#include "referencePoints.H"
#include "untrapped.H"
#include "wholeFile.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static void write(const regIOobject& object)
{
    wholeFile::writeObject(object);
    Info<< "Wrote "
        << (object.instance()/object.db().dbDir()/object.local()/object.name())
            .c_str()
        << endl;
}


static pointIOField pointsFile
(
    const word& name,
    const fileName& instance,
    const fvMesh& mesh,
    const IOobject::readOption readOpt
)
{
    return pointIOField
    (
        IOobject
        (
            name,
            instance,
            polyMesh::meshSubDir,
            mesh,
            readOpt,
            IOobject::NO_WRITE,
            false
        )
    );
}


//- Keep constant/polyMesh/points as points0, unless there is one already
static void keepReference(const fvMesh& mesh)
{
    const fileName& constant = mesh.time().constant();
    referencePoints::checkFile(mesh, constant);

    IOobject io
    (
        "points0",
        constant,
        polyMesh::meshSubDir,
        mesh
    );

    const untrapped numbers;
    const bool found = io.typeHeaderOk<pointIOField>(true);
    if (returnReduce(found, andOp<bool>()))
    {
        const pointIOField points0
        (
            pointsFile("points0", constant, mesh, IOobject::MUST_READ)
        );
        const bool fits = points0.size() == mesh.nPoints();
        if (!returnReduce(fits, andOp<bool>()))
        {
            FatalErrorInFunction
                << "There are " << points0.size() << " points in "
                << mesh.time().relativePath(io.objectPath())
                << " and " << mesh.nPoints() << " in the mesh: it is left"
                << " from another mesh. Remove it" << exit(FatalError);
        }
        Info<< "Kept the points0 there is" << endl;
        return;
    }

    pointIOField points0
    (
        pointsFile("points", constant, mesh, IOobject::MUST_READ)
    );
    points0.rename("points0");
    write(points0);
}


static void writePoints
(
    const fvMesh& mesh,
    const pointField& newPoints,
    const bool overwrite
)
{
    if (overwrite)
    {
        keepReference(mesh);
    }

    const fileName instance
    (
        overwrite ? mesh.time().constant() : mesh.time().timeName()
    );
    pointIOField points
    (
        pointsFile("points", instance, mesh, IOobject::NO_READ)
    );
    points = newPoints;
    write(points);

    if (overwrite && mesh.pointsInstance() != mesh.time().constant())
    {
        WarningInFunction
            << "The mesh at time " << mesh.time().timeName()
            << " has points of its own in " << mesh.pointsInstance()
            << ": they hide what was written to constant. Remove them to use"
            << " the new mesh" << endl;
    }
}


//- The displacements that a motion from this time starts with
static void writeDisplacement(const PtrList<motionSolver>& solvers)
{
    for (const motionSolver& solver : solvers)
    {
        const auto* displacement = isA<displacementMotionSolver>(solver);

        if (displacement)
        {
            const pointVectorField& field =
                const_cast<displacementMotionSolver*>(displacement)
              ->pointDisplacement();

            IOobject io(field, field.name());
            const untrapped numbers;
            const bool found = io.typeHeaderOk<pointVectorField>(true);

            // One that the solver made up itself is no input of the case
            if (returnReduce(found, andOp<bool>()))
            {
                write(field);
            }
        }
    }
}


//- A table in the folder of figures, on the master
template<class WriteTable>
static void writeTable
(
    const fvMesh& mesh,
    const word& name,
    const WriteTable& table
)
{
    const fileName file(morphMeshOutput::folder(mesh)/name);
    if (Pstream::master())
    {
        wholeFile::writeOrStop(mesh.time().globalPath()/file, table);
    }
    Info<< "Wrote " << file.c_str() << endl;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Functions  * * * * * * * * * * * * * * * //

Foam::fileName Foam::morphMeshOutput::folder(const fvMesh& mesh)
{
    fileName dir("postProcessing");
    if (mesh.name() != polyMesh::defaultRegion)
    {
        dir = dir/mesh.name();
    }
    return dir/"morphMesh"/mesh.time().timeName();
}


void Foam::morphMeshOutput::writeMesh
(
    const fvMesh& mesh,
    const pointField& newPoints,
    const PtrList<motionSolver>& solvers,
    const bool overwrite
)
{
    // Fewer digits round the points, which can fold the flat cells of a
    // boundary layer: with these the file has the very points that were checked
    const unsigned int digits = IOstream::defaultPrecision();
    IOstream::defaultPrecision
    (
        max(digits, unsigned(std::numeric_limits<scalar>::max_digits10))
    );

    if (mesh.time().writeFormat() == IOstream::ASCII)
    {
        Info<< "Points are written with " << IOstream::defaultPrecision()
            << " digits" << endl;
    }

    writePoints(mesh, newPoints, overwrite);
    if (!overwrite)
    {
        writeDisplacement(solvers);
    }

    IOstream::defaultPrecision(digits);
}


void Foam::morphMeshOutput::writeQuality
(
    const fvMesh& mesh,
    const meshQuality& before,
    const meshQuality& after
)
{
    // More than the log has, for programs that compare designs
    const int digits = 6;
    writeTable(mesh, "quality.dat", [&](Ostream& os)
    {
        meshQuality::writeHeader(os);
        before.writeRow(os, "before", digits);
        after.writeRow(os, "after", digits);
    });
    writeTable(mesh, "histogram.dat", [&](Ostream& os)
    {
        meshQuality::writeHistograms(os, before, after);
    });
}


// ************************************************************************* //
