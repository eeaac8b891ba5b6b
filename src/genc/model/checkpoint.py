"""Weights on disk: a folder with `config.json` and `model.safetensors`, checked before they are used."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from safetensors import SafetensorError
from safetensors.torch import load, save

from genc.errors import CheckpointError
from genc.files import ensure_folder, write_text, written_beside
from genc.model.codec import CodecConfig, CodecModel
from genc.model.generator import CodecGenerator
from genc.model.paper.generator import PaperGenerator
from genc.model.paper.vgae import PaperConfig, PaperModel
from genc.words.embed import TextEncoder, load_encoder
from genc.words.vocabulary import vocabulary_hash

SCHEMA = 1
WEIGHTS = "model.safetensors"
CONFIG = "config.json"
PRETRAINED = Path(__file__).parents[1] / "pretrained"
"""The models that come with the package, each a folder."""
SHIPPED = PRETRAINED / "codec"
"""The one that is used unless another is named."""

Model = CodecModel | PaperModel
Generator = CodecGenerator | PaperGenerator
_SHAPES: dict[str, type[CodecConfig] | type[PaperConfig]] = {"codec": CodecConfig, "paper": PaperConfig}


def save_checkpoint(folder: Path | str, model: Model, encoder_id: str, trained_on: dict[str, Any]) -> None:
    """Writes a model; the config comes last, so a folder without one holds nothing usable.

    `trained_on` is kept as it is: whatever says where the weights come from.

    Raises:
        OutputError: if it cannot be written.
    """
    place = ensure_folder(folder)
    with written_beside(place / WEIGHTS) as beside:
        beside.write_bytes(save({name: tensor.contiguous() for name, tensor in model.state_dict().items()}))
    digest = hashlib.sha256((place / WEIGHTS).read_bytes()).hexdigest()
    config = {
        "schema": SCHEMA,
        "generator": next(name for name, shape in _SHAPES.items() if isinstance(model.config, shape)),
        "vocabulary_hash": vocabulary_hash(),
        "encoder": encoder_id,
        "weights_sha256": digest,
        "model": asdict(model.config),
        "trained_on": trained_on,
    }
    write_text(place / CONFIG, json.dumps(config, indent=1, sort_keys=True) + "\n")


def load_generator(folder: Path | str = SHIPPED, encoder: TextEncoder | None = None) -> Generator:
    """The generator in that folder, or the shipped one of that name (`shipped_models`), ready to sample.

    Args:
        encoder: a text encoder that is loaded already; by default the one that the weights were trained with.

    Raises:
        CheckpointError: naming what is missing, damaged, or does not match.
        EncoderError: if its text encoder cannot be loaded.
    """
    place = PRETRAINED / folder if str(folder) in shipped_models() and not Path(folder).exists() else Path(folder)
    config = _read_config(place)
    if encoder is not None and encoder.id != config["encoder"]:
        raise CheckpointError(
            f"{place}: trained with the text encoder {config['encoder']}, which does not go with {encoder.id}"
        )
    weights, digest = _read_weights(place, str(config["weights_sha256"]))
    kind = _SHAPES[config["generator"]]
    shape = kind(**{f.name: config["model"][f.name] for f in fields(kind)})
    text = load_encoder(config["encoder"]) if encoder is None else encoder
    if text.dimension != shape.text_dim:
        raise CheckpointError(f"{place}: made for text vectors of {shape.text_dim}; {text.id} gives {text.dimension}")
    try:
        model = CodecModel(shape) if isinstance(shape, CodecConfig) else PaperModel(shape)
        model.load_state_dict(weights)
    except (RuntimeError, TypeError, ValueError) as error:
        detail = " ".join(str(error).split())[:160]
        raise CheckpointError(
            f"{place}: the weights do not fit their own config ({detail}): fetch them anew"
        ) from error
    model.eval()
    if isinstance(model, CodecModel):
        return CodecGenerator(model, text, digest[:16])
    return PaperGenerator(model, text, digest[:16])


def shipped_models() -> list[str]:
    """The names of the models that come with the package."""
    return sorted(place.parent.name for place in PRETRAINED.glob(f"*/{CONFIG}"))


def _read_config(place: Path) -> dict[str, Any]:
    path = place / CONFIG
    try:
        config = json.loads(path.read_text(encoding="utf-8"))
        found = {key: config[key] for key in ("schema", "generator", "vocabulary_hash", "encoder", "weights_sha256")}
        missing = [
            f.name for f in fields(_SHAPES.get(config["generator"], CodecConfig)) if f.name not in config["model"]
        ]
    except FileNotFoundError:
        raise CheckpointError(
            f"{place}: no model here (no {CONFIG}): name a folder that 'genc train' has made, or one of "
            f"{', '.join(shipped_models())}"
        ) from None
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise CheckpointError(f"{path}: not the config of a model ({error!r}): fetch or train it anew") from error
    if found["schema"] != SCHEMA:
        raise CheckpointError(f"{path}: schema {found['schema']}; this version of genc reads {SCHEMA}")
    if found["generator"] not in _SHAPES:
        known = " and ".join(map(repr, _SHAPES))
        raise CheckpointError(f"{path}: holds a {found['generator']!r} generator; this version of genc knows {known}")
    if found["vocabulary_hash"] != vocabulary_hash():
        raise CheckpointError(
            f"{path}: trained with another vocabulary ({found['vocabulary_hash']}, not {vocabulary_hash()}): train anew"
        )
    if missing:
        raise CheckpointError(f"{path}: says nothing of {', '.join(missing)}: fetch or train it anew")
    return dict(config)


def _read_weights(place: Path, expected: str) -> tuple[dict[str, Any], str]:
    path = place / WEIGHTS
    try:
        content = path.read_bytes()
    except OSError as error:
        raise CheckpointError(f"{path}: cannot be read ({error.strerror}): fetch or train the model anew") from error
    digest = hashlib.sha256(content).hexdigest()
    if digest != expected:
        raise CheckpointError(
            f"{path}: cut short or not the weights of its config ({len(content)} bytes, SHA-256 {digest[:12]}..., "
            f"expected {expected[:12]}...): fetch or train the model anew"
        )
    try:
        return load(content), digest
    except SafetensorError as error:
        raise CheckpointError(f"{path}: no safetensors file ({error}): fetch or train the model anew") from error
