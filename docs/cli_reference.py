"""Writes docs/cli.md from the commands themselves; `--check` only says whether it is up to date."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import click

from genc.cli import cli

PAGE = Path(__file__).parent / "cli.md"
HEAD = """\
# The command line

Written by `make docs` from the commands; do not edit by hand.
"""


def sections(command: click.Command, name: str, parent: click.Context | None = None) -> Iterator[str]:
    """One section for this command and each below it."""
    context = click.Context(command, info_name=name, parent=parent, terminal_width=100)
    yield f"## {context.command_path}\n\n```text\n{command.get_help(context)}\n```\n"
    if isinstance(command, click.Group):
        for child in command.list_commands(context):
            if (found := command.get_command(context, child)) is not None:
                yield from sections(found, child, context)


def main() -> None:
    """Writes the page, or with `--check` compares it."""
    page = "\n".join([HEAD, *sections(cli, "genc")])
    if "--check" not in sys.argv:
        PAGE.write_text(page, encoding="utf-8")
    elif not PAGE.exists() or PAGE.read_text(encoding="utf-8") != page:
        sys.exit("docs/cli.md is out of date; run `make docs`")


if __name__ == "__main__":
    main()
