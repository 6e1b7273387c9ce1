/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "morphMetric.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "eigenFields.H"
#include "gradScheme.H"
#include "metricFields.H"
#include "metricGradation.H"
#include "plainText.H"
#include "pstreamCommunicator.H"
#include "reproducibleSum.hpp"
#include "StringStream.H"
#include "volFields.H"
#include "zeroGradientFvPatchFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
namespace functionObjects
{
    defineTypeNameAndDebug(morphMetric, 0);
    addToRunTimeSelectionTable(functionObject, morphMetric, dictionary);
}
}


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Eigenvalues of |H| below this fraction of the largest do not count: sizes
// there are those of hMax
static const scalar flat = 1e-9;

// To which the complexity is met, and after how many tries at the latest
static const scalar near = 0.01;
static const label mostTries = 20;


template<class Type>
static auto gradient
(
    const GeometricField<Type, fvPatchField, volMesh>& field,
    const word& name
)
{
    IStringStream scheme("leastSquares");
    return fv::gradScheme<Type>::New(field.mesh(), scheme)().grad(field, name);
}


//- Above zero, and a number
static scalar positive(const dictionary& dict, const word& key, const scalar otherwise)
{
    const scalar value = dict.getOrDefault<scalar>(key, otherwise);
    if (!(value > 0 && value < GREAT))
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << value << nl
            << "    Use a number above 0" << nl << exit(FatalIOError);
    }
    return value;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::functionObjects::morphMetric::morphMetric
