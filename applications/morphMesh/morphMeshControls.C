/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshControls.H"
#include "controlGeometry.H"
#include "dictionaryEntries.H"
#include "emptyPolyPatch.H"
#include "ffdFit.H"
#include "ffdMeasures.H"
#include "ffdMotionSolver.H"
#include "ffdPreview.H"
#include "foamCompat.H"
#include "fvMesh.H"
#include "motionSensitivities.H"
#include "OSspecific.H"
#include "plainText.H"
#include "pointFields.H"
#include "shapeConstraints.H"
#include "wholeFile.H"

#include <limits>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace morphMeshControls
{

static faceList facesOf(const fvMesh& mesh, const labelUList& patches)
{
    DynamicList<face> faces;
    for (const label patchi : patches)
    {
        for (const face& f : mesh.boundaryMesh()[patchi])
        {
            faces.append(f);
        }
    }
    return faceList(faces);
}


//- Those that are not there for the decomposition or for two dimensions
static labelList shownPatches(const fvMesh& mesh)
{
    DynamicList<label> shown;
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    for (label patchi = 0; patchi < boundary.nNonProcessor(); ++patchi)
    {
        if (!isA<emptyPolyPatch>(boundary[patchi]))
        {
            shown.append(patchi);
        }
    }
    return labelList(shown);
}


static labelList selectedPatches
(
    const fvMesh& mesh,
    const wordRes& names,
    const char* from
)
{
    labelHashSet selected;
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    for (const label patchi : boundary.patchSet(names, false, true))
    {
        if (patchi < boundary.nNonProcessor())
        {
            selected.insert(patchi);
        }
    }
    if (selected.empty())
    {
        wordList there(boundary.names());
        there.setSize(boundary.nNonProcessor());
        FatalErrorInFunction
            << from << ": no patch or patch group is called "
            << plainText::listed(names).c_str() << nl
            << "    Patches: " << plainText::listed(there).c_str() << nl
            << exit(FatalError);
    }
    return selected.sortedToc();
}


//- The boxes of a solver that has some, with the values of this time
static autoPtr<ffdBoxes> boxesOf(const fvMesh& mesh, const motionSolver& solver)
{
    const auto* ffd = isA<ffdMotionSolver>(solver);
    if (!ffd)
    {
        return nullptr;
    }
    autoPtr<ffdBoxes> boxes
    (
        new ffdBoxes
        (
            ffdFit::fitted(ffd->coeffDict(), mesh, ffd->points0()), &mesh
        )
    );
    boxes->setPoints(ffd->points0(), mesh.edges());
    boxes->update(mesh.time().timeOutputValue());
    return boxes;
}

} // End namespace morphMeshControls
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::morphMeshControls::write
(
    const fvMesh& mesh,
    const PtrList<motionSolver>& solvers,
    const fileName& folder,
    const bool pictures
)
{
    bool some = false;
    for (const motionSolver& solver : solvers)
    {
        const auto* control = dynamic_cast<const controlGeometry*>(&solver);
        if (!control)
        {
            continue;
        }
        some = true;
        controlGeometry::write(control->shapes(), folder);

        autoPtr<ffdBoxes> boxes(boxesOf(mesh, solver));
        if (boxes.valid())
        {
            const auto& ffd = refCast<const ffdMotionSolver>(solver);
            ffdPreview::write
            (
                boxes(),
                ffd.points0(),
                facesOf(mesh, shownPatches(mesh)),
                folder
            );
            if (pictures)
            {
                ffdPreview::draw(folder);
            }
        }
    }
    if (!some)
    {
        WarningInFunction
            << "The motion solver has no controls to show: option -lattice is"
            << " for ffdMotionSolver and rbfMotionSolver" << endl;
    }
}


