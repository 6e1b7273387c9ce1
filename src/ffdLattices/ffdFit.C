/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdFit.H"
#include "coordinateRotation.H"
#include "dictionaryEntries.H"
#include "points0MotionSolver.H"
#include "polyMesh.H"
#include "PstreamReduceOps.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace ffdFit
{

//- On every side: metres, or a fraction of the length
static vector readMargin(const dictionary& dict, const vector& length)
{
    if (!dict.found("margin"))
    {
        return 0.05*length;
    }
    ITstream& is = dict.lookup("margin");
    const bool isNumber = is.size() > 0 && is[0].isNumber();
    const bool percent =
        is.size() == 2
     && (
            (is[1].isWord() && is[1].wordToken() == "%")
         || (is[1].isPunctuation() && is[1].pToken() == '%')
        );
    if (!isNumber || (is.size() > 1 && !percent) || is[0].number() < 0)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'margin' has to be a length in metres, or a part of the"
            << " body such as 5 %" << nl << exit(FatalIOError);
    }
    return
        percent
      ? 0.01*is[0].number()*length
      : is[0].number()*vector::one;
}


static void fit
(
    dictionary& box,
    const wordList& names,
    const std::function<pointField(const label)>& pointsOf
)
{
    for (const word& key : wordList({"origin", "span", "type"}))
    {
        if (box.found(key) && !(key == "type" && box.get<word>(key) == "box"))
        {
            FatalIOErrorInFunction(box)
                << "Entry '" << key << "' is given beside 'around'" << nl
                << "    A box around patches has its place from them: remove"
                << " one of the two" << nl << exit(FatalIOError);
        }
    }
    tensor R(tensor::I);
    if (box.found("rotation"))
    {
        R = coordinateRotation::New
        (
            dictionaryChecks::subDict(box, "rotation")
        )->R();
    }

    // Each component by itself: the same on every decomposition
    point low(point::uniform(GREAT));
    point high(point::uniform(-GREAT));
    for (const label i : dictionaryChecks::select(box, "around", names))
    {
        for (const point& x : pointsOf(i))
        {
            low = min(low, R.T() & x);
            high = max(high, R.T() & x);
        }
    }
    reduce(low, minOp<point>());
    reduce(high, maxOp<point>());
    if (low.x() > high.x())
    {
        FatalIOErrorInFunction(box)
            << "Entry 'around': there are no points on any of these patches"
            << nl << exit(FatalIOError);
    }

    const vector margin(readMargin(box, high - low));
    const vector span(high - low + 2*margin);
    if (!(cmptMin(span) > 0))
    {
        FatalIOErrorInFunction(box)
            << "Around these patches the box would be flat: " << span << nl
            << "    Give a 'margin' in metres" << nl << exit(FatalIOError);
    }
    box.remove("around");
    box.remove("margin");
    box.add("origin", point(R & (low - margin)));
    box.add("span", span);
    Info<< "Box " << box.dictName() << " around patches: origin "
        << box.get<point>("origin") << ", span " << span << endl;
}

} // End namespace ffdFit
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::dictionary Foam::ffdFit::fitted
(
    const dictionary& dict,
    const wordList& names,
    const std::function<pointField(const label)>& pointsOf
)
{
    dictionary result(dict);
    if (dictionary* boxes = result.findDict("boxes"))
    {
        for (entry& e : *boxes)
        {
            if (e.isDict() && e.dict().found("around"))
            {
                fit(e.dict(), names, pointsOf);
            }
        }
    }
    return result;
}


Foam::dictionary Foam::ffdFit::fitted
(
    const dictionary& dict,
    const polyMesh& mesh,
    const pointField& points
)
{
    const polyBoundaryMesh& patches = mesh.boundaryMesh();
    wordList names(patches.names());
    names.setSize(patches.nNonProcessor());
    return fitted
    (
        dict,
        names,
        [&](const label patchi)
        {
            return pointField(points, patches[patchi].meshPoints());
        }
    );
}


Foam::dictionary Foam::ffdFit::fitted
(
    const dictionary& dict,
    const polyMesh& mesh
)
{
    const dictionary* boxes = dict.findDict("boxes");
    bool some = false;
    if (boxes)
    {
        for (const entry& e : *boxes)
        {
            some = some || (e.isDict() && e.dict().found("around"));
        }
    }
    if (!some)
    {
        return dict;
    }
    const pointIOField points0(points0MotionSolver::points0IO(mesh));
    return fitted(dict, mesh, points0);
}


// ************************************************************************* //
