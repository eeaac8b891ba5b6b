"""The scenarios that ship with the package, and folders of a user's own: a theme is a folder of scripts."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from genc.errors import BriefError, ScriptError
from genc.scenario.draft import Draft, clean, problems
from genc.scenario.exchange import read_drafts
from genc.scenario.faults import suggest
from genc.scenario.scenario import Scenario
from genc.scenario.script import write_script

SHIPPED = Path(__file__).parents[1] / "corpora"
"""The folder of the shipped themes."""


def themes() -> tuple[str, ...]:
    """The names of the shipped themes, as their scripts spell them."""
    return tuple(_theme_folders())


def load_theme(name: str) -> tuple[Scenario, ...]:
    """The shipped scenarios of a theme; "University Campus" and "university_campus" are the same.

    Raises:
        BriefError: for an unknown theme; names the known ones.
    """
    folders = _theme_folders()
    folder = {folded_theme(theme): folder for theme, folder in folders.items()}.get(folded_theme(name))
    if folder is None:
        known = ", ".join(folders)
        nearest = suggest(name, folders)
        hint = f"{nearest} known are: {known}" if nearest.startswith("did") else nearest
        raise BriefError(f"unknown theme {name!r}; {hint}")
    return load_scripts(folder)


def load_corpus(names: Sequence[str] | None = None) -> tuple[Scenario, ...]:
    """The shipped scenarios of these themes, or of all.

    Raises:
        BriefError: for an unknown theme.
    """
    return tuple(scenario for name in (themes() if names is None else names) for scenario in load_theme(name))


def load_scripts(*paths: Path | str) -> tuple[Scenario, ...]:
    """The scenarios of script and JSON files; a folder stands for all such files in it, at any depth.

    Raises:
        ScriptError: with every problem of every file; also where two files have a scenario of one name.
    """
    drafts: list[Draft] = []
    lines: list[str] = []
    for file in script_files(paths):
        try:
            drafts += read_drafts(file)
        except ScriptError as error:
            lines += error.problems
    lines += problems(drafts)
    if lines:
        raise ScriptError(lines)
    return tuple(draft.scenario for draft in drafts)


def script_files(paths: Iterable[Path | str]) -> list[Path]:
    """The files that these paths stand for, each once; a folder stands for the `.txt` and `.json` files in it.

    Raises:
        ScriptError: for a folder without any.
    """
    files: list[Path] = []
    for path in map(Path, paths):
        inside = _scripts_in(path) if os.path.isdir(path) else [path]
        if not inside:
            raise ScriptError([f"{path}: no scripts in this folder; put .txt or .json files there"])
        files += inside
    return list(dict.fromkeys(files))


def corpus_hash(scenarios: Iterable[Scenario]) -> str:
    """Sixteen hex digits that change with any word, number or order of the scenarios."""
    return hashlib.sha256(write_script(scenarios).encode()).hexdigest()[:16]


def _scripts_in(folder: Path) -> list[Path]:
    return sorted(f for f in folder.rglob("*") if f.suffix in (".txt", ".json") and f.is_file())


def folded_theme(theme: str) -> str:
    """The name of a theme, the same however it is spelled."""
    return clean(theme.replace("_", " ").replace("-", " ")).casefold()


def _theme_folders() -> dict[str, Path]:
    """Theme by theme: its folder."""
    return {_theme_of(folder): folder for folder in sorted(SHIPPED.iterdir()) if any(folder.glob("*.txt"))}


def _theme_of(folder: Path) -> str:
    with min(folder.glob("*.txt")).open(encoding="utf-8") as lines:
        return next((line[2:].strip() for line in lines if line.startswith("T:")), folder.name)
