/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remeshEngine.H"
#include "plainText.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
    defineTypeNameAndDebug(remeshEngine, 0);
    defineRunTimeSelectionTable(remeshEngine, dictionary);
}


// * * * * * * * * * * * * * * * * Selectors * * * * * * * * * * * * * * * * //

Foam::autoPtr<Foam::remeshEngine> Foam::remeshEngine::New
(
    const dictionary& dict
)
{
    const word engine(dict.getOrDefault<word>("engine", "madlib"));
    const auto make = dictionaryConstructorTablePtr_->cfind(engine);
    if (!make.found())
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'engine' is '" << engine << "'" << nl
            << "    Use one of "
            << plainText::listed
               (
                   dictionaryConstructorTablePtr_->sortedToc()
               ).c_str()
            << nl
            << exit(FatalIOError);
    }
    return autoPtr<remeshEngine>(make()(dict));
}


// ************************************************************************* //
