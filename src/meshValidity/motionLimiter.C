/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "motionLimiter.H"
#include "dictionaryChecks.H"
#include "motionRecord.H"
#include "validFraction.H"
#include "cellSet.H"
#include "foamVtkSurfaceWriter.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "Time.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::motionLimiter::policy>
Foam::motionLimiter::policyNames
({
    { policy::error, "error" },
    { policy::limit, "limit" },
    { policy::ignore, "ignore" }
});

const char* const Foam::motionLimiter::failed =
    "Failed: the moved mesh would be invalid";


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static void writeCellSet(const polyMesh& mesh, const bitSet& cells)
{
    cellSet set(mesh, "invalidMotionCells", label(cells.count()));
    for (const label celli : cells)
    {
        set.insert(celli);
    }
    set.instance() = mesh.facesInstance();
    set.write();
    Info<< "    Wrote cellSet " << set.name() << " with "
        << plainText::counted
           (
               returnReduce(set.size(), sumOp<label>()), "cell"
           ).c_str()
        << " to "
        << set.instance()/set.local() << endl;
}


//- Write the faces of each cell separately, with their own points
static void writeCellFaces(const validFraction& fraction)
{
    const polyMesh& mesh = fraction.mesh();
    DynamicList<face> faces;
    DynamicList<scalar> attainable;
    DynamicList<label> used;
    Map<label> place;
    for (const label celli : fraction.cells())
    {
        for (const label facei : mesh.cells()[celli])
        {
            face f(mesh.faces()[facei]);
            for (label& pointi : f)
            {
                if (place.insert(pointi, used.size()))
                {
                    used.append(pointi);
                }
                pointi = place[pointi];
            }
            faces.append(f);
            attainable.append(fraction.cellFractions()[celli]);
        }
    }

    const fileName file(motionRecord::folder(mesh)/"invalidCells.vtk");
    const fileName path(mesh.time().globalPath()/file);
    if (Pstream::master())
    {
        mkDir(path.path());
    }
    const pointField points(fraction.reference(), used);
    const vectorField displacement(fraction.displacement(), used);
    const faceList list(faces);
    vtk::surfaceWriter writer
    (
        points, list, vtk::formatType::LEGACY_ASCII, path
    );
    writer.writeGeometry();
    writer.beginCellData(1);
    writer.write("attainable", attainable);
    writer.beginPointData(1);
    writer.write("displacement", displacement);
    writer.close();
    Info<< "    Wrote " << file.c_str() << endl;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::motionLimiter::motionLimiter
(
    const polyMesh& mesh,
    const dictionary& dict,
    const policy onInvalidMesh
)
:
    mesh_(mesh),
    dict_(dict),
    policy_(onInvalidMesh)
{}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::motionLimiter::refuse
(
    const validFraction& fraction,
    const part& of,
    const string& remedy
) const
{
    const scalar attainable = of.from + (of.to - of.from)*fraction.value();
    motionRecord* record = motionRecord::of(mesh_);
    if (record)
    {
        record->note(fraction, attainable, 0, of.nSteps);
        record->writeReport();
    }
    Info<< failed << endl;
    FatalIOErrorInFunction(dict_)
        << "The motion makes the mesh invalid: " << fraction.whole() << nl
        << "    It is valid up to the fraction " << attainable
        << " of it; the first cell breaks at " << fraction.where() << nl
        << "    The mesh is left as it was. " << remedy.c_str() << ';' << nl
        << "    'onInvalidMesh limit' moves the mesh as far as it goes,"
        << " 'onInvalidMesh ignore' moves it anyway" << nl
        << exit(FatalIOError);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::motionLimiter::policy Foam::motionLimiter::readPolicy
(
    const dictionary& dict
)
{
    return dictionaryChecks::getChoice
    (
        dict, "onInvalidMesh", policyNames, policy::error
    );
}


Foam::scalar Foam::motionLimiter::apply
(
    const pointField& reference,
    vectorField& displacement,
    const string& remedy
) const
{
    if
    (
        policy_ == policy::ignore
     || invalidMotion(mesh_, reference, reference + displacement).empty()
    )
    {
        return 1;
    }
    const limit found = limitPart(reference, displacement, {0, 1, 1}, remedy);
    displacement *= found.fraction;
    note(found, found.fraction);
    return found.fraction;
}


Foam::motionLimiter::limit Foam::motionLimiter::limitPart
(
    const pointField& reference,
    const vectorField& displacement,
    const part& of,
    const string& remedy
) const
{
    const validFraction fraction(mesh_, reference, displacement);
    report(fraction);
    if (policy_ == policy::error)
    {
        refuse(fraction, of, remedy);
    }

    const scalar attainable = of.from + (of.to - of.from)*fraction.value();
    const scalar moved =
        of.from > 0
      ? (1 - validFraction::margin)*attainable
      : of.to*fraction.withMargin();
    OStringStream why;
    why << "It is valid up to " << attainable
        << ", where the first cell breaks at " << fraction.where() << " ("
        << validFraction::criterionNames[fraction.stoppedBy()]
        << "); as a whole it makes " << fraction.whole();
    motionRecord* record = motionRecord::of(mesh_);
    if (record)
    {
        record->note(fraction, attainable, moved, of.nSteps);
    }
    return {moved, why.str()};
}


void Foam::motionLimiter::note(const limit& found, const scalar made) const
{
    Info<< "onInvalidMesh limit: the motion is limited to the fraction "
        << made << " of it. " << found.why.c_str() << endl;
    motionRecord* record = motionRecord::of(mesh_);
    if (record)
    {
        record->set("moved", made);
    }
}


void Foam::motionLimiter::report(const validFraction& fraction)
{
    if (motionRecord::reports(fraction.mesh()))
    {
        Info<< "What stops the motion:" << endl;
        writeCellSet(fraction.mesh(), fraction.cells());
        writeCellFaces(fraction);

        // Synchronise first: a failing rank aborts ranks that are still writing
        returnReduce(true, andOp<bool>());
    }
}


// ************************************************************************* //
