/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdCorrection.H"
#include "dictionaryEntries.H"
#include "eigenFields.H"
#include "foamCompat.H"
#include "polyMesh.H"
#include "StringStream.H"
#include "Tuple2.H"

#include <Eigen/Dense>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

// Most steps of Newton's method, which takes about four
static const label mostSteps = 50;

// What a kept number may be off its value by, in units of what the surface
// would change it by if it moved by its own size
static const scalar keptTolerance = 1e-14;

// Of gradients, what tells one from none and one from others
static const scalar independent = 1e-10;


static Eigen::VectorXd asColumn(const morph::Vectors& v)
{
    return Eigen::Map<const Eigen::VectorXd>(v.data(), v.size());
}


static morph::Vectors asRows(const Eigen::VectorXd& v)
{
    return Eigen::Map<const morph::Vectors>(v.data(), v.size()/3, 3);
}


//- The same on all ranks, of the size that it has on the master
static void broadcast(morph::Matrix& a)
{
    label rows = a.rows();
    label columns = a.cols();
    foamCompat::broadcast(rows);
    foamCompat::broadcast(columns);
    scalarList values(rows*columns);
    if (Pstream::master())
    {
        std::copy(a.data(), a.data() + a.size(), values.begin());
    }
    foamCompat::broadcast(values);
    a = Eigen::Map<const morph::Matrix>(values.cdata(), rows, columns);
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdCorrection::ffdCorrection
(
    const dictionary& dict,
    const ffdBox& box,
    const pointField& points,
    const faceList& faces
)
:
    dict_(dict),
    box_(box),
    surface_(points, faces)
{
    const bool closed = surface_.closed();
    if (Pstream::master())
    {
        for (const entry& e : dict_)
        {
            const bool reserved =
                e.keyword() == "patches" || e.keyword() == "free";
            if (reserved)
            {
                continue;
            }
            if (!e.isDict())
            {
                FatalIOErrorInFunction(dict_)
                    << "Entry '" << e.keyword() << "' of 'keep' has to be the"
                    << " dictionary of a number: " << e.keyword()
                    << " { type volume; }" << nl << exit(FatalIOError);
            }
            dictionary number(e.dict());
            number.remove("value");
            if (number.found("min") || number.found("max"))
            {
                FatalIOErrorInFunction(e.dict())
                    << "A number to keep has a 'value', no bounds" << nl
                    << "    Remove 'min' and 'max', or write it into"
                    << " 'constraints'" << nl << exit(FatalIOError);
            }
            numbers_.append
            (
                new shapeConstraint
                (
                    number, surface_.points(), surface_.triangles(), closed
                )
            );
        }
        readNumbers();
        findInside();
    }
    readFreedom();
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdCorrection::readNumbers()
{
    if (numbers_.empty())
    {
        FatalIOErrorInFunction(dict_)
            << "There is nothing to keep" << nl
            << "    Write for example keep { patches (hull); tank { type"
            << " volume; } }" << nl << exit(FatalIOError);
    }
    for (const shapeConstraint& number : numbers_)
    {
        const dictionary& given = dict_.subDict(number.name());
        scalarList values;
        for (const morph::ShapeValue& v : number.values(surface_.points()))
        {
            values.append(v.value);
        }
        if (given.found("value"))
        {
            const label n = values.size();
            values =
                n == 1
              ? scalarList(1, dictionaryChecks::getNumber(given, "value", 0))
              : given.get<scalarList>("value");
            if (values.size() != n)
            {
                FatalIOErrorInFunction(given)
                    << "Entry 'value' lists " << values.size()
                    << " numbers, but '" << number.name() << "' has " << n
                    << ": " << plainText::listed(number.names()).c_str() << nl
                    << "    Give one for each" << nl << exit(FatalIOError);
            }
        }
        names_.append(number.names());
        targets_.insert(targets_.end(), values.begin(), values.end());
    }
}


void Foam::ffdCorrection::readFreedom()
{
    const Eigen::Index n = box_.settings().lattice->size();
    freedom_.setZero(3*n);
    if (!dict_.found("free"))
    {
        freedom_.setOnes();
    }
    else
    {
        const List<Tuple2<labelVector, vector>> given(dict_.lookup("free"));
        for (const Tuple2<labelVector, vector>& one : given)
        {
            const labelList numbers(box_.settings().numbers(one.first()));
            if (numbers.empty() || !(cmptMin(one.second()) >= 0))
            {
                FatalIOErrorInFunction(dict_)
                    << "Entry 'free': "
                    << (
                           numbers.empty()
                         ? "there is no point "
                         : "a negative freedom of point "
                       )
                    << one.first() << " in the lattice of box '"
                    << box_.name() << "'" << nl
                    << "    Write free ( ((i j k) (1 1 1)) ... ), with 0 for a"
                    << " direction in which it stays" << nl
                    << exit(FatalIOError);
            }
            for (const label i : numbers)
            {
                freedom_.segment<3>(3*i) = toEigen(one.second());
            }
        }
    }
    for (const label i : box_.held())
    {
        freedom_.segment<3>(3*i).setZero();
    }
}


void Foam::ffdCorrection::findInside()
{
    const morph::Vectors& x = surface_.points();
    DynamicList<label> inside;
    DynamicList<vector> coordinates;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
    {
        morph::Vector3 xi;
        if (box_.within(x.row(i).transpose(), xi))
        {
            inside.append(i);
            coordinates.append(toFoam(xi));
        }
    }
    inside_.transfer(inside);
    rows_ = box_.settings().lattice->rows(asVectors(coordinates));
}


morph::Vectors Foam::ffdCorrection::moved(const morph::Vectors& control) const
{
    morph::Vectors x(surface_.points());
    const morph::Vectors d =
        box_.settings().lattice->displacement(rows_, control);
    forAll(inside_, i)
    {
        const morph::Vector3 rest = x.row(inside_[i]).transpose();
        x.row(inside_[i]) += box_.settings().frame->displacement
        (
            rest, d.row(i).transpose()
        ).transpose();
    }
    return x;
}


Eigen::VectorXd Foam::ffdCorrection::off
(
    const morph::Vectors& control,
    morph::Matrix& gradient
) const
{
    const morph::FfdFrame& frame = *box_.settings().frame;
    const morph::FfdLattice& lattice = *box_.settings().lattice;
    const morph::Vectors x = moved(control);
    const morph::Vectors d =
        frame.radial() ? lattice.displacement(rows_, control)
      : morph::Vectors();
    labelList place(x.rows(), -1);
    forAll(inside_, i)
    {
        place[inside_[i]] = i;
    }

    const Eigen::Index n = targets_.size();
    Eigen::VectorXd open(n);
    gradient.resize(n, freedom_.size());
    Eigen::Index row = 0;
    for (const shapeConstraint& number : numbers_)
    {
        for (const morph::ShapeValue& v : number.values(x))
        {
            morph::Vectors byPoint = morph::Vectors::Zero(inside_.size(), 3);
            for (const auto& term : v.gradient)
            {
                const label i = place[term.first];
                if (i < 0)
                {
                    continue;
                }
                morph::Vector3 g = term.second;
                if (frame.radial())
                {
                    g = frame.displacementByLattice
                    (
                        surface_.points().row(inside_[i]).transpose(),
                        d.row(i).transpose()
                    ).transpose()*g;
                }
                byPoint.row(i) += g.transpose();
            }
            gradient.row(row) =
                asColumn(lattice.transposed(rows_, byPoint)).transpose();
            open[row] = v.value - targets_[std::size_t(row)];
            ++row;
        }
    }
    return open;
}


Foam::string Foam::ffdCorrection::dependence
(
    const morph::Matrix& gradient
) const
{
    // Each in units of what it would be if all points were free
    morph::Matrix scaled = gradient*freedom_.cwiseSqrt().asDiagonal();
    const scalar most = max(freedom_.maxCoeff(), VSMALL);
    for (Eigen::Index i = 0; i < scaled.rows(); ++i)
    {
        const scalar size = gradient.row(i).norm()*Foam::sqrt(most);
        if (!(scaled.row(i).norm() > independent*size))
        {
            return
                "Entry 'keep': no free control point of box '" + box_.name()
              + "' changes '" + names_[i] + "'\n    Free other points, or let"
                " the box reach the surface";
        }
        scaled.row(i) /= scaled.row(i).norm();
    }
    const Eigen::JacobiSVD<morph::Matrix> svd(scaled.transpose());
    const auto& values = svd.singularValues();
    const bool enough = scaled.rows() <= scaled.cols();
    if (enough && values[values.size() - 1] > independent)
    {
        return string();
    }
    return
        "Entry 'keep': the free control points of box '" + box_.name()
      + "' cannot change " + plainText::listed(names_)
      + " apart from each other\n    Keep fewer numbers, or free more points";
}


Foam::string Foam::ffdCorrection::solve
(
    const morph::Vectors& control,
    morph::Vectors& correction
)
{
    if (ways_.size() == 0)
    {
        morph::Matrix atRest;
        off(morph::Vectors::Zero(control.rows(), 3), atRest);
        const string fault(dependence(atRest));
        if (!fault.empty())
        {
            return fault;
        }
        ways_ = freedom_.asDiagonal()*atRest.transpose();
    }

    const morph::Vectors& x = surface_.points();
    const scalar span =
        (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
    Eigen::VectorXd lambda = Eigen::VectorXd::Zero(ways_.cols());
    Eigen::VectorXd best;
    scalar least = GREAT;
    for (label step = 0; step < mostSteps; ++step)
    {
        const morph::Vectors way = asRows(ways_*lambda);
        const Eigen::VectorXd open = off(control + way, gradient_);
        const Eigen::VectorXd size =
            gradient_.rowwise().lpNorm<1>()*span;
        const scalar worst = open.cwiseQuotient
        (
            size.cwiseMax(VSMALL)
        ).cwiseAbs().maxCoeff();
        if (!(worst < GREAT))
        {
            break;
        }

        // Round-off: as near as it gets
        const bool done =
            worst <= keptTolerance
         || (worst <= 100*keptTolerance && worst >= least);
        if (worst < least)
        {
            least = worst;
            best = open;
            correction = way;
        }
        if (done)
        {
            return string();
        }
        const morph::Matrix J = gradient_*ways_;
        lambda -= J.fullPivLu().solve(open);
    }

    OStringStream reached;
    forAll(names_, i)
    {
        const scalar target = targets_[std::size_t(i)];
        const scalar apart = best.size() ? best[i] : GREAT;
        reached
            << (i ? ", " : "") << names_[i] << ' ' << target + apart
            << " in place of " << target << ", off by " << mag(apart);
    }
    OStringStream message;
    message
        << "Entry 'keep' of box '" << box_.name() << "' cannot be met: as near"
        << " as it gets, " << reached.str().c_str() << nl
        << "    Make the values of the parameters smaller, free more control"
        << " points, or ask for a value nearer to that at rest";
    return message.str();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::faceList Foam::ffdCorrection::faces
(
    const dictionary& dict,
    const polyMesh& mesh
)
{
    const polyBoundaryMesh& boundary = mesh.boundaryMesh();
    wordList names(boundary.names());
    names.setSize(boundary.nNonProcessor());
    DynamicList<face> faces;
    for
    (
        const label patchi : dictionaryChecks::select(dict, "patches", names)
    )
    {
        faces.append(boundary[patchi]);
    }
    return faceList(std::move(faces));
}


morph::Vectors Foam::ffdCorrection::correction(const morph::Vectors& control)
{
    morph::Vectors correction = morph::Vectors::Zero(control.rows(), 3);
    string fault;
    if (Pstream::master())
    {
        fault = solve(control, correction);
    }
    dictionaryChecks::stopIf(dict_, fault);
    morph::Matrix rows = correction;
    broadcast(rows);
    broadcast(ways_);
    broadcast(gradient_);
    return rows;
}


morph::Vectors Foam::ffdCorrection::derivative
(
    const morph::Vectors& control
) const
{
    const morph::Matrix J = gradient_*ways_;
    const Eigen::VectorXd change = gradient_*asColumn(control);
    return control - asRows(ways_*J.fullPivLu().solve(change));
}


// ************************************************************************* //
