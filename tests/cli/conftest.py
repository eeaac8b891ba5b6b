"""The command line, and a small model to give to it."""

from __future__ import annotations

import model_folder
import pytest


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    return model_folder.make(tmp_path_factory.mktemp("model"))
