"""A tiny untrained generator, and conditions for it."""

from __future__ import annotations

import torch

from genc.model.codec import CodecConfig, CodecModel
from genc.model.generator import CodecGenerator
from genc.words.embed import Hashing

CONFIG = CodecConfig(
    Hashing.dimension, 16, 2, latent=4, condition=8, encoder_depth=1, structure_depth=1, feature_depth=1
)


def generator(**options: float) -> CodecGenerator:
    """The same every time."""
    torch.manual_seed(0)
    return CodecGenerator(CodecModel(CONFIG).eval(), Hashing(), "0" * 16, **options)
