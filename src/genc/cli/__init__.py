"""The command line: the only room that prints, parses arguments or exits.

In: arguments. Out: files, lines, an exit code. May import: everything. Never: be imported.
"""

from __future__ import annotations

import sys

import click

from genc.cli.assessing import assess
from genc.cli.authoring import author
from genc.cli.corpus import corpus
from genc.cli.evaluating import evaluate
from genc.cli.exporting import export
from genc.cli.learning import dataset, train
from genc.cli.rendering import render
from genc.cli.worlds import populate, stage, story
from genc.errors import GencError


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="genc")
def cli() -> None:
    """One sentence in, a populated world out."""


for command in (populate, stage, story, render, export, corpus, dataset, train, author, evaluate, assess):
    cli.add_command(command)


def main() -> None:
    """Runs the command line; what the user can mend is said in one line each, with exit code 2."""
    try:
        cli(standalone_mode=False)
    except GencError as error:
        _refuse(str(error).splitlines())
    except click.exceptions.NoArgsIsHelpError as error:
        error.show()
        sys.exit(2)
    except click.ClickException as error:
        command = error.ctx.command_path if isinstance(error, click.UsageError) and error.ctx else "genc"
        _refuse([f"{' '.join(error.format_message().split())} See '{command} --help'."])
    except click.Abort:
        click.echo("interrupted: run the same command again", err=True)
        sys.exit(130)


def _refuse(lines: list[str]) -> None:
    for line in lines:
        click.echo(f"error: {line}", err=True)
    sys.exit(2)
