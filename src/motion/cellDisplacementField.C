/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "cellDisplacementField.H"
#include "calculatedFvPatchField.H"
#include "calculatedPointPatchField.H"
#include "cellMotionFvPatchField.H"
#include "fixedValueFvPatchField.H"
#include "fixedValuePointPatchField.H"
#include "pointDisplacementField.H"
#include "syncTools.H"
#include "zeroGradientPointPatchField.H"
#include "untrapped.H"

#include <algorithm>
#include <cmath>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const fieldName = "cellDisplacement";

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::IOobject Foam::cellDisplacementField::whereItIs(const fvMesh& mesh)
{
    return IOobject
    (
        fieldName,
        mesh.time().timeName(),
        mesh,
        IOobject::READ_IF_PRESENT,
        IOobject::NO_WRITE
    );
}


Foam::wordList Foam::cellDisplacementField::types
(
    const pointVectorField& pointDisplacement
)
{
    const fvMesh& mesh =
        refCast<const fvMesh>(pointDisplacement.mesh()());
    wordList types(mesh.boundary().size());
    forAll(types, patchi)
    {
        // Constraint patches take their own type instead
        types[patchi] =
            pointDisplacementField::condition
            (
                pointDisplacement, mesh.boundaryMesh()[patchi]
            ).fixesValue()
          ? cellMotionFvPatchField<vector>::typeName
          : calculatedFvPatchField<vector>::typeName;
    }
    return types;
}


const Foam::pointPatchVectorField& Foam::cellDisplacementField::condition
(
    const label patchi
) const
{
    return pointDisplacementField::condition
    (
        pointDisplacement_, mesh().boundaryMesh()[patchi]
    );
}


bool Foam::cellDisplacementField::holdsValue(const label patchi) const
{
    return
        condition(patchi).type() == fixedValuePointPatchField<vector>::typeName;
}


const Foam::vectorField& Foam::cellDisplacementField::faces
(
    const label patchi
) const
{
    return boundaryField()[patchi];
}


Foam::vectorField Foam::cellDisplacementField::points(const label patchi) const
{
    const auto* held = isA<valuePointPatchField<vector>>(condition(patchi));
    return held ? vectorField(*held) : vectorField();
}


