# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Pictures of meshes and fields.

    picture     one view of a case, exactly of a box (ParaView)
    scene       surfaces, patches, cuts and lattices in space (ParaView)
    film_strip  pictures side by side (matplotlib)
    motion      one sheet of a motion, from morphMesh -pictures (matplotlib)
    preview     parameters of lattices at their bounds (matplotlib)
    vtk_files   what the two read
"""
