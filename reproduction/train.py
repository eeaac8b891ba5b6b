"""Trains the models of the tables: `paper` for each theme by the full schedule, and its two ablations.

    python reproduction/train.py --dataset out/dataset --out out/models

Killed, the same command goes on where it was. `--only university_campus-paper` trains one of them.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from genc.learn.dataset import Dataset, load_dataset
from genc.learn.paper import PaperTraining
from genc.learn.run import train
from genc.model.paper.vgae import PaperConfig

THEMES = ("university campus", "train station")
VARIANTS = {"paper": {}, "unordered": {"canonical": False}, "single": {"single": True}}


def train_model(dataset: Dataset, theme: str, variant: str, folder: Path, epochs: int) -> None:
    n_known = len(dataset.rows("train", theme))
    shape = replace(PaperConfig(dataset.manifest.dimension, n_known), **VARIANTS[variant])
    train(dataset, folder, PaperTraining(theme=theme, epochs=epochs), shape)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dataset", type=Path, required=True, help="a folder made by 'genc dataset build'")
    parser.add_argument("--out", type=Path, required=True, help="each model gets a folder in it")
    parser.add_argument("--only", help="one model, such as university_campus-paper")
    parser.add_argument("--epochs", type=int, default=PaperTraining.epochs)
    args = parser.parse_args()
    dataset = load_dataset(args.dataset)
    for theme in THEMES:
        for variant in VARIANTS:
            name = f"{theme.replace(' ', '_')}-{variant}"
            if args.only in (None, name):
                train_model(dataset, theme, variant, args.out / name, args.epochs)


if __name__ == "__main__":
    main()
