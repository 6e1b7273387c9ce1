/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "tetrahedraSmoother.H"
#include "distortionMinimiser.hpp"
#include "untrapped.H"

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- Points that stay, that move in a plane, and all others
class cavityMotion
:
    public morph::PointMotion
{
    //- Of each point its plane, or one of these
    enum { anywhere = -1, nowhere = -2 };

    labelList freedom_;

    const UList<vector>& normals_;

public:

    cavityMotion
    (
        const tetrahedralMesh& given,
        const tetrahedralMesh& made,
        const UList<vector>& normals
    )
    :
        freedom_(made.points.size(), anywhere),
        normals_(normals)
    {
        forAll(made.planeFaces, i)
        {
            for (const label pointi : made.planeFaces[i])
            {
                label& freedom = freedom_[pointi];
                freedom =
                    freedom == anywhere || freedom == made.planes[i]
                  ? made.planes[i] : label(nowhere);
            }
        }
        labelList place(given.points.size(), -1);
        forAll(made.origin, i)
        {
            if (made.origin[i] >= 0)
            {
                place[made.origin[i]] = i;
            }
        }
        const auto stay = [&](const label pointi)
        {
            if (place[pointi] >= 0)
            {
                freedom_[place[pointi]] = nowhere;
            }
        };
        for (const triFace& f : given.fixedFaces)
        {
            for (const label pointi : f)
            {
                stay(pointi);
            }
        }
        for (const edge& e : given.fixedEdges)
        {
            stay(e.start());
            stay(e.end());
        }
        for (const label pointi : given.fixedPoints)
        {
            stay(pointi);
        }
    }

    virtual void exchange(morph::Vectors&) override
    {}

    virtual std::vector<bool> free() override
    {
        std::vector<bool> free(freedom_.size());
        forAll(freedom_, i)
        {
            free[i] = freedom_[i] != nowhere;
        }
        return free;
    }

    virtual void project(const morph::Vectors&, morph::Vectors& v) override
    {
        forAll(freedom_, i)
        {
            if (freedom_[i] == nowhere)
            {
                v.row(i).setZero();
            }
            else if (freedom_[i] >= 0)
            {
                const vector& n = normals_[freedom_[i]];
                const scalar out = v(i, 0)*n.x() + v(i, 1)*n.y() + v(i, 2)*n.z();
                v(i, 0) -= out*n.x();
                v(i, 1) -= out*n.y();
                v(i, 2) -= out*n.z();
            }
        }
    }

    virtual void retract(morph::Vectors&) override
    {}

    bool fixed(const label pointi) const
    {
        return freedom_[pointi] == nowhere;
    }
};

} // End namespace Foam


// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

void Foam::tetrahedraSmoother::smooth
(
    const tetrahedralMesh& given,
    const tetrahedralMesh& made,
    const UList<vector>& normals,
    const label iterations,
    const std::function<void(const pointField&)>& look
)
{
    const label n = made.points.size();
    morph::Vectors x(n, 3);
    forAll(made.points, i)
    {
        x.row(i) << made.points[i].x(), made.points[i].y(), made.points[i].z();
    }
    morph::SimplexMesh mesh(3, n, x, morph::SimplexTarget::orthogonal);
    for (const remeshMap::corners& t : made.tets)
    {
        mesh.add
        (
            {
                {t[1], t[2], t[3]}, {t[0], t[3], t[2]},
                {t[0], t[1], t[3]}, {t[0], t[2], t[1]}
            },
            true
        );
    }
    mesh.finish();

    cavityMotion motion(given, made, normals);
    morph::SerialCommunicator communicator;
    morph::DistortionMinimiser minimiser(mesh, motion, communicator);
    const untrapped numbers;
    pointField points(made.points);
    for (const int power : {1, 2, 4, 8, 16})
    {
        morph::DistortionMinimiser::Stage stage;
        stage.power = power;
        stage.sizeWeight = 0.5;
        stage.iterations = max(label(1), iterations/5);
        minimiser.run
        (
            stage, x, [](const morph::DistortionMinimiser::Progress&) {}
        );
        forAll(points, i)
        {
            if (!motion.fixed(i))
            {
                points[i] = point(x(i, 0), x(i, 1), x(i, 2));
            }
        }
        look(points);
    }
}


// ************************************************************************* //
