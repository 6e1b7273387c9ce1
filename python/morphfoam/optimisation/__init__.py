# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""Descent under constraints where every value costs a run. Knows nothing of
cases and studies:

    quadratic     quadratic programs, and how near an infeasible one comes
    differences   derivatives from batches of values, some of which fail
    sqp           trust-region sequential quadratic programming
    influence     which parameters matter
"""
