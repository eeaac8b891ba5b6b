"""`genc evaluate`: how near a source's groups are to authored ones, as a report."""

from __future__ import annotations

from pathlib import Path

import click


@click.command()
@click.option(
    "--model",
    default="shipped",
    show_default=True,
    help="A folder that 'genc train' made; or a baseline: random, perturb, shuffle, retrieval.",
)
@click.option(
    "--dataset",
    "data",
    required=True,
    type=click.Path(path_type=Path),
    help="A folder that 'genc dataset build' made; or scenario scripts (a file or a folder), to compare with them all.",
)
@click.option(
    "--out", default="out/evaluation", show_default=True, type=click.Path(path_type=Path), help="Folder for the report."
)
@click.option("--theme", default=None, help="Compare groups of this theme only.")
@click.option("--split", "part", default=None, help="Of a dataset: test (as a rule), validation or held-out (both).")
@click.option(
    "--ask",
    default="full",
    show_default=True,
    help="How groups are asked for: full (text, counts, frequencies), sentence or caption.",
)
@click.option("--repeats", default=20, show_default=True, help="Groups asked for each group of the test set.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1), help="Of all chance.")
def evaluate(  # noqa: PLR0913 - one parameter for each option
    model: str,
    data: Path,
    out: Path,
    theme: str | None,
    part: str | None,
    ask: str,
    repeats: int,
    seed: int,
) -> None:
    """Measures how near the groups of a model or baseline are to authored ones, and writes a report.

    Every figure stands beside its floor; docs/evaluation.md says how to read it.
    """
    from genc.evaluate.evaluation import Trial
    from genc.evaluate.examine import examine
    from genc.evaluate.material import read_material
    from genc.evaluate.provenance import check_extra
    from genc.evaluate.report import write_report
    from genc.evaluate.sources import load_source
    from genc.files import ensure_folder

    check_extra()
    trial = Trial(ask, repeats, seed)
    material = read_material(data, theme, part, seed)
    source = load_source(model, material)
    ensure_folder(out)
    evaluation = examine(source, material, trial, model)
    page = write_report(evaluation, out)
    total = evaluation["total"]
    for note in evaluation.notes:
        click.echo(f"note: {note}", err=True)
    if total.generated is not None:
        ratio = total.ratio(total.generated)
        floor = "" if ratio is None else f", {ratio:.2f} times the floor"
        click.echo(f"{model}: {total.generated.mean:.3f} nats from {len(material.test):,} authored groups{floor}")
    click.echo(f"{page}: open it in a browser")