(
    const word& name,
    const Time& runTime,
    const dictionary& dict
)
:
    fvMeshFunctionObject(name, runTime, dict)
{
    read(dict);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

morph::Basis Foam::functionObjects::morphMetric::basis() const
{
    const Vector<label>& counts = mesh_.geometricD();
    morph::Basis directions(3, mesh_.nGeometricD());
    for (direction i = 0, column = 0; i < 3; ++i)
    {
        if (counts[i] > 0)
        {
            directions.col(column++) = morph::Vector3::Unit(i);
        }
    }
    return directions;
}


Foam::scalar Foam::functionObjects::morphMetric::span() const
{
    return mesh_.bounds().mag();
}


std::vector<Foam::functionObjects::morphMetric::metricList>
Foam::functionObjects::morphMetric::hessians(const word& name) const
{
    std::vector<metricList> found;
    const auto add = [&](const volScalarField& component)
    {
        const auto first = gradient(component, "grad(" + name + ')');
        const auto second = gradient(first(), "grad(grad(" + name + "))");
        metricList mine;
        for (const tensor& t : second().primitiveField())
        {
            mine.push_back(toMetric(symm(t)));
        }
        found.push_back(mine);
    };
    if (mesh_.foundObject<volScalarField>(name))
    {
        add(mesh_.lookupObject<volScalarField>(name));
        return found;
    }
    if (mesh_.foundObject<volVectorField>(name))
    {
        const auto& field = mesh_.lookupObject<volVectorField>(name);
        for (direction i = 0; i < vector::nComponents; ++i)
        {
            if (mesh_.solutionD()[i] > 0)
            {
                add(field.component(i));
            }
        }
        return found;
    }
    FatalIOErrorInFunction(dict_)
        << "There is no volume field of scalars or vectors '" << name << "'"
        << nl << "    There are: "
        << plainText::listed
           (
               mesh_.sortedNames<volScalarField>()
           ).c_str()
        << "; " << plainText::listed(mesh_.sortedNames<volVectorField>()).c_str()
        << nl << exit(FatalIOError);
    return found;
}


Foam::functionObjects::morphMetric::metricList
Foam::functionObjects::morphMetric::optimal(const morph::Basis& basis) const
{
    const scalar d = basis.cols();
    const scalar across = 1/sqr(span());
    metricList total;
    for (const word& name : fields_)
    {
        for (metricList& metrics : hessians(name))
        {
            scalar largest = 0;
            for (const morph::Metric& h : metrics)
            {
                largest = max
                (
                    largest,
                    morph::Metric
                    (
                        basis*basis.transpose()*h*basis*basis.transpose()
                    ).norm()
                );
            }
            reduce(largest, maxOp<scalar>());
            const bool usable = largest > 0 && largest < GREAT;
            if (!usable)
            {
                // Uniform, or linear: as coarse as may be
                largest = across;
            }
            for (morph::Metric& m : metrics)
            {
                m = morph::optimal
                (
                    morph::absolute
                    (
                        usable ? m : morph::Metric(morph::Metric::Zero()),
                        basis,
                        flat*largest
                    ),
                    basis,
                    norm_
                );
                for (direction i = 0; i < 3; ++i)
                {
                    if (mesh_.geometricD()[i] < 0)
                    {
                        m.row(i).setZero();
                        m.col(i).setZero();
                        m(i, i) = 1/sqr(max(mesh_.bounds().span()[i], VSMALL));
                    }
                }
            }

            // To the same complexity before they are intersected
            const scalar now = complexity(metrics, basis);
            const scalar factor = std::pow(1/now, 2/d);
            for (std::size_t i = 0; i < metrics.size(); ++i)
            {
                const morph::Metric within = basis*basis.transpose();
                morph::Metric& m = metrics[i];
                m += (factor - 1)*within*m*within;
                if (total.size() < metrics.size())
                {
                    total.push_back(m);
                }
                else
                {
                    total[i] = morph::intersection(total[i], m);
                }
            }
        }
    }
    return total;
}


Foam::scalar Foam::functionObjects::morphMetric::complexity
(
    const metricList& metrics,
    const morph::Basis& basis
) const
{
    const scalar thickness = [&]
    {
        scalar t = 1;
        for (direction i = 0; i < 3; ++i)
        {
            t *= mesh_.geometricD()[i] < 0 ? mesh_.bounds().span()[i] : 1;
        }
        return t;
    }();
    std::vector<double> terms(metrics.size());
    for (std::size_t i = 0; i < metrics.size(); ++i)
    {
        terms[i] =
            std::sqrt(max(morph::determinant(metrics[i], basis), 0.0))
           *mesh_.V()[i]/thickness;
    }
    pstreamCommunicator communicator;
    return morph::reproducibleSum(terms.data(), terms.size(), communicator);
}


Foam::functionObjects::morphMetric::metricList
Foam::functionObjects::morphMetric::scaled
(
    const metricList& metrics,
    const morph::Basis& basis,
    const scalar factor,
    const metricGradation& gradation
) const
{
    const morph::Metric within = basis*basis.transpose();
    metricList result(metrics);
    for (morph::Metric& m : result)
    {
        m += (factor - 1)*within*m*within;
        m = morph::bounded(m, basis, hMin_, hMax_);
    }
    if (gradation_ > 1)
    {
        // Where directions differ an intersection is finer than either
        gradation.grade(result, gradation_);
        for (morph::Metric& m : result)
        {
            m = morph::bounded(m, basis, hMin_, hMax_);
        }
    }
    return result;
}


Foam::volSymmTensorField& Foam::functionObjects::morphMetric::field
(
    const word& name,
    const dimensionSet& dimensions
) const
{
    if (!mesh_.foundObject<volSymmTensorField>(name))
    {
        auto* made = new volSymmTensorField
        (
            IOobject
            (
                name,
                time_.timeName(),
                mesh_,
                IOobject::NO_READ,
                IOobject::NO_WRITE
            ),
            mesh_,
            dimensionedSymmTensor(dimensions, Zero),
            zeroGradientFvPatchField<symmTensor>::typeName
        );
        regIOobject::store(made);
    }
    return mesh_.lookupObjectRef<volSymmTensorField>(name);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

bool Foam::functionObjects::morphMetric::read(const dictionary& dict)
{
    fvMeshFunctionObject::read(dict);
    dict_ = dict;
    if (dict.found("field") == dict.found("fields"))
    {
        FatalIOErrorInFunction(dict)
            << (dict.found("field") ? "Both entries" : "Neither entry")
            << " 'field' and 'fields' is there, of which there has to be one"
            << nl << "    Use 'field p;' or 'fields (p U);'" << nl
            << exit(FatalIOError);
    }
    fields_ =
        dict.found("field")
      ? wordList(1, dict.get<word>("field"))
      : dict.get<wordList>("fields");
    if (fields_.empty())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'fields' is empty" << nl
            << "    Name a volume field" << nl << exit(FatalIOError);
    }
    complexity_ =
        dict.found("cells") ? positive(dict, "cells", 1) : scalar(-1);
    norm_ = positive(dict, "norm", 2);
    if (norm_ < 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'norm' is " << norm_ << nl
            << "    Use a number from 1" << nl << exit(FatalIOError);
    }
    hMin_ = positive(dict, "hMin", 1e-6*span());
    hMax_ = positive(dict, "hMax", span());
    if (hMin_ > hMax_)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'hMin', " << hMin_ << " m, is larger than hMax, " << hMax_
            << " m" << nl << "    Use a smaller hMin" << nl
            << exit(FatalIOError);
    }
    gradation_ = 1.5;
    if (dict.found("gradation"))
    {
        const token first(dict.lookup("gradation"));
        const bool none = first.isWord() && first.wordToken() == "none";
        gradation_ = first.isNumber() ? first.number() : 0;
        if (!none && !(gradation_ > 1 && gradation_ < GREAT))
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'gradation' is neither none nor a number above 1" << nl
                << "    Use none, or a factor such as 1.5" << nl
                << exit(FatalIOError);
        }
    }
    result_ = dict.getOrDefault<word>("result", "metric");
    return true;
}


