"""The errors a user can meet, drawn as a tree.

Room: errors. In: nothing. Out: exceptions. May import: nothing.

    GencError                 something genc says in one line; the command line exits with 2
    +-- BriefError            the request cannot be met: empty sentence, a count out of range
    +-- ScriptError           a scenario script, its JSON or a list of seeds is wrong; carries every problem found
    +-- StudyError            prompts, answers or annotations of a study are wrong; carries every problem found
    +-- LayoutError           an environment cannot be used
    +-- ProviderError         a language model cannot be reached, refuses, or gives nothing that can be used
    +-- JournalError          a journal of paid replies is damaged, in use, or of another version
    +-- BudgetError           a run stopped because its tokens were used up
    +-- EncoderError          a text encoder is missing, altered, or the wrong one
    +-- DatasetError          a dataset folder is missing, incomplete or of another version
    +-- CheckpointError       model weights are missing, damaged, or do not fit this version
    +-- WorldFileError        a world file is missing, cut short, or of another version
    +-- OutputError           a result cannot be written where it was asked for
    +-- ExtraError            an optional part was asked for that is not installed

A message says what was wrong, the value, where it came from, and what to do about it.
"""

from __future__ import annotations

from collections.abc import Sequence


class GencError(Exception):
    """The root: catch this to catch everything that genc raises on purpose."""


class BriefError(GencError):
    """A request that no crowd can meet."""


class ScriptError(GencError):
    """A scenario script that cannot be used; `problems` holds one line for each fault."""

    def __init__(self, problems: Sequence[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class StudyError(GencError):
    """Prompts, answers or annotations of a study that cannot be used; `problems` holds one line for each fault."""

    def __init__(self, problems: Sequence[str]) -> None:
        self.problems = tuple(problems)
        super().__init__("\n".join(self.problems))


class LayoutError(GencError):
    """An environment in which no crowd can be placed."""


class ProviderError(GencError):
    """A language model that does not answer, or not usably."""


class JournalError(GencError):
    """A journal of paid replies that cannot be used."""


class BudgetError(GencError):
    """A run that has used up its tokens; what it has is kept."""


class EncoderError(GencError):
    """A text encoder that cannot be loaded or does not match."""


class DatasetError(GencError):
    """A dataset folder that cannot be used."""


class CheckpointError(GencError):
    """Model weights that cannot be used."""


class WorldFileError(GencError):
    """A world file that cannot be read."""


class OutputError(GencError):
    """A place where nothing can be written."""


class ExtraError(GencError):
    """An optional part that is not installed.

    Args:
        wish: what was asked for.
        extra: the extra of this package that brings it.
    """

    def __init__(self, wish: str, extra: str) -> None:
        super().__init__(f"{wish} needs an extra that is not installed: pip install 'genc[{extra}]'")
