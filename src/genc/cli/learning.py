"""`genc dataset build` and `genc train`: scripts become a dataset, a dataset becomes a generator."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click


@click.group()
def dataset() -> None:
    """Datasets to train on."""


@dataset.command()
@click.argument("scripts", nargs=-1, type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Folder to make.")
@click.option("--encoder", default="minilm", show_default=True, help="Text encoder: minilm, mpnet or hashing.")
@click.option(
    "--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1), help="Of the split and the rehearsals."
)
def build(scripts: tuple[Path, ...], out: Path, encoder: str, seed: int) -> None:
    """Makes a dataset of SCRIPTS (files or folders; by default the shipped corpus).

    Interrupted, the same command goes on where it was.
    """
    from genc.learn.build import build_dataset
    from genc.scenario.corpus import load_corpus, load_scripts
    from genc.words.embed import load_encoder

    scenarios = load_scripts(*scripts) if scripts else load_corpus()
    manifest = build_dataset(scenarios, load_encoder(encoder), out, seed)
    parts = ", ".join(f"{n:,} {name}" for name, n in manifest.split.items())
    click.echo(f"{out}: {manifest.n_groups:,} groups of {manifest.n_scenarios:,} scenarios ({parts})")


@click.command()
@click.argument("dataset_folder", metavar="DATASET", type=click.Path(path_type=Path))
@click.option("--out", required=True, type=click.Path(path_type=Path), help="Folder of the run and of the model.")
@click.option(
    "--generator", default="codec", show_default=True, type=click.Choice(["codec", "paper"]), help="What to train."
)
@click.option("--variant", default="full", show_default=True, help="Of the paper's model: full, unordered or single.")
@click.option("--theme", default=None, help="Only scenarios of this theme.")
@click.option("--epochs", default=None, type=int, help="Length of the schedule.")
@click.option("--batch-size", default=None, type=int, help="Groups in a batch.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1))
@click.option("--device", default="cpu", show_default=True, help="cpu or cuda.")
def train(  # noqa: PLR0913 - one parameter for each option
    dataset_folder: Path,
    out: Path,
    generator: str,
    variant: str,
    theme: str | None,
    epochs: int | None,
    batch_size: int | None,
    seed: int,
    device: str,
) -> None:
    """Trains a generator on DATASET, and leaves its weights in the folder.

    `codec`, the default, keeps the weights that do best on held-out scenarios; `paper`, the model of Gen-C, those of
    the last epoch. Killed at any moment, the same command goes on after the last epoch saved to the same weights.
    """
    from genc.errors import BriefError
    from genc.learn.dataset import load_dataset
    from genc.learn.paper import PaperTraining, paper_shape
    from genc.learn.run import train as run
    from genc.learn.train import TrainConfig
    from genc.model.codec import CodecConfig

    for name, value in (("--epochs", epochs), ("--batch-size", batch_size)):
        if value is not None and value < 1:
            raise BriefError(f"{name} {value}: must be at least 1")
    if generator == "codec" and variant != "full":
        raise BriefError(f"--variant {variant}: only the paper's model has variants: add --generator paper")
    data = load_dataset(dataset_folder)
    asked = {"theme": theme, "epochs": epochs, "batch_size": batch_size, "seed": seed}
    wishes: dict[str, Any] = {name: value for name, value in asked.items() if value is not None}
    if generator == "paper":
        run(data, out, PaperTraining(**wishes), paper_shape(data, theme, variant), device)
    else:
        run(data, out, TrainConfig(**wishes), CodecConfig(data.manifest.dimension), device)
    click.echo(f"{out}: trained; use it with 'genc populate --model {out}'")
