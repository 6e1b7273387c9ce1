/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "surfaceFile.H"
#include "finiteNumbers.H"
#include "IFstream.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "throwing.H"
#include "untrapped.H"
#include "wholeFile.H"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <sstream>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace surfaceFile
{

//- Of a name with .gz the one before: streams decompress by themselves
static fileName uncompressed(const fileName& path)
{
    return path.ext() == "gz" ? path.lessExt() : path;
}


//- What is wrong with a line "v x y z ..."
static string vertexFault(std::istringstream& line)
{
    point x;
    for (scalar& component : x)
    {
        std::string word;
        line >> word;
        if (!readScalar(word, component))
        {
            return "a vertex has three numbers, x y z";
        }
    }
    return string();
}


//- What is wrong with a line "f a b c ...", each with or without "/..."
static string faceFault(std::istringstream& line, const label nVertices)
{
    std::string corner;
    label n = 0;
    for (; line >> corner; ++n)
    {
        label vertex;
        if (!readLabel(corner.substr(0, corner.find('/')), vertex))
        {
            return "a face has numbers of vertices, not '" + corner + "'";
        }
        if (vertex < 1 || vertex > nVertices)
        {
            return
                "a face has vertex " + std::to_string(vertex) + ", but there"
                " are those from 1 to " + std::to_string(nVertices)
              + " (numbers that count backwards are not supported)";
        }
    }
    return n < 3 ? "a face has at least three vertices" : string();
}


//- Faces may name vertices that the file lists later
static string faultOfOBJ(const fileName& path)
{
    label nVertices = 0;
    for (const bool count : {true, false})
    {
        IFstream is(uncompressed(path));
        for (label number = 1; is.good(); ++number)
        {
            string text;
            is.getLine(text);
            std::istringstream line(text);
            std::string what;
            line >> what;
            string fault;
            if (what == "v" && count)
            {
                ++nVertices;
                fault = vertexFault(line);
            }
            else if (what == "f" && !count)
            {
                fault = faceFault(line, nVertices);
            }
            if (!fault.empty())
            {
                return path + ", line " + std::to_string(number) + ": " + fault;
            }
        }
    }
    return string();
}


//- OpenFOAM's reader takes what is missing at the end from what it read before
static string faultOfBinarySTL(const fileName& path)
{
    std::ifstream is(path, std::ios::binary);
    char header[80];
    is.read(header, sizeof(header));
    std::int32_t n = 0;
    is.read(reinterpret_cast<char*>(&n), sizeof(n));
    const double expected = 84 + 50*double(n);
    return
        is && n >= 0 && expected <= double(fileSize(path))
      ? string()
      : string
        (
            path + ": it has " + std::to_string(fileSize(path))
          + " bytes, but a binary surface of " + std::to_string(n)
          + " triangles has " + std::to_string(std::int64_t(expected))
        );
}


//- OpenFOAM's reader ends the program where a line is not what it expects
static string faultOfTextSTL(const fileName& path)
{
    IFstream is(uncompressed(path));
    label corners = -1;
    for (label number = 1; is.good(); ++number)
    {
        string text;
        is.getLine(text);
        std::transform(text.begin(), text.end(), text.begin(), ::tolower);
        std::istringstream line(text);
        std::string what;
        line >> what;
        string fault;
        if (what == "outer")
        {
            corners = 0;
        }
        else if (what == "vertex")
        {
            fault =
                corners < 0 || corners > 2 ? "a vertex belongs to no triangle"
              : vertexFault(line);
            ++corners;
        }
        else if (what == "endloop")
        {
            fault =
                corners == 3 ? ""
              : "a triangle has " + std::to_string(max(corners, label(0)))
              + " vertices";
            corners = -1;
        }
        else if (corners >= 0 && !what.empty())
        {
            fault = "'" + what + "' stands between the vertices of a triangle";
        }
        else if
        (
            !what.empty() && what != "solid" && what != "endsolid"
         && what != "facet" && what != "endfacet" && what != "color"
        )
        {
            fault = "'" + what + "' is no word of such a file";
        }
        if (!fault.empty())
        {
            return path + ", line " + std::to_string(number) + ": " + fault;
        }
    }
    return
        corners < 0 ? string()
      : string(path + ": it ends within a triangle");
}


//- A binary file has no word to begin with, but the size that it says
static string faultOfSTL(const fileName& path)
{
    string first;
    IFstream(uncompressed(path))().getLine(first);
    const bool solid =
        first.find_first_not_of(" \t") != string::npos
     && first.substr(first.find_first_not_of(" \t"), 5) == "solid";
    return
        !solid && (path.ext() == "gz" || faultOfBinarySTL(path).empty())
      ? string() : faultOfTextSTL(path);
}


static string faultOf(const fileName& path, const triSurface& surface)
{
    if (surface.empty())
    {
        return path + ": the surface is empty, it has no triangles";
    }
    const pointField& x = surface.points();
    forAll(x, i)
    {
        if (!finiteNumbers::usable(x[i]))
        {
            OStringStream text;
            text<< path.c_str() << ": vertex " << i + 1 << " of " << x.size()
                << " is at " << x[i] << ", which is no position";
            return text.str();
        }
    }
    forAll(surface, i)
    {
        for (const label vertex : surface[i])
        {
            if (vertex < 0 || vertex >= x.size())
            {
                return
                    path + ": triangle " + std::to_string(i + 1) + " of "
                  + std::to_string(surface.size()) + " has vertex "
                  + std::to_string(vertex) + ", but there are "
                  + std::to_string(x.size());
            }
        }
    }
    return string();
}


//- By OpenFOAM's reader, whose errors become messages
static autoPtr<triSurface> readBy(const fileName& path, string& wrong)
{
    autoPtr<triSurface> surface(nullptr);
    try
    {
        const throwing errors;
        surface.reset(new triSurface(path));
    }
    catch (const Foam::error& fault)
    {
        wrong = path + ": " + said(fault);
    }
    catch (const std::exception&)
    {
        wrong = path + ": a number of triangles or vertices in it is wrong";
    }
    return surface;
}

} // End namespace surfaceFile
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::autoPtr<Foam::triSurface> Foam::surfaceFile::read
(
    const fileName& path,
    string& wrong
)
{
    const untrapped numbers;
    wrong =
        uncompressed(path).ext() == "obj" ? faultOfOBJ(path)
      : path.ext() == "stlb" ? faultOfBinarySTL(path)
      : uncompressed(path).ext() == "stl" ? faultOfSTL(path)
      : string();
    if (!wrong.empty())
    {
        return nullptr;
    }
    autoPtr<triSurface> surface(readBy(path, wrong));
    if (surface.valid())
    {
        wrong = faultOf(path, surface());
    }
    return wrong.empty() ? std::move(surface) : autoPtr<triSurface>(nullptr);
}


Foam::string Foam::surfaceFile::write
(
    const fileName& path,
    const triSurface& surface
)
{
    // Writers of OpenFOAM do not tell whether they succeeded: read it back
    return wholeFile::writeBy
    (
        path,
        [&](const fileName& written)
        {
            surface.write(written, true);
            string wrong;
            const autoPtr<triSurface> there(read(written, wrong));
            return there.valid() && there->size() == surface.size();
        }
    );
}


// ************************************************************************* //
