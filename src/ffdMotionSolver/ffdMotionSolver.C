/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdMotionSolver.H"
#include "ffdCorrection.H"
#include "ffdFit.H"
#include "ffdPreview.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "foamCompat.H"
#include "morphVersion.H"
#include "pointDisplacementField.H"
#include "referencePoints.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(ffdMotionSolver, 0);

    addToRunTimeSelectionTable
    (
        motionSolver,
        ffdMotionSolver,
        dictionary
    );

    addToRunTimeSelectionTable
    (
        displacementMotionSolver,
        ffdMotionSolver,
        displacement
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdMotionSolver::ffdMotionSolver
(
    const polyMesh& mesh,
    const IOdictionary& dict
)
:
    displacementMotionSolver
    (
        mesh,
        dict,
        pointDisplacementField::atRest(mesh),
        referencePoints::read(mesh, &points0IO)(),
        typeName
    ),
    boxes_
    (
        ffdFit::fitted(checkedCoeffDict(), mesh, this->points0()), &mesh
    ),
    onInvalidMesh_(motionLimiter::readPolicy(coeffDict())),
    optimiseSettings_(optimiseSettings::readFrom(coeffDict(), "optimise")),
    altered_(false)
{
    pointDisplacementField::registerAndRead(pointDisplacement_);
    initialise();
}


Foam::ffdMotionSolver::ffdMotionSolver
(
    const polyMesh& mesh,
    const IOdictionary& dict,
    const pointVectorField& pointDisplacement,
    const pointIOField& points0
)
:
    displacementMotionSolver(mesh, dict, pointDisplacement, points0, typeName),
    boxes_
    (
        ffdFit::fitted(checkedCoeffDict(), mesh, this->points0()), &mesh
    ),
    onInvalidMesh_(motionLimiter::readPolicy(coeffDict())),
    optimiseSettings_(optimiseSettings::readFrom(coeffDict(), "optimise")),
    altered_(false)
{
    foamCompat::registerObject(pointDisplacement_);
    initialise();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

const Foam::dictionary& Foam::ffdMotionSolver::checkedCoeffDict() const
{
    dictionaryChecks::restoreNames(coeffDict(), objectPath());
    // Without a dictionary of coefficients this is dynamicMeshDict itself,
    // with keys of others
    if (found(typeName + "Coeffs"))
    {
        wordList keys(ffdBoxes::keys());
        keys.append
        (
            wordList
            ({
                "onInvalidMesh", "constraints", "frozenPointsZone", "optimise"
            })
        );
        keys.append(motionZone::keys());
        dictionaryChecks::onlyKeys(coeffDict(), keys);
    }
    return coeffDict();
}


void Foam::ffdMotionSolver::initialise()
{
    morphVersion::announce();
    zone_.reset(new motionZone(*this, coeffDict(), mesh()));
}


void Foam::ffdMotionSolver::makeGeometry()
{
    reduced_.reset(new reducedMesh(mesh(), points0()));
    symmetry_.reset(new symmetryPlanes(mesh(), points0()));

    const planarReduction& plane = reduced_->plane();
    pointField positions(mesh().nPoints());
    forAll(positions, pointi)
    {
        positions[pointi] = plane.position
        (
            points0()[plane.representative()[pointi]]
        );
    }
    boxes_.setPoints(positions, mesh().edges());
    if (boxes_.keeps() && !plane.active())
    {
        boxes_.setKept
        (
            points0(), ffdCorrection::faces(boxes_.keep(), mesh())
        );
    }
}


void Foam::ffdMotionSolver::warnOfCutPatches() const
{
    const polyBoundaryMesh& patches = mesh().boundaryMesh();
    const label nPatches = patches.nNonProcessor();
    const label nBoxes = boxes_.boxes().size();

    const label nWays = ffdExits::nWays;
    labelList ways(nPatches*nBoxes*nWays, 0);
    for (label patchi = 0; patchi < nPatches; ++patchi)
    {
        const polyPatch& patch = patches[patchi];
        edgeList edges(patch.nEdges());
        forAll(edges, i)
        {
            edges[i] = edge
            (
                patch.meshPoints()[patch.edges()[i].start()],
                patch.meshPoints()[patch.edges()[i].end()]
            );
        }
        const List<ffdExits> exits(boxes_.cut(edges));
        forAll(exits, boxi)
        {
            SubList<label>
            (
                ways, nWays, nWays*(boxi + nBoxes*patchi)
            ) = exits[boxi].counts();
        }
    }
    foamCompat::allCombineList(ways, plusEqOp<label>());

    forAll(boxes_.boxes(), boxi)
    {
        FixedList<wordList, 6> cut;
        for (label patchi = 0; patchi < nPatches; ++patchi)
        {
            const ffdExits exits
            (
                labelList
                (
                    SubList<label>
                    (
                        ways, nWays, nWays*(boxi + nBoxes*patchi)
                    )
                )
            );
            const ffdExits::faceFlags faces(exits.toFreeze());
            forAll(faces, face)
            {
                if (faces[face])
                {
                    cut[face].append(patches[patchi].name());
                }
            }
        }
        forAll(cut, face)
        {
            if (!cut[face].empty())
            {
                warnOfCut(boxes_.boxes()[boxi], face, cut[face]);
            }
        }
    }
}


void Foam::ffdMotionSolver::warnOfCut
(
    const ffdDeformation& box,
    const label face,
    const wordList& patches
) const
{
    const wordList moving(box.moving(face));
    WarningInFunction
        << "The face " << ffdExits::faceName(face).c_str() << " of box '"
        << box.name() << "' cuts through patches "
        << plainText::listed(patches).c_str()
        << " and is not frozen: continuity is none." << nl
        << "    "
        << (
               moving.empty()
             ? string("No parameter moves its control points")
             : "The surface tears where parameters "
             + plainText::listed(moving)
             + " move its control points"
           ).c_str()
        << endl;
}


void Foam::ffdMotionSolver::constrain(vectorField& displacement) const
{
    const scalar largest = gMax(mag(displacement));

    const scalar normal = symmetry_->impose(displacement);
    if (normal > cyclicCopies::tolerance*largest)
    {
        WarningInFunction
            << "Points of symmetry patches are moved off their plane, by up to "
            << normal << " m. They are kept in it; cells beside them may be"
            << " distorted." << nl
            << "    Let the lattice move along the plane there" << endl;
    }

    const scalar difference = reduced_->match(displacement);
    if (difference > cyclicCopies::tolerance*largest)
    {
        WarningInFunction
            << "Coupled cyclic points are moved differently, by up to "
            << difference << " m. They take the mean of both sides; cells"
            << " beside them may be distorted." << nl
            << "    Let the lattice move both sides alike" << endl;
    }
}


Foam::vectorField Foam::ffdMotionSolver::inMesh
(
    const vectorField& moved
) const
{
    vectorField inPlane(moved);
    const planarReduction& plane = reduced_->plane();
    forAll(inPlane, pointi)
    {
        inPlane[pointi] = reduced_->reduce
        (
            plane.position(points0()[pointi]), inPlane[pointi]
        );
    }
    return vectorField(reduced_->expand(inPlane));
}


Foam::vectorField Foam::ffdMotionSolver::displacement()
{
    vectorField displacement(inMesh(boxes_.displacement()));
    constrain(displacement);
    zone_->restrict(displacement);
    return displacement;
}


void Foam::ffdMotionSolver::optimise(vectorField& displacement)
{
    if (optimiseSettings_.never())
    {
        return;
    }
    if (!optimiser_.valid())
    {
        boolList stays(mesh().nPoints(), !zone_->wholeMesh());
        if (!zone_->wholeMesh())
        {
            UIndirectList<bool>(stays, zone_->pointLabels()) = false;
        }
        freedom_.reset
        (
            new pointFreedom
            (
                mesh(), points0(), reduced_(), labelHashSet(),
                findIndices(stays, true)
            )
        );
        optimiser_.reset
        (
            new meshOptimiser
            (
                mesh(), optimiseSettings_, points0(), reduced_()
            )
        );
    }
    const planarReduction& plane = reduced_->plane();
    vectorField inPlane(displacement);
    forAll(inPlane, pointi)
    {
        inPlane[pointi] = plane.reduce(points0()[pointi], inPlane[pointi]);
    }
    if (optimiser_->improve(freedom_(), points0(), inPlane))
    {
        displacement = reduced_->expand(inPlane);
        zone_->restrict(displacement);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::ffdMotionSolver::curPoints() const
{
    return zone_->moved
    (
        points0(), pointDisplacement_.primitiveField(), mesh().points()
    );
}


void Foam::ffdMotionSolver::solve()
{
    const bool first = !reduced_.valid();
    if (first)
    {
        makeGeometry();
    }
    const bool changed = boxes_.update(mesh().time().timeOutputValue());
    if (!first && !changed)
    {
        return;
    }

    vectorField d(displacement());
    const vectorField whole(d);
    if (first)
    {
        warnOfCutPatches();
    }
    optimise(d);
    motionLimiter(mesh(), coeffDict(), onInvalidMesh_).apply
    (
        points0(),
        d,
        "Make the values of the parameters smaller, or spread them over more"
        " control points"
    );
    altered_ = returnReduce(d != whole, orOp<bool>());
    pointDisplacement_.primitiveFieldRef() = d;
}


void Foam::ffdMotionSolver::updateMesh(const mapPolyMesh& map)
{
    displacementMotionSolver::updateMesh(map);

    optimiser_.clear();
    freedom_.clear();
    reduced_.clear();
    symmetry_.clear();
    zone_.reset(new motionZone(*this, coeffDict(), mesh()));
}


Foam::List<Foam::motionParameter> Foam::ffdMotionSolver::parameters() const
{
    return boxes_.parameterList();
}


Foam::tmp<Foam::vectorField> Foam::ffdMotionSolver::sensitivity
(
    const label parameteri
)
{
    if (altered_)
    {
        FatalIOErrorInFunction(coeffDict())
            << "The mesh was optimised after the motion, or the motion limited"
            << " to a part of what is prescribed: dx/dmu is that of the motion"
            << " alone" << nl
            << "    Make the values of the parameters smaller, or remove"
            << " 'optimise'" << nl
            << exit(FatalIOError);
    }

    // Linear, like the motion itself: what constraints take from it is told
    // where the mesh moves
    auto d = tmp<vectorField>::New(inMesh(boxes_.derivative(parameteri)));
    symmetry_->impose(d.ref());
    reduced_->match(d.ref());
    zone_->restrict(d.ref());
    return d;
}


Foam::List<Foam::controlShape> Foam::ffdMotionSolver::shapes() const
{
    return ffdPreview::lattices(boxes_);
}


// ************************************************************************* //
