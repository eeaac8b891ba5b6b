"""`genc dataset build` and `genc train`: scripts become a dataset, a dataset becomes a generator."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

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
@click.option("--epochs", default=None, type=int, help="Length of the schedule.")
@click.option("--batch-size", default=None, type=int, help="Groups in a batch.")
@click.option("--seed", default=0, show_default=True, type=click.IntRange(0, 2**32 - 1))
@click.option("--device", default="cpu", show_default=True, help="cpu or cuda.")
def train(dataset_folder: Path, out: Path, epochs: int | None, batch_size: int | None, seed: int, device: str) -> None:
    """Trains the codec generator on DATASET, and leaves the best weights in the folder.

    Killed at any moment, the same command goes on after the last whole epoch to the same weights.
    """
    from genc.errors import BriefError
    from genc.learn.dataset import load_dataset
    from genc.learn.run import train as run
    from genc.learn.train import TrainConfig
    from genc.model.codec import CodecConfig

    standard = TrainConfig()
    n_epochs = standard.epochs if epochs is None else epochs
    size = standard.batch_size if batch_size is None else batch_size
    for name, value in (("--epochs", n_epochs), ("--batch-size", size)):
        if value < 1:
            raise BriefError(f"{name} {value}: must be at least 1")
    data = load_dataset(dataset_folder)
    config = replace(standard, epochs=n_epochs, batch_size=size, seed=seed)
    run(data, out, config, CodecConfig(data.manifest.dimension), device)
    click.echo(f"{out}: trained; use it with 'genc populate --model {out}'")
