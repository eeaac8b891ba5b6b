"""A scenario as it is being read: perhaps wrong, and with a memory of where everything stood.

Readers of scripts and of JSON make drafts; `settle` turns them into scenarios or says all that is wrong.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path as FilePath

from genc.errors import ScriptError
from genc.scenario.faults import Fault, Path, faults, hints
from genc.scenario.scenario import Scenario


@dataclass(frozen=True)
class Draft:
    """One scenario, read as far as it could be.

    Attributes:
        scenario: what was understood; a stand-in is in the place of what was not.
        found: faults met while reading.
        unsure: places that hold a stand-in; what the checker finds there is a consequence, not a fault.
        locate: for a path within the scenario, a number to sort by and the words that tell a person where.
    """

    scenario: Scenario
    found: tuple[Fault, ...]
    unsure: frozenset[Path]
    locate: Callable[[Path], tuple[int, str]]

    def faults(self) -> list[Fault]:
        """The faults met while reading and those of the checker."""
        return [*self.found, *(f for f in faults(self.scenario) if f.path not in self.unsure)]

    def lines(self, found: Iterable[Fault]) -> list[str]:
        """One line for each fault, `where: what; how`, in the order of the text."""
        placed = sorted(((*self.locate(fault.path), fault) for fault in found), key=lambda entry: entry[0])
        return [f"{where}: {fault}" for _, where, fault in placed]


def problems(drafts: Iterable[Draft]) -> list[str]:
    """All that makes the drafts unusable, one line each, with where and how to mend it."""
    lines: list[str] = []
    first_at: dict[tuple[str, str], str] = {}
    for draft in drafts:
        found = draft.faults()
        key = (draft.scenario.theme, draft.scenario.slug)
        if key in first_at:
            what = f"a second scenario named {draft.scenario.slug!r}, first at {first_at[key]}"
            found.append(Fault((), what, "a name is used once in a theme"))
        elif draft.scenario.slug:
            first_at[key] = draft.locate(())[1]
        lines += draft.lines(found)
    return lines


def warnings(drafts: Iterable[Draft]) -> list[str]:
    """What sound drafts could do better, one line each."""
    return [line for draft in drafts if not draft.faults() for line in draft.lines(hints(draft.scenario))]


def settle(drafts: Iterable[Draft]) -> tuple[Scenario, ...]:
    """The scenarios of the drafts.

    Raises:
        ScriptError: with every problem of every draft, if there is any.
    """
    drafts = list(drafts)
    if lines := problems(drafts):
        raise ScriptError(lines)
    return tuple(draft.scenario for draft in drafts)


def clean(text: str) -> str:
    """The text as one line with single spaces, as every text of a scenario is held."""
    return " ".join(text.split())


def read_text(path: FilePath | str) -> str:
    """The text of a file.

    Raises:
        ScriptError: if there is none, with the reason.
    """
    try:
        return FilePath(path).read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise ScriptError([f"{path}: no such file; check the name"]) from None
    except IsADirectoryError:
        raise ScriptError([f"{path}: a folder, not a file; name a script in it"]) from None
    except UnicodeDecodeError as error:
        raise ScriptError([f"{path}: not UTF-8 text (byte {error.start}); save it as UTF-8"]) from None
    except (OSError, ValueError) as error:
        raise ScriptError([f"{path}: cannot be read ({error}); check the name and the rights"]) from None
