// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Removes the remaining error at control points that were not selected.

#ifndef morph_surfaceCorrection_hpp
#define morph_surfaceCorrection_hpp

#include "arrays.hpp"

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace morph
{

// A hierarchy of radii h_l = h_0/2^l. The points of level l are at least h_l
// away from each other and from all points of earlier levels, so that no kernel
// of support h_l reaches another of them: the system is diagonal, its
// coefficients are the residuals that earlier levels leave, and residuals that
// earlier levels meet stay met. The last level takes the points that are left;
// then all residuals are met to round-off. The field changes only within h_0 of
// the points, so that cells at a wall follow the error that the greedy
// selection left there.
//
// Points that are images of each other join a level together, if they are far
// enough from each other: the correction of residuals that are symmetric or
// periodic is so, too.
class SurfaceCorrection
{
public:
    // centres: n x 3 [m], those of all ranks in one order, no two at one place;
    // radius: h_0 [m]
    // family: of each centre the first that it is an image of, or itself;
    // none: each by itself
    SurfaceCorrection(
        const Columns& centres, double radius,
        const std::vector<Index>& family = std::vector<Index>());

    // What is to be added at the centres: n x 3 [m]
    void set(const Vectors& residuals);

    // Which centres reach which points, and by how much. Depends on geometry
    // alone, and takes most of the time
    class Reach
    {
        friend class SurfaceCorrection;

        // For each level the points within reach of some centre of it; where
        // their centres begin among all, and at last the end; the centres and
        // the values of the kernel
        struct Level
        {
            std::vector<std::int32_t> points;
            std::vector<std::size_t> begin;
            std::vector<std::int32_t> centres;
            std::vector<double> values;
        };
        std::vector<Level> levels_;
    };

    // points: m x 3 [m]
    Reach reach(const Vectors& points) const;

    // Adds the correction at the points to their displacements: m x 3 [m]
    void add(const Reach& points, Vectors& displacements) const;

    // Levels of the hierarchy
    Index levels() const { return levels_.size(); }

private:
    using Cell = std::array<std::int64_t, 3>;

    struct Hash
    {
        std::size_t operator()(const Cell& cell) const;
    };

    // Points by the cell, of the size of a radius, in which they are
    using Grid = std::unordered_map<Cell, std::vector<Index>, Hash>;

    struct Level
    {
        double radius;
        std::vector<Index> members;
        Grid grid;

        // The cells of all centres, of whatever level; their lists are empty
        Grid all;
    };

    static Cell cellOf(const Vector3& x, double size);

    // Calls action(points) for each cell of the grid at x or next to it
    template <class Action>
    static void cellsAround(
        const Grid& grid, const Vector3& x, double size, const Action& action);

    using Families = std::vector<std::vector<Index>>;

    // Takes from the families that are left those that make up a level
    Level makeLevel(Families& left, double radius) const;

    // Of some of the points, at one level. Those out of reach of the cells of
    // all centres, whatever their level, are taken off the list: so they are at
    // all later ones
    Reach::Level reachAt(
        const Level& level, const Vectors& points,
        std::vector<std::int32_t>& near) const;

    // Adds `factor` times what a level does at its points
    void addLevel(
        const Reach::Level& reach, double factor, Vectors& displacements) const;

    Columns centres_;
    std::vector<Level> levels_;
    Reach among_; // the centres
    Vectors coefficients_;
};

} // namespace morph

#endif
