// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

/*---------------------------------------------------------------------------*\
Application
    checkProducts

Description
    Compares products of temporaries, as OpenFOAM's libraries compute them,
    with plain loops: a row for each product and kind of field with the largest
    relative error. Exit status 1 where one of them is wrong.

    Needs no case: the mesh is one row of cells in memory.

\*---------------------------------------------------------------------------*/

#include "Time.H"
#include "fvMesh.H"
#include "volFields.H"
#include "surfaceFields.H"
#include "pointFields.H"
#include "pointMesh.H"
#include "Random.H"
#include "transformField.H"

#include <functional>

using namespace Foam;

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

// The products come from the libraries, not from this program
#define IN_LIBRARY(name, Result, A, B, PatchField, GeoMesh)                    \
                                                                               \
    extern template void                                                       \
    Foam::name<Foam::A, Foam::B, Foam::PatchField, Foam::GeoMesh>              \
    (                                                                          \
        GeometricField<Result, PatchField, GeoMesh>&,                          \
        const GeometricField<A, PatchField, GeoMesh>&,                         \
        const GeometricField<B, PatchField, GeoMesh>&                          \
    );

#define IN_LIBRARIES(PatchField, GeoMesh)                                      \
                                                                               \
    IN_LIBRARY(dot, vector, vector, tensor, PatchField, GeoMesh)               \
    IN_LIBRARY(dot, vector, tensor, vector, PatchField, GeoMesh)               \
    IN_LIBRARY(dot, vector, vector, symmTensor, PatchField, GeoMesh)           \
    IN_LIBRARY(dot, vector, symmTensor, vector, PatchField, GeoMesh)           \
    IN_LIBRARY(dot, tensor, tensor, tensor, PatchField, GeoMesh)               \
    IN_LIBRARY(dot, tensor, tensor, symmTensor, PatchField, GeoMesh)           \
    IN_LIBRARY(dot, tensor, symmTensor, tensor, PatchField, GeoMesh)           \
    IN_LIBRARY(cross, vector, vector, vector, PatchField, GeoMesh)

IN_LIBRARIES(fvPatchField, volMesh)
IN_LIBRARIES(fvsPatchField, surfaceMesh)
IN_LIBRARIES(pointPatchField, pointMesh)

#define LIST_IN_LIBRARY(product, symbol, A, B)                                 \
                                                                               \
    extern template                                                            \
    Foam::tmp<Foam::Field<typename Foam::product<Foam::A, Foam::B>::type>>     \
    Foam::operator symbol<Foam::A, Foam::B>                                    \
    (                                                                          \
        const tmp<Field<A>>&, const tmp<Field<B>>&                             \
    );

LIST_IN_LIBRARY(innerProduct, &, vector, tensor)
LIST_IN_LIBRARY(innerProduct, &, tensor, vector)
LIST_IN_LIBRARY(innerProduct, &, vector, symmTensor)
LIST_IN_LIBRARY(innerProduct, &, symmTensor, vector)
LIST_IN_LIBRARY(innerProduct, &, tensor, tensor)
LIST_IN_LIBRARY(innerProduct, &, tensor, symmTensor)
LIST_IN_LIBRARY(innerProduct, &, symmTensor, tensor)
LIST_IN_LIBRARY(crossProduct, ^, vector, vector)


#define FOR_ALL_PRODUCTS(FUNCTION)                                             \
                                                                               \
    FUNCTION(vector, dot, tensor)                                              \
    FUNCTION(tensor, dot, vector)                                              \
    FUNCTION(vector, dot, symmTensor)                                          \
    FUNCTION(symmTensor, dot, vector)                                          \
    FUNCTION(tensor, dot, tensor)                                              \
    FUNCTION(tensor, dot, symmTensor)                                          \
    FUNCTION(symmTensor, dot, tensor)                                          \
    FUNCTION(vector, cross, vector)


static Random random_(1);
static bool wrong_ = false;


template<class Type>
Field<Type> randomField(const label size)
{
    Field<Type> values(size);
    for (Type& value : values)
    {
        // Away from singular tensors
        value = random_.sample01<Type>() + Type(pTraits<Type>::one);
    }
    return values;
}


