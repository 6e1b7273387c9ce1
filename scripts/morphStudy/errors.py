"""What is wrong with a study, in words for who wrote it."""


class StudyError(Exception):
    """Fact, meaning, remedy; printed without a traceback."""
