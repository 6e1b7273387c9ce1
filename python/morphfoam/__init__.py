# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""morphFoam for Python: sweeps of shapes, OpenFOAM's output, pictures."""
