/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "optimiseSettings.H"
#include "dictionaryChecks.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::optimiseSettings::trigger>
Foam::optimiseSettings::triggerNames
({
    { trigger::never, "never" },
    { trigger::needed, "needed" },
    { trigger::always, "always" }
});

const Foam::Enum<morph::SimplexTarget> Foam::optimiseSettings::targetNames
({
    { morph::SimplexTarget::reference, "reference" },
    { morph::SimplexTarget::orthogonal, "orthogonal" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static label getLayers(const dictionary& dict)
{
    if (!dict.found("layers"))
    {
        return -1;
    }
    const token first(dict.lookup("layers"));
    if (first.isWord() && first.wordToken() == "all")
    {
        return -1;
    }
    if (!first.isLabel() || first.labelToken() < 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'layers' is neither all nor a number of layers" << nl
            << "    Use all, or a whole number from 1" << nl
            << exit(FatalIOError);
    }
    return first.labelToken();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::optimiseSettings Foam::optimiseSettings::readFrom
(
    const dictionary& coeffs,
    const word& key
)
{
    return
        coeffs.found(key) ? read(coeffs.subDict(key)) : optimiseSettings();
}


Foam::optimiseSettings Foam::optimiseSettings::read(const dictionary& dict)
{
    dictionaryChecks::onlyKeys
    (
        dict,
        {
            "when", "target", "power", "sizeWeight", "iterations", "layers"
        },
        {"limits"}
    );
    optimiseSettings s;
    s.when = dictionaryChecks::getChoice
    (
        dict, "when", triggerNames, trigger::needed
    );
    s.target = dictionaryChecks::getChoice
    (
        dict, "target", targetNames, s.target
    );
    s.power = dictionaryChecks::getCount(dict, "power", s.power, 1, 16);
    s.sizeWeight = dictionaryChecks::getBetween(dict, "sizeWeight", s.sizeWeight, 0, 1e3);
    s.iterations = dictionaryChecks::getCount(dict, "iterations", s.iterations, 1, 1000000);
    s.layers = getLayers(dict);
    if (dict.found("limits"))
    {
        const dictionary& limits = dict.subDict("limits");
        dictionaryChecks::onlyKeys
        (
            limits, {"nonOrthogonality", "skewness", "determinant"}, {}
        );
        s.nonOrthogonality = dictionaryChecks::getBetween
        (
            limits, "nonOrthogonality", s.nonOrthogonality, 1, 180
        );
        s.skewness = dictionaryChecks::getBetween(limits, "skewness", s.skewness, 1e-3, GREAT);
        s.determinant = dictionaryChecks::getBetween(limits, "determinant", s.determinant, 0, 1);
    }
    return s;
}


// ************************************************************************* //