bool Foam::functionObjects::morphMetric::execute()
{
    const morph::Basis directions(basis());
    const scalar d = directions.cols();
    const scalar wanted =
        complexity_ > 0
      ? complexity_
      : scalar(returnReduce(mesh_.nCells(), sumOp<label>()));

    const metricList unit(optimal(directions));
    const metricGradation gradation(mesh_);
    scalar factor = std::pow(wanted, 2/d);
    metricList metrics(scaled(unit, directions, factor, gradation));
    scalar made = complexity(metrics, directions);
    for (label i = 0; mag(made/wanted - 1) > near && i < mostTries; ++i)
    {
        factor *= std::pow(wanted/made, 2/d);
        metrics = scaled(unit, directions, factor, gradation);
        const scalar now = complexity(metrics, directions);
        if (mag(now/made - 1) < 1e-6)
        {
            break;
        }
        made = now;
    }

    volSymmTensorField& metric = field(result_, dimless/dimArea);
    volSymmTensorField& size = field(result_ + "Size", dimLength);
    scalar least = GREAT;
    scalar most = 0;
    scalar aspect = 1;
    forAll(metric, celli)
    {
        const morph::Metric& m = metrics[celli];
        metric[celli] = toTensor(m);
        size[celli] = toTensor
        (
            morph::spectral(m, [](const double x) { return 1/std::sqrt(x); })
        );
        const morph::Sizes h = morph::sizes(m, directions);
        least = min(least, h.least);
        most = max(most, h.most);
        aspect = max(aspect, h.most/h.least);
    }
    metric.correctBoundaryConditions();
    size.correctBoundaryConditions();
    reduce(least, minOp<scalar>());
    reduce(most, maxOp<scalar>());
    reduce(aspect, maxOp<scalar>());

    using plainText::rounded;
    Log << type() << ' ' << name() << ": complexity " << rounded(made).c_str()
        << ", sizes from " << rounded(least).c_str() << " to "
        << rounded(most).c_str() << " m, largest ratio of two in a cell "
        << rounded(aspect).c_str() << endl;
    if (mag(made/wanted - 1) > 2*near)
    {
        WarningInFunction
            << "The complexity is " << made << " where 'cells' is " << wanted
            << ": hMin, hMax or gradation do not allow it" << nl
            << "    Widen these, or use 'cells " << label(made) << "'" << endl;
    }
    return true;
}


bool Foam::functionObjects::morphMetric::write()
{
    for (const word& name : {result_, word(result_ + "Size")})
    {
        volSymmTensorField& written =
            mesh_.lookupObjectRef<volSymmTensorField>(name);
        written.instance() = time_.timeName();
        written.write();
    }
    return true;
}


// ************************************************************************* //
