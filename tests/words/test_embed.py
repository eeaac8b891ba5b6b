from __future__ import annotations

import shutil

import numpy as np
import pytest

from genc.errors import EncoderError
from genc.words import embed
from genc.words.embed import Hashing, load_encoder

TEXTS = ["That is a happy person", "That is a very happy person", "Today is a sunny day", "", "Grüße!"]


def _laws(encoder):
    vectors = encoder.encode(TEXTS)
    assert vectors.shape == (len(TEXTS), encoder.dimension)
    assert vectors.dtype == np.float32
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=1), 1, atol=1e-5)
    alone = np.concatenate([encoder.encode([text]) for text in TEXTS])
    np.testing.assert_allclose(vectors, alone, atol=1e-5)
    return vectors


def test_hashing_keeps_the_laws_of_an_encoder():
    vectors = _laws(Hashing())
    assert vectors[0] @ vectors[1] > vectors[0] @ vectors[2]


@pytest.mark.text
def test_minilm_knows_what_its_model_card_says():
    vectors = _laws(load_encoder("minilm"))
    assert vectors[0] @ vectors[1] == pytest.approx(0.943, abs=0.001)
    assert vectors[0] @ vectors[2] == pytest.approx(0.257, abs=0.001)


@pytest.mark.text
def test_altered_weights_are_refused(tmp_path, monkeypatch):
    folder = shutil.copytree(embed._minilm_folder(), tmp_path / "model")
    with (folder / "model.safetensors").open("r+b") as file:
        file.seek(-1, 2)
        file.write(b"\x00" if file.read(1) != b"\x00" else b"\x01")
    monkeypatch.setattr(embed, "_minilm_folder", lambda: folder)
    with pytest.raises(EncoderError, match="altered"):
        load_encoder("minilm")


def test_an_unknown_encoder_is_refused_by_name():
    with pytest.raises(EncoderError, match="'glove': choose one of minilm, mpnet, hashing"):
        load_encoder("glove")
