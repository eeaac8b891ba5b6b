"""Seeds: the sentences that scenarios grow from, with their other wordings, in a text file that a person can edit.

# anything
T: a theme
A sentence that says where it is, who is there and what they do.
  The same in other words, indented.
  And once more.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from genc.errors import ScriptError
from genc.scenario.draft import clean, read_text

_HEAD = """\
# Seeds: one sentence a line, other wordings of it indented below. Edit, add, leave out as you like.
"""


@dataclass(frozen=True)
class Seed:
    """One sentence S_in of a theme, and the same in other words."""

    theme: str
    sentence: str
    wordings: tuple[str, ...] = ()


def write_seeds(seeds: Iterable[Seed]) -> str:
    """The text of these seeds: `parse_seeds` gives them back."""
    lines, theme = [_HEAD], ""
    for seed in seeds:
        if seed.theme != theme:
            lines.append(f"T: {seed.theme}\n")
            theme = seed.theme
        lines += [seed.sentence, *(f"  {wording}" for wording in seed.wordings)]
    return "\n".join(lines) + "\n"


def read_seeds(path: Path | str) -> tuple[Seed, ...]:
    """The seeds of a file.

    Raises:
        ScriptError: if it cannot be read, or with every problem of its text.
    """
    return parse_seeds(read_text(path), str(path))


def parse_seeds(text: str, source: str) -> tuple[Seed, ...]:
    """The seeds of a text; `source` names it in messages.

    Raises:
        ScriptError: with every problem: line, what is wrong, how to mend it.
    """
    theme, problems = "", []
    seeds: list[Seed] = []
    first_at: dict[str, int] = {}
    for number, raw in enumerate(text.splitlines(), start=1):
        line = clean(raw)
        if not line or line.startswith("#"):
            continue
        if line.startswith("T:"):
            theme = line[2:].strip()
        elif not theme:
            problems.append(f"{source}:{number}: a seed before any theme; write 'T: theme' above it")
            theme = "?"
        elif raw[0].isspace():
            if seeds:
                seeds[-1] = Seed(seeds[-1].theme, seeds[-1].sentence, (*seeds[-1].wordings, line))
            else:
                problems.append(f"{source}:{number}: a wording without a sentence above it; begin seeds at the margin")
        elif line in first_at:
            problems.append(f"{source}:{number}: the same sentence as in line {first_at[line]}; leave one out")
        else:
            first_at[line] = number
            seeds.append(Seed(theme, line))
    if not seeds and not problems:
        problems.append(f"{source}: no seed in it; write one sentence a line below 'T: theme'")
    if problems:
        raise ScriptError(problems)
    return tuple(seeds)
