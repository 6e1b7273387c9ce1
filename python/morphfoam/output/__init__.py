# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Reading what OpenFOAM and morphMesh write.

    tables        columns of function objects, iterations of logs, tables as
                  csv and Markdown; needs nothing but Python
    mesh_files    points and patches of a mesh in ascii files
    trajectories  the motion of a body as two solvers found it, compared
"""
