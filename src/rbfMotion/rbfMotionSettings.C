/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "rbfMotionSettings.H"
#include "dictionaryChecks.H"
#include "motionZone.H"
#include "rigidMotion.H"
#include "DynamicList.H"
#include "unitConversion.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- From which mesh a time step starts
enum class referenceMesh
{
    fixed,
    moving
};

// A motion that needs more is one of several time steps
static const label mostSubSteps = 1000;


static const Enum<morph::Polynomial> polynomialNames
({
    { morph::Polynomial::none, "none" },
    { morph::Polynomial::linear, "linear" }
});


// Read one of the core's choices by its name
template<class Type>
static Type readNamed
(
    const dictionary& dict,
    const word& key,
    const std::vector<std::pair<Type, std::string>>& choices,
    const Type deflt
)
{
    if (!dict.found(key))
    {
        return deflt;
    }
    const word name(dict.get<word>(key));
    DynamicList<word> names;
    for (const auto& choice : choices)
    {
        if (choice.second == name)
        {
            return choice.first;
        }
        names.append(choice.second);
    }

    FatalIOErrorInFunction(dict)
        << "Entry '" << key << "': there is no " << key << " '" << name << "'"
        << nl << "    Valid " << key << "s: " << plainText::listed(names).c_str() << nl
        << exit(FatalIOError);
    return deflt;
}


static morph::Polynomial readPolynomial
(
    const dictionary& dict,
    const morph::Kernel& kernel
)
{
    const morph::Polynomial p = dictionaryChecks::getChoice
    (
        dict,
        "polynomial",
        polynomialNames,
        kernel.order() > 0 ? morph::Polynomial::linear : morph::Polynomial::none
    );
    if (kernel.order() > 0 && p == morph::Polynomial::none)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'polynomial' is none, but kernel "
            << dict.get<word>("kernel") << " is only conditionally definite"
            << nl << "    Use 'polynomial linear' or another kernel" << nl
            << exit(FatalIOError);
    }
    return p;
}


static label readCount(const dictionary& dict, const word& key)
{
    const label n = dict.get<label>(key);
    if (n < 1)
    {
        FatalIOErrorInFunction(dict)
            << "Entry '" << key << "' is " << n
            << " but has to be a positive number" << nl << exit(FatalIOError);
    }
    return n;
}


//- A count, or zero for the word auto
static label readCountOrAuto
(
    const dictionary& dict,
    const word& key,
    const label otherwise
)
{
    if (!dict.found(key))
    {
        return otherwise;
    }
    const token given(dict.lookup(key));
    return
        given.isWord() && given.wordToken() == "auto"
      ? 0
      : readCount(dict, key);
}


static void readGreedy
(
    const dictionary& dict,
    morph::SelectionSettings& selection
)
{
    selection.algorithm = readNamed
    (
        dict, "algorithm", morph::algorithmNames(), selection.algorithm
    );
    wordList keys({"tolerance", "maxPoints", "algorithm"});
    if (selection.algorithm == morph::Algorithm::incremental)
    {
        keys.append("pointsPerSweep");
    }
    if (selection.algorithm == morph::Algorithm::schur)
    {
        keys.append("restartFraction");
    }
    dictionaryChecks::onlyKeys(dict, keys);

    if (dict.found("tolerance"))
    {
        selection.tolerance = dictionaryChecks::getPositive(dict, "tolerance");
        if (selection.tolerance >= 1)
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'tolerance' is " << selection.tolerance
                << " of the largest displacement: nothing would be moved"
                << nl << "    Give less than 1; 1e-3 is coarse" << nl
                << exit(FatalIOError);
        }
    }
    if (dict.found("maxPoints"))
    {
        selection.maxPoints = readCount(dict, "maxPoints");
    }
    if (dict.found("restartFraction"))
    {
        selection.restartFraction =
            dictionaryChecks::getPositive(dict, "restartFraction");
    }
    selection.pointsPerSweep =
        readCountOrAuto(dict, "pointsPerSweep", selection.pointsPerSweep);
}


static morph::SelectionSettings readSelection(const dictionary& dict)
{
    morph::SelectionSettings selection;

    const dictionary* greedy = dict.findDict("greedy");
    if (dict.found("greedy") && !greedy)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'greedy' has to be a dictionary: greedy { tolerance"
            << " 1e-5; }" << nl << exit(FatalIOError);
    }
    if (greedy)
    {
        readGreedy(*greedy, selection);
    }

    if (dict.found("selection"))
    {
        const word which(dict.get<word>("selection"));
        if (which != "all" || greedy)
        {
            FatalIOErrorInFunction(dict)
                << "Entry 'selection' is '" << which << "'"
                << (greedy ? " beside a 'greedy' dictionary" : "") << nl
                << "    Use 'selection all' to take every control point, or"
                << " a 'greedy' dictionary to select" << nl
                << exit(FatalIOError);
        }
        selection.all = true;
    }
    return selection;
}


