"""Sources by name: a trained generator, or a baseline that knows the material."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from genc.errors import CheckpointError
from genc.evaluate.baselines import Perturb, Random, Retrieval, Shuffle
from genc.evaluate.material import Material
from genc.model.checkpoint import SHIPPED, load_generator, shipped_models
from genc.model.source import GraphSource

BASELINES: dict[str, Callable[[Material], GraphSource]] = {
    "random": lambda material: Random([s.graph for s in material.train]),
    "perturb": lambda material: Perturb([s.graph for s in material.test]),
    "shuffle": lambda material: Shuffle([s.graph for s in material.train]),
    "retrieval": lambda material: Retrieval(
        [s.graph for s in material.train],
        [(s.sentence, *s.paraphrases, s.caption) for s in material.train],
        material.encoder(),
        whole_condition=True,
    ),
}
"""Those of the paper's experiments, and two of ours; all but `perturb`, which spoils the test groups, see the training
groups alone."""


def load_source(name: Path | str, material: Material) -> GraphSource:
    """The baseline of that name, or else the generator in that folder or shipped under that name.

    'shipped' is the one that is used unless another is named.

    Raises:
        CheckpointError: if there is neither, or the weights cannot be used.
        EncoderError: if a text encoder cannot be loaded.
    """
    if str(name) in BASELINES:
        return BASELINES[str(name)](material)
    folder = SHIPPED if str(name) == "shipped" else Path(name)
    if not folder.is_dir() and str(name) not in shipped_models():
        raise CheckpointError(
            f"{name}: neither a folder of a model nor a baseline: name a folder that 'genc train' has made, or one of "
            f"{', '.join([*shipped_models(), *BASELINES])}"
        )
    return load_generator(folder)