template<class Type>
void report
(
    const string& where,
    const string& what,
    const UList<Type>& computed,
    const UList<Type>& expected
)
{
    scalar error = 0;
    forAll(expected, i)
    {
        error = max(error, mag(computed[i] - expected[i])/mag(expected[i]));
    }

    wrong_ = wrong_ || error > 1e-12;
    Info<< where.c_str() << "  " << what.c_str() << "  " << error << nl;
}


template<class Type, template<class> class PatchField, class GeoMesh>
tmp<GeometricField<Type, PatchField, GeoMesh>> fieldOf
(
    const typename GeoMesh::Mesh& mesh,
    const Field<Type>& values
)
{
    auto tfield = tmp<GeometricField<Type, PatchField, GeoMesh>>::New
    (
        IOobject
        (
            "checked",
            mesh.thisDb().time().timeName(),
            mesh.thisDb(),
            IOobject::NO_READ,
            IOobject::NO_WRITE,
            false
        ),
        mesh,
        dimensioned<Type>("zero", dimless, Zero)
    );
    tfield.ref().primitiveFieldRef() = values;
    return tfield;
}


template
<
    class A, class B, template<class> class PatchField, class GeoMesh, class Op
>
void checkProduct
(
    const string& where,
    const string& what,
    const typename GeoMesh::Mesh& mesh,
    const Op& op
)
{
    const label size = GeoMesh::size(mesh);
    const Field<A> a(randomField<A>(size));
    const Field<B> b(randomField<B>(size));

    typedef typename std::decay<decltype(op(a[0], b[0]))>::type Result;
    Field<Result> expected(size);
    forAll(expected, i)
    {
        expected[i] = op(a[i], b[i]);
    }

    const auto temporary = [&](const auto& values)
    {
        typedef typename std::decay<decltype(values[0])>::type Type;
        return fieldOf<Type, PatchField, GeoMesh>(mesh, values);
    };
    const auto ta = temporary(a);
    const auto tb = temporary(b);

    const auto check = [&](const string& how, const auto& tresult)
    {
        report(where, what + how, tresult().primitiveField(), expected);
    };

    check(" (tmp, tmp)", op(temporary(a), temporary(b)));
    check(" (tmp, field)", op(temporary(a), tb()));
    check(" (field, tmp)", op(ta(), temporary(b)));
}


template<template<class> class PatchField, class GeoMesh>
void checkProducts(const string& where, const typename GeoMesh::Mesh& mesh)
{
    const auto dot = [](const auto& a, const auto& b) { return a & b; };
    const auto cross = [](const auto& a, const auto& b) { return a ^ b; };

    #define CHECK(A, name, B)                                                  \
        checkProduct<A, B, PatchField, GeoMesh>                                \
        (                                                                      \
            where, #A " " #name " " #B, mesh, name                             \
        );

    FOR_ALL_PRODUCTS(CHECK)

    #undef CHECK
}


template<class A, class B, class Op>
void checkListProduct(const string& what, const Op& op)
{
    const Field<A> a(randomField<A>(7));
    const Field<B> b(randomField<B>(7));

    typedef typename std::decay<decltype(op(a[0], b[0]))>::type Result;
    Field<Result> expected(a.size());
    forAll(expected, i)
    {
        expected[i] = op(a[i], b[i]);
    }

    report<Result>
    (
        "list   ", what + " (tmp, tmp)",
        op(tmp<Field<A>>::New(a), tmp<Field<B>>::New(b))(),
        expected
    );
}


