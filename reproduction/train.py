"""Trains the models of the tables: `paper` for each theme by the full schedule, its two ablations, another reading.

    python -m reproduction.train --dataset out/dataset --out out/models            # hours; killed, it goes on
    python -m reproduction.train --dataset out/dataset --out out/models --ship     # puts them where the tables look

`--only university-campus-full` trains one of them. What is shipped has 16-bit weights.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from safetensors.torch import load_file

from genc.learn.dataset import load_dataset
from genc.learn.paper import VARIANTS, PaperTraining, paper_shape
from genc.learn.run import train
from genc.learn.state import under
from genc.model.checkpoint import CONFIG, PRETRAINED, load_generator, save_checkpoint
from genc.model.paper.vgae import PaperModel
from reproduction.study import HERE, THEMES, folder_of

MODELS: dict[str, tuple[str, dict[str, bool]]] = {variant: (variant, {}) for variant in VARIANTS}
MODELS["kl-per-dimension"] = ("full", {"kl_per_dimension": True})
MODELS["single-kl-per-dimension"] = ("single", {"kl_per_dimension": True})
"""For each model its shape and what is special about its training."""


def ship(run: Path, variant: str, theme: str) -> None:
    """The weights of the last epoch; of the full model also those that did best on held-out groups."""
    generator = load_generator(run)
    assert isinstance(generator.model, PaperModel)
    card = json.loads((run / CONFIG).read_text(encoding="utf-8"))["trained_on"]
    name = folder_of(theme)
    (state,) = map(load_file, run.glob("state-*.safetensors"))
    generator.model.load_state_dict(under("model.", state))
    place = PRETRAINED / f"paper-{name}" if variant == "full" else HERE / "models" / f"{name}-{variant}"
    _save(place, generator.model, card)
    if variant == "full":
        generator.model.float().load_state_dict(under("best.", state))
        _save(HERE / "models" / f"{name}-best", generator.model, card)


def _save(folder: Path, model: PaperModel, card: dict[str, object]) -> None:
    frequencies = model.known_frequencies
    model.half().known_frequencies = frequencies
    save_checkpoint(folder, model, "all-MiniLM-L6-v2", card)
    print(folder)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--dataset", type=Path, required=True, help="a folder made by 'genc dataset build'")
    parser.add_argument("--out", type=Path, required=True, help="each model gets a folder in it")
    parser.add_argument("--only", help="one model, such as university-campus-full")
    parser.add_argument("--epochs", type=int, default=PaperTraining.epochs)
    parser.add_argument("--ship", action="store_true", help="copy what is trained to where the tables look")
    args = parser.parse_args()
    dataset = load_dataset(args.dataset)
    for theme in THEMES:
        for variant, (shape, wishes) in MODELS.items():
            name = f"{folder_of(theme)}-{variant}"
            if args.only in (None, name):
                training = PaperTraining(theme=theme, epochs=args.epochs, **wishes)
                run = train(dataset, args.out / name, training, paper_shape(dataset, theme, shape))
                if args.ship:
                    ship(run, variant, theme)


if __name__ == "__main__":
    main()
