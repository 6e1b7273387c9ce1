/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "ffdPreview.H"
#include "foamVtkSurfaceWriter.H"
#include "OSspecific.H"
#include "wholeFile.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{
namespace ffdPreview
{

static controlShape lattice(const ffdDeformation& box, const bool moved)
{
    controlShape shape;
    shape.name = moved ? box.name() : word(box.name() + "AtRest");
    vectorField displacement;
    if (Pstream::master())
    {
        shape.points = box.lattice(moved);
        shape.lines = box.latticeLines();
        displacement = shape.points - box.lattice(false);
    }
    shape.vectors.insert("displacement", displacement);
    return shape;
}


//- Take these values; false if they fold a box
static bool take(ffdBoxes& boxes, const scalarField& values)
{
    const bool threw = FatalIOError.throwExceptions();
    bool folds = false;
    try
    {
        boxes.update(values);
        boxes.displacement();
    }
    catch (const IOerror&)
    {
        folds = true;
    }
    FatalIOError.throwExceptions(threw);
    return !folds;
}

//- The points that belong to some faces
struct compactFaces
{
    labelList labels;
    faceList faces;

    explicit compactFaces(const faceList& given)
    :
        faces(given)
    {
        Map<label> place(4*given.size());
        DynamicList<label> used;
        for (face& f : faces)
        {
            for (label& pointi : f)
            {
                if (place.insert(pointi, used.size()))
                {
                    used.append(pointi);
                }
                pointi = place[pointi];
            }
        }
        labels.transfer(used);
    }
};



//- With the present values
static void writeFaces
(
    ffdBoxes& boxes,
    const pointField& points,
    const compactFaces& shown,
    const fileName& file
)
{
    const pointField moved
    (
        pointField(points + boxes.displacement()), shown.labels
    );
    vtk::surfaceWriter writer(moved, shown.faces, file);
    writer.writeGeometry();
    const fileName written(writer.output());
    writer.close();
    wholeFile::checkEnd(written, "</VTKFile>");
}

} // End namespace ffdPreview
} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::List<Foam::controlShape> Foam::ffdPreview::lattices(const ffdBoxes& boxes)
{
    DynamicList<controlShape> shapes;
    for (const ffdDeformation& box : boxes.boxes())
    {
        shapes.append(lattice(box, true));
        shapes.append(lattice(box, false));
    }
    return List<controlShape>(shapes);
}


void Foam::ffdPreview::write
(
    ffdBoxes& boxes,
    const pointField& points,
    const faceList& faces,
    const fileName& folder
)
{
    controlGeometry::write(lattices(boxes), folder);

    const compactFaces shown(faces);
    const scalarField present(boxes.values());
    writeFaces(boxes, points, shown, folder/"surface");
    const wordList names(boxes.parameterNames());
    forAll(names, i)
    {
        for (const bool low : {true, false})
        {
            const scalar bound =
                low ? boxes.parameter(i).min() : boxes.parameter(i).max();
            if (mag(bound) > 0.5*GREAT)
            {
                continue;
            }
            scalarField values(present);
            values[i] = bound;
            if (!take(boxes, values))
            {
                Info<< "With " << names[i] << " at " << bound
                    << " the box folds: no preview of it" << nl;
                continue;
            }
            writeFaces
            (
                boxes,
                points,
                shown,
                folder/(names[i] + (low ? ".min" : ".max"))
            );
        }
    }
    boxes.update(present);
    boxes.displacement();
    Info<< "Wrote lattices and previews to " << folder.c_str() << endl;
}


void Foam::ffdPreview::draw(const fileName& folder, const string& options)
{
    if (!Pstream::master())
    {
        return;
    }
    const string command
    (
        "\"$(python3With numpy matplotlib)\" -m morphfoam.pictures.preview "
      + ('"' + folder + '"') + options
    );
    Info<< endl;
    if (Foam::system(command) != 0)
    {
        WarningInFunction
            << "There is no picture of the parameters" << nl
            << "    It needs numpy and matplotlib, and parameters with 'min'"
            << " and 'max'. Try it: " << command.c_str() << endl;
    }
}


void Foam::ffdPreview::writeDerivatives
(
    const List<motionParameter>& parameters,
    const pointField& moved,
    const faceList& faces,
    const std::function<tmp<vectorField>(const label)>& derivative,
    const fileName& file
)
{
    const compactFaces shown(faces);
    const pointField positions(moved, shown.labels);
    vtk::surfaceWriter writer(positions, shown.faces, file);
    writer.writeGeometry();

    writer.beginPointData(parameters.size());
    for (label i = 0; i < parameters.size(); ++i)
    {
        writer.write
        (
            "d_" + parameters[i].name,
            vectorField(derivative(i)(), shown.labels)
        );
    }
    const fileName written(writer.output());
    writer.close();
    wholeFile::checkEnd(written, "</VTKFile>");
}


// ************************************************************************* //