void checkListProducts()
{
    const auto dot = [](const auto& a, const auto& b) { return a & b; };
    const auto cross = [](const auto& a, const auto& b) { return a ^ b; };

    #define CHECK(A, name, B)                                                  \
        checkListProduct<A, B>(#A " " #name " " #B, name);

    FOR_ALL_PRODUCTS(CHECK)

    #undef CHECK
}


//- Functions of one temporary, and rotations of one
template<class Type>
void checkFunction
(
    const string& what,
    const std::function<Type(const Type&)>& function,
    const std::function<tmp<Field<Type>>(const tmp<Field<Type>>&)>& ofField
)
{
    const Field<Type> a(randomField<Type>(7));

    Field<Type> expected(a.size());
    forAll(expected, i)
    {
        expected[i] = function(a[i]);
    }

    report<Type>
    (
        "list   ", what, ofField(tmp<Field<Type>>::New(a))(), expected
    );
}


template<class Type>
void checkTensorFunctions(const string& type)
{
    #define CHECK(name)                                                        \
        checkFunction<Type>                                                    \
        (                                                                      \
            #name "(" + type + ")",                                            \
            [](const Type& t) { return Foam::name(t); },                       \
            [](const tmp<Field<Type>>& t) { return Foam::name(t); }            \
        );

    CHECK(dev)
    CHECK(dev2)
    CHECK(cof)
    CHECK(inv)

    #undef CHECK
}


template<class Type>
void checkRotations(const string& type)
{
    const tensor rotation(Field<tensor>(randomField<tensor>(1))[0]);

    checkFunction<Type>
    (
        "transform(tensor, " + type + ")",
        [&](const Type& t) { return transform(rotation, t); },
        [&](const tmp<Field<Type>>& t) { return transform(rotation, t); }
    );
}


int main()
{
    // A time and a mesh that read and write no file
    dictionary control;
    control.set("startTime", 0);
    control.set("endTime", 1);
    control.set("deltaT", 1);
    control.set("writeInterval", 1);
    Time runTime(control, ".", ".", "system", "constant", false, false);

    // A row of cells with one patch
    const label nCells = 7;
    pointField points(4*(nCells + 1));
    forAll(points, pointi)
    {
        points[pointi] =
            vector(pointi/4, pointi % 2, (pointi % 4)/2);
    }

    const auto face4 = [](label a, label b, label c, label d)
    {
        face vertices(4);
        vertices[0] = a;
        vertices[1] = b;
        vertices[2] = c;
        vertices[3] = d;
        return vertices;
    };

    DynamicList<face> faces;
    DynamicList<label> owner;
    labelList neighbour(nCells - 1);

    for (label i = 1; i < nCells; ++i)
    {
        faces.append(face4(4*i, 4*i + 1, 4*i + 3, 4*i + 2));
        owner.append(i - 1);
        neighbour[i - 1] = i;
    }
    for (label i = 0; i < nCells; ++i)
    {
        const label p = 4*i;
        faces.append(face4(p, p + 4, p + 6, p + 2));
        faces.append(face4(p + 1, p + 3, p + 7, p + 5));
        faces.append(face4(p, p + 1, p + 5, p + 4));
        faces.append(face4(p + 2, p + 6, p + 7, p + 3));
        owner.append(labelList(4, i));
    }
    faces.append(face4(0, 2, 3, 1));
    owner.append(0);
    const label last = 4*nCells;
    faces.append(face4(last, last + 1, last + 3, last + 2));
    owner.append(nCells - 1);

    const label nBoundaryFaces = faces.size() - neighbour.size();
    const label start = neighbour.size();

    fvMesh mesh
    (
        IOobject
        (
            polyMesh::defaultRegion, runTime.constant(), runTime,
            IOobject::NO_READ, IOobject::NO_WRITE
        ),
        std::move(points),
        faceList(std::move(faces)),
        labelList(std::move(owner)),
        std::move(neighbour)
    );

    PtrList<polyPatch> patches(1);
    patches.set
    (
        0,
        new polyPatch
        (
            "walls", nBoundaryFaces, start, 0, mesh.boundaryMesh(), "patch"
        )
    );
    mesh.addFvPatches(patches);

    checkProducts<fvPatchField, volMesh>("volume ", mesh);
    checkProducts<fvsPatchField, surfaceMesh>("surface", mesh);
    const pointMesh meshPoints(mesh);
    checkProducts<pointPatchField, pointMesh>("point  ", meshPoints);

    checkListProducts();
    checkTensorFunctions<tensor>("tensor");
    checkTensorFunctions<symmTensor>("symmTensor");
    checkRotations<vector>("vector");
    checkRotations<tensor>("tensor");
    checkRotations<symmTensor>("symmTensor");

    return wrong_;
}

// ************************************************************************* //
