// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

/*---------------------------------------------------------------------------*\
Description
    Products of fields whose loops may run over one piece of memory.

    OpenFOAM declares that the fields of a loop do not overlap (__restrict__ in
    ListLoopM.H), and hands over temporaries that do: the result of a & b takes
    the memory of a temporary of the same type. GCC 12 vectorises the products
    below so that it stores a component of the result before it has read the
    last component of the operand, which is then lost.

    These are the products of the kind: the result has the type of an operand,
    and each of its components needs several of the operand's. Their loops are
    those of OpenFOAM, compiled without the declaration (Make/options).

    The library is loaded before a program (LD_PRELOAD, etc/bashrc), so that
    OpenFOAM's libraries find these products first. A program that has some of
    its own comes before any library: its own lead to these from the start.

    Every other program of the shell loads it too. So it needs no library of
    OpenFOAM (Allwmake makes what it lacks optional), and then does nothing.

\*---------------------------------------------------------------------------*/

#include "volFields.H"
#include "surfaceFields.H"
#include "pointFields.H"
#include "areaFields.H"
#include "edgeFields.H"

#include <cstring>
#include <dlfcn.h>
#include <sys/auxv.h>
#include <sys/mman.h>
#include <unistd.h>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

// Do FUNCTION(name, result, a, b, patch field, mesh) for all products
#define FOR_ALL_PRODUCTS(FUNCTION, PatchField, GeoMesh)                        \
                                                                               \
    FUNCTION(dot, vector, vector, tensor, PatchField, GeoMesh)                 \
    FUNCTION(dot, vector, tensor, vector, PatchField, GeoMesh)                 \
    FUNCTION(dot, vector, vector, symmTensor, PatchField, GeoMesh)             \
    FUNCTION(dot, vector, symmTensor, vector, PatchField, GeoMesh)             \
    FUNCTION(dot, tensor, tensor, tensor, PatchField, GeoMesh)                 \
    FUNCTION(dot, tensor, tensor, symmTensor, PatchField, GeoMesh)             \
    FUNCTION(dot, tensor, symmTensor, tensor, PatchField, GeoMesh)             \
    FUNCTION(cross, vector, vector, vector, PatchField, GeoMesh)

#define FOR_ALL_MESHES(FUNCTION)                                               \
                                                                               \
    FOR_ALL_PRODUCTS(FUNCTION, fvPatchField, volMesh)                          \
    FOR_ALL_PRODUCTS(FUNCTION, fvsPatchField, surfaceMesh)                     \
    FOR_ALL_PRODUCTS(FUNCTION, pointPatchField, pointMesh)                     \
    FOR_ALL_PRODUCTS(FUNCTION, faPatchField, areaMesh)                         \
    FOR_ALL_PRODUCTS(FUNCTION, faePatchField, edgeMesh)

// Fields themselves come from OpenFOAM's libraries, but for the access that
// these have inline
#define LEAVE_FIELD(Type, PatchField, GeoMesh)                                 \
                                                                               \
    extern template class Foam::GeometricField                                 \
    <                                                                          \
        Foam::Type, Foam::PatchField, Foam::GeoMesh                            \
    >;                                                                         \
    template                                                                   \
    Foam::Field<Foam::Type>&                                                   \
    Foam::GeometricField<Foam::Type, Foam::PatchField, Foam::GeoMesh>          \
    ::primitiveFieldRef(const bool);                                           \
    template                                                                   \
    Foam::GeometricField<Foam::Type, Foam::PatchField, Foam::GeoMesh>          \
    ::Boundary&                                                                \
    Foam::GeometricField<Foam::Type, Foam::PatchField, Foam::GeoMesh>          \
    ::boundaryFieldRef(const bool);

#define LEAVE_FIELDS(PatchField, GeoMesh)                                      \
                                                                               \
    LEAVE_FIELD(vector, PatchField, GeoMesh)                                   \
    LEAVE_FIELD(tensor, PatchField, GeoMesh)

LEAVE_FIELDS(fvPatchField, volMesh)
LEAVE_FIELDS(fvsPatchField, surfaceMesh)
LEAVE_FIELDS(pointPatchField, pointMesh)
LEAVE_FIELDS(faPatchField, areaMesh)
LEAVE_FIELDS(faePatchField, edgeMesh)

