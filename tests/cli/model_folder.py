"""A tiny untrained model on disk: the command line needs one, and loading the shipped encoder takes seconds."""

from __future__ import annotations

from pathlib import Path

import torch

from genc.model.checkpoint import save_checkpoint
from genc.model.codec import CodecConfig, CodecModel
from genc.words.embed import Hashing


def make(folder: Path) -> Path:
    torch.manual_seed(0)
    shape = CodecConfig(Hashing.dimension, 16, 2, 4, 8, encoder_depth=1, structure_depth=1, feature_depth=1)
    save_checkpoint(folder, CodecModel(shape), Hashing.id, {})
    return folder
