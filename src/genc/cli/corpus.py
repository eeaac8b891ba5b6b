"""`genc corpus`: check, count and convert scenario scripts."""

from __future__ import annotations

import json
import os
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import click

from genc.errors import OutputError, ScriptError
from genc.scenario.corpus import load_corpus, load_scripts, script_files
from genc.scenario.draft import Draft, problems, warnings
from genc.scenario.exchange import read_drafts, write_json
from genc.scenario.scenario import Scenario
from genc.scenario.script import write_script
from genc.scenario.statistics import Statistics, statistics
from genc.words.vocabulary import ACTIONS, CATEGORIES

_COLUMN = 11
"""Characters to a column of the table: the longest word of the shipped themes and a space."""


@click.group()
def corpus() -> None:
    """Check, count and convert scenario scripts."""


@corpus.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
def check(files: tuple[str, ...]) -> None:
    """Say everything that is wrong with scripts or JSON files.

    One line for each problem, `file:line: what; how to mend it`. Warnings are advice; only errors make the exit
    code 2. A folder stands for the scripts in it.
    """
    drafts: list[Draft] = []
    lines: list[str] = []
    for file in script_files(files):
        try:
            drafts += read_drafts(file)
        except ScriptError as error:
            lines += error.problems
    lines += problems(drafts)
    for line in warnings(drafts):
        click.echo(f"warning: {line}")
    if lines:
        raise ScriptError(lines)
    n_groups = sum(len(draft.scenario.groups) for draft in drafts)
    click.echo(f"scenarios: {len(drafts)}, groups: {n_groups}, no errors")


@corpus.command()
@click.argument("paths", nargs=-1, metavar="[PATH...]")
@click.option("--json", "as_json", is_flag=True, help="Print JSON in place of a table.")
def stats(paths: tuple[str, ...], as_json: bool) -> None:
    """Count what is in scripts, theme by theme.

    Without a path: the scenarios that ship with genc.
    """
    scenarios = load_scripts(*paths) if paths else load_corpus()
    figures = {theme: statistics(members) for theme, members in _by_theme(scenarios).items()}
    if len(figures) != 1:
        figures["all"] = statistics(scenarios)
    if as_json:
        click.echo(json.dumps({theme: asdict(figure) for theme, figure in figures.items()}, indent=1))
    else:
        for line in _table(figures):
            click.echo(line)


@corpus.command()
@click.argument("file")
@click.option("--to", "form", type=click.Choice(["json", "script"]), required=True, help="What to write.")
@click.option("--out", type=click.Path(path_type=Path), help="Where to; without it, standard output.")
@click.option("--force", is_flag=True, help="Overwrite what is there.")
def convert(file: str, form: str, out: Path | None, force: bool) -> None:
    """Turn a script into JSON, or JSON into a script."""
    scenarios = load_scripts(file)
    text = write_json(scenarios) if form == "json" else write_script(scenarios)
    if out is None:
        click.echo(text, nl=False)
    else:
        _write(out, text, force=force)
        click.echo(f"{out}: {len(scenarios)} scenarios")


def _write(path: Path, text: str, *, force: bool) -> None:
    """Writes beside, then renames: nobody ever sees half a file."""
    if path.exists() and not force:
        raise OutputError(f"{path} is there already; name another file or add --force")
    beside = path.parent / f".{path.name}.{os.getpid()}"
    try:
        beside.write_text(text, encoding="utf-8")
        beside.replace(path)
    except OSError as error:
        beside.unlink(missing_ok=True)
        raise OutputError(f"{path} cannot be written ({error.strerror}); name another place") from None


def _by_theme(scenarios: Sequence[Scenario]) -> dict[str, list[Scenario]]:
    members: dict[str, list[Scenario]] = {}
    for scenario in scenarios:
        members.setdefault(scenario.theme or "no theme", []).append(scenario)
    return members


def _table(figures: Mapping[str, Statistics]) -> Iterator[str]:
    """A line for each figure, a column for each theme."""
    columns = list(figures.values())
    heads = [textwrap.wrap(theme, _COLUMN - 1) for theme in figures]
    depth = max(map(len, heads))
    for i in range(depth):
        yield _row("", (head[i - depth + len(head)] if i >= depth - len(head) else "" for head in heads))
    for name in ("scenarios", "groups", "agents", "events", "nodes"):
        yield _row(name, (f"{getattr(figure, f'n_{name}'):,}" for figure in columns))
    yield _row("agents a group", (f"{f.n_agents / f.n_groups:.2f}" for f in columns))
    yield _row("largest group", (str(max(f.group_sizes)) for f in columns))
    yield _row("steps an agent", (f"{f.n_nodes / f.n_agents:.2f}" for f in columns))
    yield _row("distinct rows", (f"{f.n_distinct_sequences:,}" for f in columns))
    yield _row("their entropy", (f"{f.sequence_entropy:.3f}" for f in columns))
    yield "actions, % of nodes"
    for action in ACTIONS:
        yield _row(f"  {action}", (f"{100 * f.action_shares[action]:.1f}" for f in columns))
    yield "places, % of nodes"
    for category in CATEGORIES:
        yield _row(f"  {category}", (f"{100 * f.category_shares[category]:.1f}" for f in columns))


def _row(name: str, cells: Iterable[str]) -> str:
    return (f"{name:18}" + "".join(f"{cell:>{_COLUMN}}" for cell in cells)).rstrip()
