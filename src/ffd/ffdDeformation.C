/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdAxisDeformation.H"
#include "ffdBox.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::ffdDeformation::ffdDeformation(const dictionary& dict)
:
    dict_(dict),
    name_(dict.dictName())
{
    // Files are called after it
    const std::size_t longest = 100;
    if (name_.size() > longest)
    {
        FatalIOErrorInFunction(dict)
            << "The name of box '" << name_ << "' has "
            << label(name_.size()) << " characters, but may have "
            << label(longest) << nl
            << "    Files are called after boxes. Give it a shorter one" << nl
            << exit(FatalIOError);
    }
}


Foam::autoPtr<Foam::ffdDeformation> Foam::ffdDeformation::New
(
    const dictionary& dict,
    const objectRegistry* registry
)
{
    if (dict.getOrDefault<word>("type", "box") == "axis")
    {
        return autoPtr<ffdDeformation>(new ffdAxisDeformation(dict, registry));
    }
    return autoPtr<ffdDeformation>(new ffdBox(dict, registry));
}


// ************************************************************************* //
