/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdExits.H"

// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::string Foam::ffdExits::faceName(const label face)
{
    const char* names[] = {"s = 0", "t = 0", "p = 0", "s = 1", "t = 1", "p = 1"};
    return names[face];
}


void Foam::ffdExits::add(const faceFlags& on, const faceFlags& through)
{
    label way = 0;
    for (label d = 2; d >= 0; --d)
    {
        label state = 0;
        for (const label face : {d, d + 3})
        {
            if (through[face])
            {
                state = face < 3 ? 3 : 4;
            }
            else if (on[face] && state == 0)
            {
                state = face < 3 ? 1 : 2;
            }
        }
        way = 5*way + state;
    }
    ++found_[way];
}


Foam::ffdExits::faceFlags Foam::ffdExits::toFreeze() const
{
    faceFlags freeze(false);

    // First where there is no choice, then on edges, then at corners
    for (label nFaces = 1; nFaces <= 3; ++nFaces)
    {
        for (label way = 0; way < nWays; ++way)
        {
            if (found_[way] == 0)
            {
                continue;
            }
            faceFlags through(false);
            label nOn = 0;
            bool done = false;
            label rest = way;
            for (label d = 0; d < 3; ++d, rest /= 5)
            {
                const label state = rest % 5;
                if (state > 0)
                {
                    ++nOn;
                    const label face = state % 2 == 1 ? d : d + 3;
                    done = done || freeze[face];
                    through[face] = state > 2;
                }
            }
            if (nOn == nFaces && !done)
            {
                forAll(freeze, face)
                {
                    freeze[face] = freeze[face] || through[face];
                }
            }
        }
    }
    return freeze;
}


// ************************************************************************* //
