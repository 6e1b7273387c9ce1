/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "remeshSettings.H"
#include "dictionaryChecks.H"
#include "polyMesh.H"
#include "wallPolyPatch.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

const Foam::Enum<Foam::remeshSettings::extent>
Foam::remeshSettings::extentNames
({
    { extent::cavity, "cavity" },
    { extent::all, "all" }
});


// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The only word that an entry may be so far
static void onlyWord
(
    const dictionary& dict,
    const word& key,
    const word& allowed
)
{
    const word given(dict.getOrDefault<word>(key, allowed));
    if (given != allowed)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is '" << given << "'" << nl
            << "    Use " << allowed << ", or remove the entry" << nl
            << exit(FatalIOError);
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::remeshSettings Foam::remeshSettings::read(const dictionary& dict)
{
    dictionaryChecks::onlyKeys
    (
        dict,
        {
            "engine", "command", "region", "layers", "keepLayers",
            "keepPatches", "passes", "maxRemeshes", "size", "sizeFactor",
            "mapping"
        },
        {"limits"}
    );
    remeshSettings s;
    s.dict = dict;
    s.region = dictionaryChecks::getChoice
    (
        dict, "region", extentNames, s.region
    );
    s.layers = dictionaryChecks::getCount(dict, "layers", s.layers, 1);
    s.keepLayers = dictionaryChecks::getCount(dict, "keepLayers", s.keepLayers, 0);
    s.passes = dictionaryChecks::getCount(dict, "passes", s.passes, 1);
    s.maxRemeshes = dictionaryChecks::getCount(dict, "maxRemeshes", s.maxRemeshes, 1);
    s.sizeFactor = dictionaryChecks::getBetween(dict, "sizeFactor", s.sizeFactor, 1e-3, 1e3);
    onlyWord(dict, "size", "reference");
    onlyWord(dict, "mapping", "conservative");
    if (dict.found("limits"))
    {
        const dictionary& limits = dict.subDict("limits");
        dictionaryChecks::onlyKeys
        (
            limits, {"nonOrthogonality", "skewness", "fraction"}, {}
        );
        s.nonOrthogonality = dictionaryChecks::getBetween
        (
            limits, "nonOrthogonality", s.nonOrthogonality, 1, 180
        );
        s.skewness = dictionaryChecks::getBetween(limits, "skewness", s.skewness, 1e-3, GREAT);
        s.fraction = dictionaryChecks::getBetween(limits, "fraction", s.fraction, 0, 1);
    }
    return s;
}


Foam::labelList Foam::remeshSettings::keepPatches(const polyMesh& mesh) const
{
    const polyBoundaryMesh& patches = mesh.boundaryMesh();
    if (dict.found("keepPatches"))
    {
        const wordRes names(dict.get<wordRes>("keepPatches"));
        for (const wordRe& name : names)
        {
            if (patches.patchSet(wordRes(1, name), false, true).empty())
            {
                FatalIOErrorInFunction(dict)
                    << "Entry 'keepPatches' has '" << name
                    << "', which is no patch or group of patches" << nl
                    << "    There are " << patches.names() << nl
                    << exit(FatalIOError);
            }
        }
        return patches.patchSet(names, false, true).sortedToc();
    }
    DynamicList<label> walls;
    for (const polyPatch& patch : patches)
    {
        if (isA<wallPolyPatch>(patch))
        {
            walls.append(patch.index());
        }
    }
    return labelList(walls);
}


// ************************************************************************* //
