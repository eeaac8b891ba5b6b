"""`genc assess`: what follows what in two corpora, and how various they are."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.argument("a", metavar="A")
@click.argument("b", metavar="B")
@click.option(
    "--out", default="out/assessment", show_default=True, type=click.Path(path_type=Path), help="Folder for the report."
)
@click.option("--merge", is_flag=True, help="Make repetitions of an action one, as is always done beside video.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1), help="Of all chance.")
def assess(a: str, b: str, out: Path, seed: int, *, merge: bool) -> None:
    """Compares what people do one after the other in A and in B, and writes a report.

    Each is a dataset folder, scenario scripts (a file or a folder), a shipped theme by its name, or annotations of real
    video (a CSV file of clip,window,person,action); docs/assessment.md describes them.
    """
    from genc.evaluate.assessment import assess as compare
    from genc.evaluate.assessment_report import write_assessment
    from genc.evaluate.provenance import check_extra
    from genc.files import ensure_folder

    check_extra()
    assessment = compare(a, b, seed, merge=merge)
    ensure_folder(out)
    page = write_assessment(assessment, out)
    for note in assessment.notes:
        click.echo(f"note: {note}", err=True)
    for letter, side in assessment.sides.items():
        ends = "" if side.low is None else f" ({side.low:.4f} to {side.high:.4f})"
        click.echo(f"{letter}: entropy of {assessment.size:,} action sequences {side.entropy:.4f}{ends}")
    click.echo(f"{page}: read it beside {page.parent / 'transitions.png'}")
