/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "fileDisplacement.H"
#include "addToRunTimeSelectionTable.H"
#include "dictionaryChecks.H"
#include "finiteNumbers.H"
#include "foamCompat.H"
#include "OSspecific.H"
#include "StringStream.H"
#include "Time.H"
#include "untrapped.H"

#include <fstream>
#include <sstream>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(fileDisplacement, 0);
    addToRunTimeSelectionTable
    (
        prescribedDisplacement,
        fileDisplacement,
        dictionary
    );
}

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::fileDisplacement::fileDisplacement
(
    const dictionary& dict,
    const polyMesh& mesh,
    const labelList& patches,
    const label nListed
)
:
    tabulatedDisplacement(dict, mesh, {"file", "tolerance"}),
    table_(nullptr),
    values_(),
    tolerance_(0)
{
    fileName file(dict.get<fileName>("file"));
    file.expand();
    read(file.isAbsolute() ? file : mesh.time().globalPath()/file);

    tolerance_ =
        dict.found("tolerance")
      ? dictionaryChecks::getPositive(dict, "tolerance")
      : 1e-6*(table_->span() > 0 ? table_->span() : mesh.bounds().mag());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::fileDisplacement::read(const fileName& file)
{
    DynamicList<vector> positions, values;
    string message;

    if (Pstream::master())
    {
        const untrapped numbers;
        std::ifstream stream(file);
        if (!stream || !isFile(file))
        {
            message = "Entry 'file': cannot read " + file;
        }
        std::string line;
        for (label number = 1; std::getline(stream, line); ++number)
        {
            const auto first = line.find_first_not_of(" \t\r");
            if (first == std::string::npos || line[first] == '#')
            {
                continue;
            }
            vector x, d;
            std::string rest;
            std::istringstream is(line);
            is  >> x.x() >> x.y() >> x.z() >> d.x() >> d.y() >> d.z();
            const bool six = is && !(is >> rest);
            if (!six || !finiteNumbers::usable(x) || !finiteNumbers::usable(d))
            {
                message =
                    file + ", line " + std::to_string(number)
                  + ": a line has six numbers, x y z dx dy dz, of metres";
                break;
            }
            positions.append(x);
            values.append(d);
        }
        if (message.empty() && positions.empty())
        {
            message = file + " has no lines x y z dx dy dz";
        }
    }

    dictionaryChecks::stopIf(dict(), message);
    foamCompat::broadcast(positions);
    foamCompat::broadcast(values);
    table_.reset(new positionTable(pointField(positions)));
    values_ = values;
}


// * * * * * * * * * * * * * Protected Member Functions  * * * * * * * * * * //

Foam::tmp<Foam::vectorField> Foam::fileDisplacement::unscaled
(
    const points& p
) const
{
    auto d = tmp<vectorField>::New(p.positions.size(), Zero);
    OStringStream message;
    forAll(p.positions, i)
    {
        const label place = table_->find(p.positions[i], tolerance_);
        if (place >= 0)
        {
            d.ref()[i] = values_[place];
        }
        else if (message.str().empty())
        {
            message
                << "Entry 'file': control points of the group, for example "
                << p.positions[i] << "," << nl << "    have no line in "
                << dict().get<fileName>("file") << " within " << tolerance_
                << " m" << nl
                << "    Add a line for each, or raise 'tolerance'";
        }
    }
    dictionaryChecks::stopIf(dict(), message.str());
    return d;
}


// ************************************************************************* //
