/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "conservativeMapping.H"
#include "coupledFvPatchFields.H"
#include "eigenFields.H"
#include "pointFields.H"
#include "linear.H"
#include "zeroGradientFvPatchFields.H"

#include <Eigen/QR>

// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

namespace Foam
{

namespace
{

template<class Type>
using volumeField = GeometricField<Type, fvPatchField, volMesh>;

template<class Type>
using faceField = GeometricField<Type, fvsPatchField, surfaceMesh>;

template<class Type>
using nodeField = GeometricField<Type, pointPatchField, pointMesh>;


template<class Type>
Eigen::RowVectorXd asRow(const Type& value)
{
    Eigen::RowVectorXd row(label(pTraits<Type>::nComponents));
    for (direction k = 0; k < pTraits<Type>::nComponents; ++k)
    {
        row[k] = component(value, k);
    }
    return row;
}


template<class Type>
Type asValue(const Eigen::RowVectorXd& row)
{
    Type value(Zero);
    for (direction k = 0; k < pTraits<Type>::nComponents; ++k)
    {
        setComponent(value, k) = row[k];
    }
    return value;
}


template<class Type>
morph::Matrix asRows(const UList<Type>& values)
{
    morph::Matrix rows(values.size(), label(pTraits<Type>::nComponents));
    forAll(values, i)
    {
        rows.row(i) = asRow(values[i]);
    }
    return rows;
}


//- On all faces; zero where a patch has no values
template<class Type>
Field<Type> ofAllFaces(const faceField<Type>& field)
{
    Field<Type> all(field.mesh().nFaces(), Zero);
    forAll(field, facei)
    {
        all[facei] = field[facei];
    }
    for (const fvsPatchField<Type>& patchField : field.boundaryField())
    {
        forAll(patchField, i)
        {
            all[patchField.patch().start() + i] = patchField[i];
        }
    }
    return all;
}


//- Of a face: a reference to its value, or null where a patch has none
template<class Type>
Type* valueOn(faceField<Type>& field, const label facei)
{
    const fvMesh& mesh = field.mesh();
    if (mesh.isInternalFace(facei))
    {
        return &field.primitiveFieldRef()[facei];
    }
    const label patchi = mesh.boundaryMesh().whichPatch(facei);
    fvsPatchField<Type>& patchField = field.boundaryFieldRef()[patchi];
    const label i = facei - mesh.boundaryMesh()[patchi].start();
    return i < patchField.size() ? &patchField[i] : nullptr;
}

} // End anonymous namespace

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template<class Type>
void Foam::conservativeMapping::keepVolumes()
{
    // Levels of the time before are stored first: a change of topology does
    // it, and maps what it has stored
    for (const word& name : mesh_.names<volumeField<Type>>())
    {
        mesh_.lookupObjectRef<volumeField<Type>>(name).storeOldTimes();
    }

    for (const word& name : mesh_.sortedNames<volumeField<Type>>())
    {
        const volumeField<Type>& field =
            mesh_.lookupObject<volumeField<Type>>(name);

        boolList fixed(mesh_.boundary().size(), false);
        Field<Type> values(field.primitiveField(), cells_);
        Field<Type> beyond(mesh_.nFaces() - mesh_.nInternalFaces(), Zero);
        forAll(field.boundaryField(), patchi)
        {
            const fvPatchField<Type>& patchField =
                field.boundaryField()[patchi];
            if (patchField.size() == 0)
            {
                continue;
            }
            fixed[patchi] = patchField.fixesValue() && !patchField.coupled();
            SubList<Type>
            (
                beyond,
                patchField.size(),
                patchField.patch().start() - mesh_.nInternalFaces()
            ) =
            (
                patchField.coupled()
              ? patchField.patchNeighbourField()()
              : static_cast<const Field<Type>&>(patchField)
            );
        }
        for (const label facei : coupledFaces_)
        {
            values.append(beyond[facei - mesh_.nInternalFaces()]);
        }
        for (const label facei : patchFaces_)
        {
            values.append(beyond[facei - mesh_.nInternalFaces()]);
        }
        volumeFields_[name] = {asRows(values), slopes(true, fixed)};
    }

    // What has no boundary
    typedef DimensionedField<Type, volMesh> internalField;
    for (const word& name : mesh_.sortedNames<internalField>())
    {
        const internalField& field = mesh_.lookupObject<internalField>(name);
        if (!isA<volumeField<Type>>(field))
        {
            Field<Type> values(field, cells_);
            values.setSize(positions_.rows(), Zero);
            volumeFields_[name] = {asRows(values), slopesOfCells()};
        }
    }
}


template<class Type>
void Foam::conservativeMapping::keepFaces()
{
    for (const word& name : mesh_.names<faceField<Type>>())
    {
        mesh_.lookupObjectRef<faceField<Type>>(name).storeOldTimes();
    }
    for (const word& name : mesh_.sortedNames<faceField<Type>>())
    {
        faceFields_[name] =
            asRows(ofAllFaces(mesh_.lookupObject<faceField<Type>>(name)));
    }
}


template<class Type>
void Foam::conservativeMapping::keepPoints()
{
    for (const word& name : mesh_.names<nodeField<Type>>())
    {
        mesh_.lookupObjectRef<nodeField<Type>>(name).storeOldTimes();
    }
    for (const word& name : mesh_.sortedNames<nodeField<Type>>())
    {
        pointFields_[name] =
            asRows(mesh_.lookupObject<nodeField<Type>>(name).primitiveField());
    }
}


template<class Type>
void Foam::conservativeMapping::keep()
{
    keepVolumes<Type>();
    keepFaces<Type>();
    keepPoints<Type>();
}


void Foam::conservativeMapping::keepAll()
{
    keep<scalar>();
    keep<vector>();
    keep<sphericalTensor>();
    keep<symmTensor>();
    keep<tensor>();
}


template<class Type>
void Foam::conservativeMapping::giveVolumes()
{
    const bool bounded = pTraits<Type>::nComponents == 1;

    typedef DimensionedField<Type, volMesh> internalField;
    for (const word& name : mesh_.sortedNames<internalField>())
    {
        const auto old = volumeFields_.find(name);
        if (old == volumeFields_.end())
        {
            continue;
        }
        internalField& field = mesh_.lookupObjectRef<internalField>(name);
        const morph::Matrix values
        (
            mapped(old->second.values, *old->second.slopes, bounded)
        );
        forAll(targets_, i)
        {
            field[targets_[i]] = asValue<Type>(values.row(i));
        }
    }

    // What follows from the cells alone. Other conditions may ask for more
    // than there is in between: they keep what they were mapped to
    for (const word& name : mesh_.sortedNames<volumeField<Type>>())
    {
        volumeField<Type>& field =
            mesh_.lookupObjectRef<volumeField<Type>>(name);
        typename volumeField<Type>::Boundary& boundary =
            field.boundaryFieldRef();
        boolList follows(boundary.size(), false);
        forAll(boundary, patchi)
        {
            follows[patchi] =
                boundary[patchi].coupled()
             || isA<zeroGradientFvPatchField<Type>>(boundary[patchi])
             || polyPatch::constraintType(boundary[patchi].patch().type());
            if (follows[patchi])
            {
                boundary[patchi].initEvaluate(Pstream::commsTypes::blocking);
            }
        }
        forAll(boundary, patchi)
        {
            if (follows[patchi])
            {
                boundary[patchi].evaluate(Pstream::commsTypes::blocking);
            }
        }
    }
}


Foam::tmp<Foam::surfaceVectorField> Foam::conservativeMapping::onFaces
(
    const word& name
) const
{
    // Old times as well: Uf_0 is of U_0
    const std::string::size_type old = name.find("_0");
    const word level(old == std::string::npos ? word() : name.substr(old));
    const word base(name.substr(0, old));
    if (base.size() < 2 || base.back() != 'f')
    {
        return nullptr;
    }
    const word whole(base.substr(0, base.size() - 1));
    if (mesh_.foundObject<volVectorField>(whole + level))
    {
        return linearInterpolate
        (
            mesh_.lookupObject<volVectorField>(whole + level)
        );
    }
    const word velocity(whole.substr(min(whole.size(), size_t(3))) + level);
    if
    (
        whole.substr(0, 3) == "rho"
     && mesh_.foundObject<volVectorField>(velocity)
     && mesh_.foundObject<volScalarField>("rho" + level)
    )
    {
        return linearInterpolate
        (
            mesh_.lookupObject<volScalarField>("rho" + level)
           *mesh_.lookupObject<volVectorField>(velocity)
        );
    }
    return nullptr;
}


template<class Type>
void Foam::conservativeMapping::giveFaces()
{
    for (const word& name : mesh_.sortedNames<faceField<Type>>())
    {
        const auto old = faceFields_.find(name);
        faceField<Type>& field = mesh_.lookupObjectRef<faceField<Type>>(name);
        if (old == faceFields_.end())
        {
            continue;
        }
        const bool flux =
            pTraits<Type>::nComponents == 1 && field.oriented()();
        const morph::Matrix values
        (
            mapped
            (
                flux ? velocities(old->second) : means(old->second),
                *slopesOfCells(),
                false
            )
        );
        forAll(map_.faceMap, facei)
        {
            const label oldFacei = map_.faceMap[facei];
            const vector& area = mesh_.faceAreas()[facei];
            Type* value = valueOn(field, facei);
            if (!value)
            {
                continue;
            }
            if (oldFacei < 0)
            {
                const Eigen::RowVectorXd mean(between(facei, values));
                *value =
                    flux
                  ? asValue<Type>(mean*toEigen(area))
                  : asValue<Type>(mean);
            }
            else if (flux && area != areas_[oldFacei])
            {
                // Parts share the flux of the whole
                *value = asValue<Type>
                (
                    old->second.row(oldFacei)
                   *((area & areas_[oldFacei])/magSqr(areas_[oldFacei]))
                );
            }
        }
    }
}


void Foam::conservativeMapping::giveVelocities()
{
    for (const word& name : mesh_.sortedNames<surfaceVectorField>())
    {
        tmp<surfaceVectorField> velocity(onFaces(name));
        if (!velocity.valid())
        {
            continue;
        }
        surfaceVectorField& field =
            mesh_.lookupObjectRef<surfaceVectorField>(name);
        forAll(field, facei)
        {
            if (map_.faceMap[facei] < 0)
            {
                field[facei] = velocity()[facei];
            }
        }
    }
}


template<class Type>
void Foam::conservativeMapping::givePoints()
{
    if (pointFields_.empty())
    {
        return;
    }
    // New points of patches take what is on the patch: a body's points go with
    // the body
    Map<label> oldFace;
    for
    (
        label facei = mesh_.nInternalFaces();
        facei < mesh_.nFaces();
        ++facei
    )
    {
        for (const label pointi : mesh_.faces()[facei])
        {
            if (map_.pointMap[pointi] < 0 && map_.faceMap[facei] >= 0)
            {
                oldFace.insert(pointi, map_.faceMap[facei]);
            }
        }
    }

    forAll(map_.pointMap, pointi)
    {
        if (map_.pointMap[pointi] >= 0)
        {
            continue;
        }
        const point& x = mesh_.points()[pointi];
        const label facei = oldFace.lookup(pointi, -1) - nOldInternalFaces_;
        const label donori = facei < 0 ? donorAround(x) : -1;
        if (facei < 0 && donori < 0)
        {
            continue;
        }

        // The plane through the values at the points of the face or cell
        // around, by least squares, nearer ones first
        const labelUList& around =
            facei < 0
          ? static_cast<const labelUList&>(cellPoints_[donori])
          : boundaryFaces_[facei];
        morph::Matrix matrix(around.size(), 4);
        forAll(around, i)
        {
            const vector d(points_[around[i]] - x);
            const scalar w = 1/(mag(d) + VSMALL);
            matrix.row(i) << w, w*d.x(), w*d.y(), w*d.z();
        }
        const Eigen::CompleteOrthogonalDecomposition<morph::Matrix> fit(matrix);

        for (const word& name : mesh_.sortedNames<nodeField<Type>>())
        {
            const auto old = pointFields_.find(name);
            if (old == pointFields_.end())
            {
                continue;
            }
            morph::Matrix right(around.size(), old->second.cols());
            forAll(around, i)
            {
                right.row(i) = matrix(i, 0)*old->second.row(around[i]);
            }
            const morph::Matrix solution(fit.solve(right));
            mesh_.lookupObjectRef<nodeField<Type>>(name)
               .primitiveFieldRef()[pointi] = asValue<Type>(solution.row(0));
        }
    }
}


template<class Type>
void Foam::conservativeMapping::give()
{
    giveVolumes<Type>();
    giveFaces<Type>();
    givePoints<Type>();
}


void Foam::conservativeMapping::giveAll()
{
    give<scalar>();
    give<vector>();
    give<sphericalTensor>();
    give<symmTensor>();
    give<tensor>();
    giveVelocities();
}


// ************************************************************************* //