//- The word auto, or any that OpenFOAM knows for yes and no
static rbfMotionSettings::correctionPolicy readCorrection
(
    const dictionary& dict
)
{
    typedef rbfMotionSettings::correctionPolicy policy;
    const entry* given = dict.findEntry("surfaceCorrection", keyType::LITERAL);
    if (!given || (given->isStream() && given->stream().size() == 1
     && given->stream().first().isWord()
     && given->stream().first().wordToken() == "auto"))
    {
        return policy::automatic;
    }
    return dict.get<bool>("surfaceCorrection") ? policy::yes : policy::no;
}


//- Why other entries exclude images; empty if they do not
static string imagesRefusal(const rbfMotionSettings& settings)
{
    if (settings.selection.algorithm != morph::Algorithm::incremental)
    {
        return "they need algorithm incremental";
    }
    if (settings.polynomial != morph::Polynomial::none)
    {
        return "they need 'polynomial none'";
    }
    return "";
}

//- The entry reference, after a check of what it excludes
static bool readMovingReference(const dictionary& dict)
{
    const Enum<referenceMesh> names
    ({
        { referenceMesh::fixed, "fixed" },
        { referenceMesh::moving, "moving" }
    });
    const bool moving =
        dictionaryChecks::getChoice
        (
            dict, "reference", names, referenceMesh::fixed
        )
     == referenceMesh::moving;
    if (moving && dict.found("subSteps"))
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'subSteps' starts from the reference mesh at each time,"
            << " which 'reference moving' does not" << nl
            << "    Remove subSteps; where a step is too large, make the time"
            << " step smaller" << nl << exit(FatalIOError);
    }
    return moving;
}

} // End namespace Foam


// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

void Foam::rbfMotionSettings::check
(
    const dictionary& dict,
    const bool amongOthers
)
{
    wordList keys
    ({
        "kernel", "polynomial", "supportRadius", "supportRadiusFactor",
        "selection", "images", "surfaceCorrection", "featureAngle",
        "exactSliding", "onInvalidMesh", "reference", "subSteps"
    });
    dictionaryChecks::checkNumbers(dict);
    dictionaryChecks::checkValues(dict, keys);
    if (!amongOthers)
    {
        keys.append
        (
            wordList
            ({
                "controlPoints", "greedy", "frozenPointsZone", "optimise",
                "constraints"
            })
        );
        keys.append(motionZone::keys());
        keys.append(rigidMotion::keys(dict));
        dictionaryChecks::onlyKeys(dict, keys);
    }
}


Foam::rbfMotionSettings Foam::rbfMotionSettings::read(const dictionary& dict)
{
    rbfMotionSettings settings;

    settings.kernel = readNamed
    (
        dict, "kernel", morph::kernelNames(), morph::KernelType::wendlandC2
    );
    settings.polynomial =
        readPolynomial(dict, morph::Kernel(settings.kernel, 1));
    settings.polynomialGiven = dict.found("polynomial");

    if (dict.found("supportRadius") && dict.found("supportRadiusFactor"))
    {
        FatalIOErrorInFunction(dict)
            << "Both 'supportRadius' and 'supportRadiusFactor' are given" << nl
            << "    Give one of them: a length [m], or a multiple of the"
            << " largest displacement" << nl << exit(FatalIOError);
    }
    settings.supportRadius =
        dict.found("supportRadius")
      ? dictionaryChecks::getPositive(dict, "supportRadius")
      : 0;
    settings.supportRadiusFactor =
        dict.found("supportRadiusFactor")
      ? dictionaryChecks::getPositive(dict, "supportRadiusFactor")
      : 4;
    settings.supportRadiusSpans =
        dict.found("supportRadiusFactor") ? 0 : 0.5;

    settings.selection = readSelection(dict);
    settings.toleranceGiven =
        dict.subOrEmptyDict("greedy").found("tolerance");
    settings.surfaceCorrection = readCorrection(dict);
    settings.images =
    {
        dictionaryChecks::getChoice
        (
            dict,
            "images",
            motionImages::policyNames,
            motionImages::policy::automatic
        ),
        morph::Kernel(settings.kernel, 1).compact(),
        imagesRefusal(settings)
    };

    settings.exactSliding = dict.getOrDefault<bool>("exactSliding", true);

    const scalar degrees =
        dict.found("featureAngle")
      ? dictionaryChecks::getPositive(dict, "featureAngle")
      : 30;
    if (degrees > 90)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'featureAngle' is " << degrees
            << " but has to be at most 90 degrees" << nl
            << exit(FatalIOError);
    }
    settings.featureAngle = degToRad(degrees);

    settings.onInvalidMesh = motionLimiter::readPolicy(dict);
    settings.optimise = optimiseSettings::readFrom(dict, "optimise");
    settings.subSteps = readCountOrAuto
    (
        dict,
        "subSteps",
        settings.onInvalidMesh == motionLimiter::policy::ignore
     || !settings.optimise.never()
      ? 1
      : 0
    );
    settings.subStepsGiven = dict.found("subSteps");
    if (settings.subSteps > mostSubSteps)
    {
        FatalIOErrorInFunction(dict)
            << "Entry 'subSteps' is " << settings.subSteps
            << ", each of which is a selection" << nl
            << "    Give at most " << mostSubSteps << ", or auto" << nl
            << exit(FatalIOError);
    }
    settings.movingReference = readMovingReference(dict);
    return settings;
}


// ************************************************************************* //
