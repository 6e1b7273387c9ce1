# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""The parameters that change the frontal area most."""

import numpy as np

titles, *rows = (
    open("results/body.constraintDerivatives.dat").read().split("\n")
)
names = titles.split()[2:]
slopes = {
    row.split()[0]: np.array(row.split()[1:], float) for row in rows if row
}
print(f"{len(names)} parameters")
for i in np.argsort(-np.abs(slopes["front"]))[:5]:
    print(
        f"{names[i]:24s} {slopes['front'][i]:+.4f} of the frontal area per m"
    )
