/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMeshControls.H"
#include "controlGeometry.H"
#include "dictionaryEntries.H"
#include "displacementMotionSolver.H"
#include "emptyPolyPatch.H"
#include "ffdCorrection.H"
#include "ffdFit.H"
#include "ffdMotionSolver.H"
#include "ffdPreview.H"
#include "foamCompat.H"
#include "fvMesh.H"
#include "motionSensitivities.H"
#include "OSspecific.H"
#include "plainText.H"
#include "pointFields.H"
#include "shapeConstraints.H"
#include "shapeMeasures.H"
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
    if (boxes->keeps())
    {
        boxes->setKept
        (
            ffd->points0(), ffdCorrection::faces(boxes->keep(), mesh)
        );
    }
    boxes->update(mesh.time().timeOutputValue());
    return boxes;
}

//- A solver whose motion has parameters
struct parametricMotion
{
    const displacementMotionSolver& solver;

    motionSensitivities& sensitivities;

    List<motionParameter> parameters;

    const pointField& points0() const
    {
        return solver.points0();
    }

    tmp<pointField> moved() const
    {
        return points0() + solver.pointDisplacement().primitiveField();
    }

    wordList names() const
    {
        wordList names(parameters.size());
        forAll(names, i)
        {
            names[i] = parameters[i].name;
        }
        return names;
    }

    std::function<tmp<vectorField>(const label)> derivative() const
    {
        return [this](const label i) { return sensitivities.sensitivity(i); };
    }
};


//- Those with parameters, or a warning where there are none
static std::vector<parametricMotion> parametric
(
    PtrList<motionSolver>& solvers,
    const char* option
)
{
    std::vector<parametricMotion> found;
    for (motionSolver& solver : solvers)
    {
        auto* sensitivities = dynamic_cast<motionSensitivities*>(&solver);
        const auto* moving = isA<displacementMotionSolver>(solver);
        if (sensitivities && moving)
        {
            const List<motionParameter> list(sensitivities->parameters());
            if (list.size())
            {
                found.push_back({*moving, *sensitivities, list});
            }
        }
    }
    if (found.empty())
    {
        WarningInFunction
            << "The motion solver has no parameters: option " << option
            << " is for ffdMotionSolver, and for rbfMotionSolver with"
            << " displacements that have numbers" << endl;
    }
    return found;
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
        List<controlShape> shapes(control->shapes());
        if (solvers.size() > 1)
        {
            for (controlShape& shape : shapes)
            {
                shape.name = solver.name() + '_' + shape.name;
            }
        }
        controlGeometry::write(shapes, folder);
        controlGeometry::writeSeries
        (
            shapes, folder.path().path(), folder.name()
        );

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
    PtrList<motionSolver>& solvers,
    const wordRes& patches,
    const fileName& folder
)
{
    const faceList faces
    (
        facesOf(mesh, selectedPatches(mesh, patches, "Option -derivatives"))
    );
    for (const parametricMotion& motion : parametric(solvers, "-derivatives"))
    {
        const pointField moved(motion.moved());
        const shapeMeasures measures
        (
            motion.points0(),
            moved,
            faces,
            motion.parameters,
            motion.derivative()
        );
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
            motion.parameters,
            moved,
            faces,
            motion.derivative(),
            folder/"derivatives"
        );
        Info<< nl << "Wrote derivatives.dat, measures.dat and derivatives.vtp"
            << " to " << folder.c_str() << endl;
    }
}


void Foam::morphMeshControls::writeConstraints
(
    const fvMesh& mesh,
    PtrList<motionSolver>& solvers,
    const fileName& folder
)
{
    for (const parametricMotion& motion : parametric(solvers, "-constraints"))
    {
        const dictionary& given = dictionaryChecks::subDict
        (
            motion.solver.coeffDict(), "constraints"
        );

        shapeConstraints constraints
        (
            given,
            motion.points0(),
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
            motion.moved(), motion.names(), motion.derivative()
        );
        mkDir(folder);
        constraints.write(folder + '/');
    }
}


void Foam::morphMeshControls::writeSensitivities
(
    const fvMesh& mesh,
    PtrList<motionSolver>& solvers
)
{
    for
    (
        const parametricMotion& motion
      : parametric(solvers, "-sensitivityFields")
    )
    {
        const wordList names(motion.names());
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
            field.primitiveFieldRef() = motion.derivative()(i);
            field.write();
        }
        Info<< "Wrote dx/dmu as fields d_<parameter> of "
            << plainText::counted(names.size(), "parameter").c_str()
            << " to time " << mesh.time().timeName() << endl;
    }
}


// ************************************************************************* //