void Foam::cellDisplacementField::checkFinite(const label patchi) const
{
    bool finite = true;
    for (const vector& d : faces(patchi))
    {
        for (const scalar component : d)
        {
            finite =
                finite && std::isfinite(component)
             && mag(component) < 1e-3*GREAT;
        }
    }
    if (!returnReduce(finite, andOp<bool>()))
    {
        FatalErrorInFunction
            << "Values of " << name() << " on patch '"
            << mesh().boundary()[patchi].name()
            << "' are not finite numbers of metres" << nl
            << "    Look at what writes them: a coupling, or the file "
            << objectPath() << nl << exit(FatalError);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::cellDisplacementField::cellDisplacementField
(
    const fvMesh& mesh,
    const pointField& points0,
    pointVectorField& pointDisplacement
)
:
    volVectorField
    (
        whereItIs(mesh),
        mesh,
        dimensionedVector(dimLength, Zero),
        types(pointDisplacement)
    ),
    points0_(points0),
    pointDisplacement_(pointDisplacement),
    written_(mesh.boundary().size(), false),
    warned_(false)
{
    {
        const untrapped numbers;
        IOobject file(whereItIs(mesh));
        if (file.typeHeaderOk<volVectorField>(true))
        {
            writeOpt() = IOobject::AUTO_WRITE;
        }
    }
    forget();

    // Of values from files those of the points count, which what was heard
    // before a restart has become, unless they are zero
    const label n = mesh.boundaryMesh().nNonProcessor();
    for (label patchi = 0; patchi < n; ++patchi)
    {
        // By comparison alone: it may be anything, and is judged later
        bool told = false;
        for (const vector& d : points_[patchi])
        {
            told = told || d != vector(Zero);
        }
        if (!returnReduce(told, orOp<bool>()))
        {
            faces_[patchi] = Zero;
        }
    }
}


Foam::autoPtr<Foam::cellDisplacementField> Foam::cellDisplacementField::New
(
    const polyMesh& mesh,
    const pointField& points0,
    pointVectorField& pointDisplacement
)
{
    const auto* fv = isA<fvMesh>(mesh);
    if (!fv || mesh.foundObject<volVectorField>(fieldName))
    {
        return nullptr;
    }
    return autoPtr<cellDisplacementField>
    (
        new cellDisplacementField(*fv, points0, pointDisplacement)
    );
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::cellDisplacementField* Foam::cellDisplacementField::of
(
    const polyMesh& mesh
)
{
    return mesh.findObject<cellDisplacementField>(fieldName);
}


bool Foam::cellDisplacementField::moves(const label patchi) const
{
    const pointPatchVectorField& point = condition(patchi);
    const fvPatchVectorField& face = boundaryField()[patchi];
    return
        isA<fixedValueFvPatchField<vector>>(face)
     && !isA<cellMotionFvPatchField<vector>>(face)
     &&
        (
            isA<zeroGradientPointPatchField<vector>>(point)
         || point.type() == calculatedPointPatchField<vector>::typeName
        );
}


Foam::vectorField Foam::cellDisplacementField::atPoints
(
    const label patchi
) const
{
    const polyPatch& patch = mesh().boundaryMesh()[patchi];
    const vectorField& values = faces(patchi);

    // Each face around a point, so that the order of sums is the same on any
    // number of ranks
    List<List<vector>> around(patch.nPoints());
    List<List<scalar>> weights(patch.nPoints());
    forAll(patch, facei)
    {
        const point centre = patch[facei].centre(points0_);
        for (const label i : patch.localFaces()[facei])
        {
            const point& x = points0_[patch.meshPoints()[i]];
            around[i].append(values[facei]);
            weights[i].append(1/Foam::max(mag(x - centre), VSMALL));
        }
    }
    syncTools::syncPointList
    (
        mesh(),
        patch.meshPoints(),
        around,
        ListOps::appendEqOp<vector>(),
        List<vector>(),
        mapDistribute::transform()
    );
    syncTools::syncPointList
    (
        mesh(),
        patch.meshPoints(),
        weights,
        ListOps::appendEqOp<scalar>(),
        List<scalar>()
    );

    vectorField result(patch.nPoints(), Zero);
    forAll(result, i)
    {
        labelList order(identity(around[i].size()));
        std::sort
        (
            order.begin(),
            order.end(),
            [&](const label a, const label b)
            {
                const vector& u = around[i][a];
                const vector& v = around[i][b];
                return
                    weights[i][a] != weights[i][b]
                  ? weights[i][a] < weights[i][b]
                  : std::lexicographical_compare
                    (
                        u.cdata(), u.cdata() + 3, v.cdata(), v.cdata() + 3
                    );
            }
        );
        scalar sum = 0;
        for (const label k : order)
        {
            result[i] += weights[i][k]*around[i][k];
            sum += weights[i][k];
        }
        result[i] /= Foam::max(sum, VSMALL);
    }
    return result;
}


void Foam::cellDisplacementField::hear()
{
    forAll(written_, patchi)
    {
        const bool plain = patchi < mesh().boundaryMesh().nNonProcessor();
        if
        (
           !plain
         || !isA<fixedValueFvPatchField<vector>>(boundaryField()[patchi])
        )
        {
            continue;
        }

        const bool newFaces = returnReduce
        (
            faces(patchi) != faces_[patchi], orOp<bool>()
        );
        const bool newPoints = returnReduce
        (
            points(patchi) != points_[patchi], orOp<bool>()
        );
        if (!newFaces)
        {
            continue;
        }
        checkFinite(patchi);
        written_[patchi] = true;
        faces_[patchi] = faces(patchi);
        writeOpt() = IOobject::AUTO_WRITE;
        if (newPoints || moves(patchi))
        {
            continue;
        }
        if (holdsValue(patchi))
        {
            pointDisplacement_.boundaryFieldRef()
            [
                condition(patchi).patch().index()
            ]
         == atPoints(patchi);
        }
        else if (!warned_)
        {
            WarningInFunction
                << "Values of " << name() << " on patch '"
                << mesh().boundary()[patchi].name() << "' have no effect: "
                << pointDisplacement_.name() << " has a condition there that"
                << " finds its own" << nl
                << "    Give it the type fixedValue in "
                << pointDisplacement_.objectPath() << endl;
            warned_ = true;
        }
    }
}


void Foam::cellDisplacementField::tell(const movedPart& part)
{
    const vectorField& d = pointDisplacement_.primitiveField();
    vectorField& cells = primitiveFieldRef();
    cells = Zero;
    const faceList& allFaces = mesh().faces();
    const labelList& owner = mesh().faceOwner();
    const labelList& neighbour = mesh().faceNeighbour();
    for (const label facei : part.faces())
    {
        const face& f = allFaces[facei];
        vector mean(Zero);
        for (const label pointi : f)
        {
            mean += d[pointi];
        }
        mean /= f.size();
        cells[owner[facei]] += mean;
        if (facei < neighbour.size())
        {
            cells[neighbour[facei]] += mean;
        }
    }
    const cellList& allCells = mesh().cells();
    for (const label celli : part.cells())
    {
        cells[celli] /= allCells[celli].size();
    }

    // Not by their own evaluate(), with which overset patches would interpolate
    boolList follows(written_.size());
    forAll(written_, patchi)
    {
        fvPatchVectorField& values = boundaryFieldRef()[patchi];
        follows[patchi] =
            !written_[patchi] && isA<cellMotionFvPatchField<vector>>(values);
        if (follows[patchi])
        {
            static_cast<vectorField&>(values) = Zero;
        }
    }
    const label nInternal = mesh().nInternalFaces();
    const auto first = std::lower_bound
    (
        part.faces().begin(), part.faces().end(), nInternal
    );
    for (auto i = first; i != part.faces().end(); ++i)
    {
        const label patchi = mesh().boundaryMesh().patchID()[*i - nInternal];
        if (follows[patchi])
        {
            boundaryFieldRef()[patchi]
            [
                *i - mesh().boundaryMesh()[patchi].start()
            ] = mesh().faces()[*i].average(mesh().points(), d);
        }
    }
    forAll(written_, patchi)
    {
        faces_[patchi] = faces(patchi);
        points_[patchi] = this->points(patchi);
    }
}


void Foam::cellDisplacementField::forget()
{
    const label n = mesh().boundary().size();
    faces_.setSize(n);
    points_.setSize(n);
    written_.setSize(n, false);
    forAll(faces_, patchi)
    {
        faces_[patchi] = faces(patchi);
        points_[patchi] = points(patchi);
    }
}


// ************************************************************************* //