void Foam::morphMeshControls::writeDerivatives
(
    const fvMesh& mesh,
    const PtrList<motionSolver>& solvers,
    const wordRes& patches,
    const fileName& folder
)
{
    const faceList faces
    (
        facesOf(mesh, selectedPatches(mesh, patches, "Option -derivatives"))
    );
    bool some = false;
    for (const motionSolver& solver : solvers)
    {
        autoPtr<ffdBoxes> boxes(boxesOf(mesh, solver));
        if (!boxes.valid())
        {
            continue;
        }
        some = true;
        const auto& ffd = refCast<const ffdMotionSolver>(solver);
        const ffdMeasures measures(boxes(), ffd.points0(), faces);
        Info<< nl;
        measures.writeMeasures(Info);
        Info<< nl;
        measures.writeDerivatives(Info);

        if (Pstream::master())
        {
            wholeFile::writeOrStop
            (
                folder/"derivatives.dat",
                [&](Ostream& os)
                {
                    os.precision(std::numeric_limits<scalar>::max_digits10);
                    measures.writeDerivatives(os);
                }
            );
            wholeFile::writeOrStop
            (
                folder/"measures.dat",
                [&](Ostream& os)
                {
                    os.precision(std::numeric_limits<scalar>::max_digits10);
                    measures.writeMeasures(os);
                }
            );
        }
        ffdPreview::writeDerivatives
        (
            boxes(), ffd.points0(), faces, folder/"derivatives"
        );
        Info<< nl << "Wrote derivatives.dat, measures.dat and derivatives.vtp"
            << " to " << folder.c_str() << endl;
    }
    if (!some)
    {
        WarningInFunction
            << "The motion solver has no parameters: option -derivatives is"
            << " for ffdMotionSolver" << endl;
    }
}


void Foam::morphMeshControls::writeConstraints
(
    const fvMesh& mesh,
    const PtrList<motionSolver>& solvers,
    const fileName& folder
)
{
    bool some = false;
    for (const motionSolver& solver : solvers)
    {
        autoPtr<ffdBoxes> boxes(boxesOf(mesh, solver));
        if (!boxes.valid())
        {
            continue;
        }
        some = true;
        const auto& ffd = refCast<const ffdMotionSolver>(solver);
        const dictionary& given =
            dictionaryChecks::subDict(ffd.coeffDict(), "constraints");

        shapeConstraints constraints
        (
            given,
            ffd.points0(),
            facesOf
            (
                mesh,
                selectedPatches
                (
                    mesh,
                    shapeConstraints::patches(given),
                    "Entry 'patches' of 'constraints'"
                )
            )
        );
        constraints.evaluate
        (
            ffd.points0() + boxes->displacement(),
            boxes->parameterNames(),
            [&](const label i) { return boxes->derivative(i); }
        );
        mkDir(folder);
        constraints.write(folder + '/');
    }
    if (!some)
    {
        WarningInFunction
            << "The motion solver has no parameters: option -constraints is"
            << " for ffdMotionSolver" << endl;
    }
}


void Foam::morphMeshControls::writeSensitivities
(
    const fvMesh& mesh,
    PtrList<motionSolver>& solvers
)
{
    bool some = false;
    for (motionSolver& solver : solvers)
    {
        auto* parameters = dynamic_cast<motionSensitivities*>(&solver);
        if (!parameters)
        {
            continue;
        }
        some = true;
        const wordList names(parameters->parameterNames());
        forAll(names, i)
        {
            pointVectorField field
            (
                IOobject
                (
                    "d_" + names[i],
                    mesh.time().timeName(),
                    mesh,
                    IOobject::NO_READ,
                    IOobject::NO_WRITE,
                    false
                ),
                foamCompat::pointMeshOf(mesh),
                dimensionedVector(dimLength, Zero)
            );
            field.primitiveFieldRef() = parameters->sensitivity(i);
            field.write();
        }
        Info<< "Wrote dx/dmu as fields d_<parameter> of "
            << plainText::counted(names.size(), "parameter").c_str()
            << " to time " << mesh.time().timeName() << endl;
    }
    if (!some)
    {
        WarningInFunction
            << "The motion solver has no parameters: option -sensitivityFields"
            << " is for ffdMotionSolver" << endl;
    }
}


// ************************************************************************* //
