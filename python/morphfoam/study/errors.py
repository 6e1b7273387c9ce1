# SPDX-FileCopyrightText: 2026 The morphFoam authors
# SPDX-License-Identifier: GPL-3.0-or-later

"""What is wrong with a study, in words for who wrote it."""


class StudyError(Exception):
    """Fact, meaning, remedy; printed without a traceback."""
