"""The prompts beside this module, filled in."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from string import Template

from genc.words.language import Turn

_FOLDER = Path(__file__).parent / "prompts"


def prompt(name: str, **words: object) -> tuple[Turn, ...]:
    """The turns of a prompt: what holds for every question of its kind, and below its `---` what is asked now."""
    rules, asked = (Template(part.strip()).substitute(words) for part in _text(name).split("\n---\n"))
    return Turn("system", rules), Turn("user", asked)


def mending(faults: str, attempt: int) -> str:
    """What asks for a reply again."""
    return Template(_text("again")).substitute(faults=faults, attempt=attempt).strip()


@cache
def _text(name: str) -> str:
    return (_FOLDER / f"{name}.md").read_text(encoding="utf-8")
