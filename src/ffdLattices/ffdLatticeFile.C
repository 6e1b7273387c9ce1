/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdLatticeFile.H"
#include "dictionaryEntries.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "StringStream.H"

#include <cmath>
#include <cstdlib>
#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static string contents(const fileName& file)
{
    // Also compressed
    IFstream is(file);
    std::ostringstream text;
    text << is.stdStream().rdbuf();
    return text.str();
}


// The numbers of a text; false where something else stands
static bool numbers(const string& text, std::vector<double>& values)
{
    const char* c = text.c_str();
    while (true)
    {
        while (std::isspace(static_cast<unsigned char>(*c)) || *c == ',')
        {
            ++c;
        }
        if (!*c)
        {
            return true;
        }
        char* end = nullptr;
        const double value = std::strtod(c, &end);
        if (end == c || !std::isfinite(value) || std::abs(value) > 1e60)
        {
            return false;
        }
        values.push_back(value);
        c = end;
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdLatticeFile::ffdLatticeFile(const dictionary& dict)
:
    dict_(dict),
    file_(dict.get<fileName>("file")),
    order_(Zero)
{
    fileName path(file_);
    path.expand();
    if (!path.isAbsolute() && !isFile(path) && !getEnv("FOAM_CASE").empty())
    {
        path = getEnv("FOAM_CASE")/path;
    }
    if (!isFile(path))
    {
        wrong("is not there", "Give the path of one, relative to the case");
    }
    const string text(contents(path));
    const word ext(file_.ext() == "gz" ? file_.lessExt().ext() : file_.ext());
    if (ext == "csv" || ext == "txt" || ext == "dat")
    {
        readTable(text);
    }
    else
    {
        readPlot3d(text);
    }
    if (dict.found("order") && dict.get<labelVector>("order") != order_)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'order' is " << dict.get<labelVector>("order")
            << " but the lattice in " << file_ << " has " << order_ << nl
            << "    Leave it out: it is that of the file" << nl
            << exit(FatalIOError);
    }
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::ffdLatticeFile::wrong
(
    const string& fact,
    const string& remedy
) const
{
    FatalIOErrorInFunction(dict_)
        << "Lattice file " << file_ << ' ' << fact.c_str() << nl
        << "    " << remedy.c_str() << nl << exit(FatalIOError);
}


void Foam::ffdLatticeFile::checkSizes(const labelVector& sizes) const
{
    const bool good =
        cmptMin(sizes) >= 2
     && scalar(sizes.x())*scalar(sizes.y())*scalar(sizes.z()) < 1e6;
    if (!good)
    {
        OStringStream fact;
        fact<< "has a lattice of " << sizes << " points";
        wrong
        (
            fact.str(),
            "In each direction there have to be two at least, and a million"
            " at most in all"
        );
    }
}


void Foam::ffdLatticeFile::readPlot3d(const string& text)
{
    std::vector<double> values;
    if (!numbers(text, values) || values.size() < 3)
    {
        wrong
        (
            "has something else than numbers, or none",
            "Formatted PLOT3D is: number of blocks; sizes; all x, y, z of each"
            " block. Tables are told by the extensions csv, txt and dat"
        );
    }

    // One block may do without their number: then its three sizes are all
    const auto fits = [&](std::size_t header)
    {
        return
            values.size() >= header
         && double(values.size() - header)
         == 3*values[header - 3]*values[header - 2]*values[header - 1];
    };
    const bool bare = fits(3) && !fits(4);
    const double nBlocks = bare ? 1 : values[0];
    const std::size_t first = bare ? 0 : 1;
    const bool counted =
        nBlocks >= 1 && nBlocks == std::floor(nBlocks)
     && double(values.size()) > 3*nBlocks + 1;
    if (!counted)
    {
        wrong
        (
            "does not begin with a number of blocks and their sizes",
            "Formatted PLOT3D is: number of blocks; sizes; all x, y, z of each"
            " block"
        );
    }

    const label block = label(dictionaryChecks::getNumber(dict_, "block", -1));
    if (block >= label(nBlocks) || (block < 0 && nBlocks > 1))
    {
        OStringStream fact;
        fact<< "has " << label(nBlocks) << " blocks"
            << (block < 0 ? "" : ": there is no block ");
        if (block >= 0)
        {
            fact<< block;
        }
        OStringStream remedy;
        remedy << "Say which with 'block', from 0 to " << label(nBlocks) - 1
            << "; write a box for each";
        wrong(fact.str(), remedy.str());
    }

    std::size_t from = first + 3*std::size_t(nBlocks);
    for (label i = 0; i < label(nBlocks); ++i)
    {
        labelVector sizes(Zero);
        for (direction d = 0; d < 3; ++d)
        {
            const double n = values[first + 3*std::size_t(i) + d];
            sizes[d] = n > 0 && n < 1e6 ? label(n) : 0;
        }
        checkSizes(sizes);
        const std::size_t n = std::size_t(cmptProduct(sizes));
        if (from + 3*n > values.size())
        {
            OStringStream fact;
            fact<< "ends in block " << i << ": it has "
                << label(values.size() - from) << " of the " << label(3*n)
                << " numbers of " << sizes << " points";
            wrong(fact.str(), "The lattice has holes; write the whole of it");
        }
        if (i == max(block, label(0)))
        {
            order_ = sizes - labelVector::one;
            points_.setSize(label(n));
            forAll(points_, p)
            {
                for (direction d = 0; d < 3; ++d)
                {
                    points_[p][d] = values[from + n*d + std::size_t(p)];
                }
            }
        }
        from += 3*n;
    }
    if (from != values.size())
    {
        OStringStream fact;
        fact<< "has " << label(values.size() - from)
            << " numbers more than its sizes say";
        wrong(fact.str(), "Blanking is not read; write x, y and z alone");
    }
}


void Foam::ffdLatticeFile::readTable(const string& text)
{
    std::istringstream lines(text);
    std::string line;
    DynamicList<labelVector> places;
    DynamicList<point> positions;
    label lineNumber = 0;
    labelVector sizes(Zero);
    while (std::getline(lines, line))
    {
        ++lineNumber;
        const auto begin = line.find_first_not_of(" \t\r,");
        const bool isRow =
            begin != std::string::npos
         && (std::isdigit(static_cast<unsigned char>(line[begin])));
        if (!isRow)
        {
            continue;
        }
        std::vector<double> row;
        bool good = numbers(line, row) && row.size() == 6;
        for (std::size_t d = 0; good && d < 3; ++d)
        {
            good = row[d] >= 0 && row[d] < 1e6 && row[d] == std::floor(row[d]);
        }
        if (!good)
        {
            OStringStream fact;
            fact<< "has no row i j k x y z in line " << lineNumber;
            wrong(fact.str(), "Indices begin at 0");
        }
        places.append(labelVector(label(row[0]), label(row[1]), label(row[2])));
        positions.append(point(row[3], row[4], row[5]));
        sizes = max(sizes, places.last() + labelVector::one);
    }
    checkSizes(sizes);

    order_ = sizes - labelVector::one;
    points_.setSize(cmptProduct(sizes));
    boolList found(points_.size(), false);
    forAll(places, i)
    {
        const labelVector& p = places[i];
        const label number = p.x() + sizes.x()*(p.y() + sizes.y()*p.z());
        if (found[number])
        {
            OStringStream fact;
            fact<< "has point " << p << " twice";
            wrong(fact.str(), "Remove one of its rows");
        }
        found[number] = true;
        points_[number] = positions[i];
    }
    const label hole = found.find(false);
    if (hole >= 0)
    {
        OStringStream fact;
        fact<< "has holes: of " << sizes << " points, "
            << labelVector
               (
                   hole % sizes.x(),
                   hole/sizes.x() % sizes.y(),
                   hole/(sizes.x()*sizes.y())
               )
            << " is the first that is missing";
        wrong(fact.str(), "Indices run from 0 to sizes less one, each once");
    }
}


// ************************************************************************* //