#define CORRECT(name, Result, A, B, PatchField, GeoMesh)                       \
                                                                               \
    template void Foam::name<Foam::A, Foam::B, Foam::PatchField, Foam::GeoMesh>\
    (                                                                          \
        GeometricField<Result, PatchField, GeoMesh>&,                          \
        const GeometricField<A, PatchField, GeoMesh>&,                         \
        const GeometricField<B, PatchField, GeoMesh>&                          \
    );

FOR_ALL_MESHES(CORRECT)


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

#define ADDRESS(name, Result, A, B, PatchField, GeoMesh)                       \
                                                                               \
    reinterpret_cast<void*>                                                    \
    (                                                                          \
        static_cast                                                            \
        <                                                                      \
            void (*)                                                           \
            (                                                                  \
                Foam::GeometricField                                           \
                <                                                              \
                    Foam::Result, Foam::PatchField, Foam::GeoMesh              \
                >&,                                                            \
                const Foam::GeometricField                                     \
                <                                                              \
                    Foam::A, Foam::PatchField, Foam::GeoMesh                   \
                >&,                                                            \
                const Foam::GeometricField                                     \
                <                                                              \
                    Foam::B, Foam::PatchField, Foam::GeoMesh                   \
                >&                                                             \
            )                                                                  \
        >                                                                      \
        (                                                                      \
            &Foam::name<Foam::A, Foam::B, Foam::PatchField, Foam::GeoMesh>     \
        )                                                                      \
    ),

// Linked so that these are the products of this library (-Bsymbolic-functions)
void* const products[] = { FOR_ALL_MESHES(ADDRESS) };


//- Where the object (program or library) begins that holds this address
void* objectOf(const void* address)
{
    Dl_info found;
    return dladdr(address, &found) ? found.dli_fbase : nullptr;
}


//- Let a function begin with a jump to another. Return success
bool redirect(void* from, void* to)
{
#if defined(__x86_64__)
    // jmp *0(%rip), and the address that it reads
    unsigned char jump[14] = {0xff, 0x25};
    std::memcpy(jump + 6, &to, sizeof(to));
#elif defined(__aarch64__)
    // ldr x16, 8; br x16, and the address that is loaded
    unsigned char jump[16] = {0x50, 0, 0, 0x58, 0, 0x02, 0x1f, 0xd6};
    std::memcpy(jump + 8, &to, sizeof(to));
#else
    return false;
#endif
#if defined(__x86_64__) || defined(__aarch64__)
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    char* code = static_cast<char*>(from);
    char* start = code - reinterpret_cast<std::uintptr_t>(code) % page;
    const std::size_t length = code + sizeof(jump) - start;

    if (mprotect(start, length, PROT_READ | PROT_WRITE | PROT_EXEC))
    {
        return false;
    }

    std::memcpy(code, jump, sizeof(jump));
    __builtin___clear_cache(code, code + sizeof(jump));

    return !mprotect(start, length, PROT_READ | PROT_EXEC);
#endif
}


//- Lead the program's own products to those of this library
__attribute__((constructor)) void correctProgram()
{
    const void* program =
        objectOf(reinterpret_cast<void*>(getauxval(AT_ENTRY)));

    bool failed = false;

    for (void* product : products)
    {
        Dl_info own;
        if (!dladdr(product, &own) || !own.dli_sname)
        {
            continue;
        }

        void* first = dlsym(RTLD_DEFAULT, own.dli_sname);

        if (first && first != product && objectOf(first) == program)
        {
            failed = !redirect(first, product) || failed;
        }
    }

    if (failed)
    {
        const char message[] =
            "morphFoam: this system does not let libmorphCorrectedProducts"
            " change a program in memory.\n"
            "    Products of temporaries in this program are wrong (GCC 12)."
            " Build it with bin/correctedSolver.\n";

        if (write(STDERR_FILENO, message, sizeof(message) - 1) < 0)
        {
            _exit(1);
        }
    }
}

} // End anonymous namespace

// ************************************************************************* //
