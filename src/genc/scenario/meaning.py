"""Which place a sentence means: layouts and locations by nearness of meaning."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from genc.scenario.scenario import Environment, Scenario
from genc.words.embed import TextEncoder
from genc.words.vocabulary import CATEGORIES

_THEME, _NAMES = 0.5, 0.5
"""What the theme and the names of the locations weigh beside the sentence."""
_LACK = 0.04
"""What each category costs that a layout lacks: a crowd may need it."""


def nearest_layout(text: str, authored: Sequence[Scenario], encoder: TextEncoder) -> Environment:
    """The environment of the authored scenario that suits a text best: by sentence, theme, and names of places."""
    said = encoder.encode([scenario.sentence for scenario in authored])
    names = sorted({scenario.theme for scenario in authored})
    of_theme = dict(zip(names, encoder.encode(names), strict=True))
    themes = np.array([of_theme[scenario.theme] for scenario in authored])
    named = encoder.encode([", ".join(place.name for place in s.environment.locations) for s in authored])
    nearness = (said + _THEME * themes + _NAMES * named) @ encoder.encode([text])[0]
    lacking = [len(CATEGORIES) - len({p.category for p in s.environment.locations}) for s in authored]
    return authored[int(np.argmax(nearness - _LACK * np.array(lacking)))].environment


def affinity(text: str, environment: Environment, encoder: TextEncoder) -> NDArray[np.float64]:
    """How near in meaning each location's name is to a text, cosine, `[n_locations]`."""
    vectors = encoder.encode([text, *(place.name for place in environment.locations)])
    near: NDArray[np.float64] = (vectors[1:] @ vectors[0]).astype(np.float64)
    return near
