"""Which place a sentence means: layouts and locations by nearness of meaning."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.scenario.scenario import Environment, Scenario
from genc.words.embed import TextEncoder
from genc.words.vocabulary import CATEGORIES

_THEME, _NAMES = 0.4, 0.4
"""What the theme and the names of the locations weigh beside the sentence."""
_LACK = 0.05
"""What each category costs that a layout lacks: a crowd may need it."""
FAMILIAR = 0.3
"""Cosine to the nearest authored sentence below which a text is told to be far from all that was learned."""


@dataclass(frozen=True)
class Layout:
    """An environment, and how near the nearest authored sentence is to the text it was chosen for, cosine."""

    environment: Environment
    nearness: float = 1.0


def nearest_layout(text: str, authored: Sequence[Scenario], encoder: TextEncoder) -> Layout:
    """The environment of the authored scenario that suits a text best: by sentence, theme, and names of places."""
    said = encoder.encode([scenario.sentence for scenario in authored])
    names = sorted({scenario.theme for scenario in authored})
    of_theme = dict(zip(names, encoder.encode(names), strict=True))
    themes = np.array([of_theme[scenario.theme] for scenario in authored])
    named = encoder.encode([", ".join(place.name for place in s.environment.locations) for s in authored])
    asked = encoder.encode([text])[0]
    lacking = [len(CATEGORIES) - len({p.category for p in s.environment.locations}) for s in authored]
    suits = (said + _THEME * themes + _NAMES * named) @ asked - _LACK * np.array(lacking)
    return Layout(authored[int(np.argmax(suits))].environment, float((said @ asked).max()))


def affinity(text: str, environment: Environment, encoder: TextEncoder) -> NDArray[np.float64]:
    """How near in meaning each location's name is to a text, cosine, `[n_locations]`."""
    vectors = encoder.encode([text, *(place.name for place in environment.locations)])
    near: NDArray[np.float64] = (vectors[1:] @ vectors[0]).astype(np.float64)
    return near
