from __future__ import annotations

import pytest

from genc.scenario.corpus import load_corpus
from genc.scenario.scenario import Scenario


@pytest.fixture(scope="session")
def authored() -> tuple[Scenario, ...]:
    """All scenarios that ship with the package."""
    return load_corpus()
