"""`World`: plan, motion and provenance together."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from genc.motion.motion import Motion
from genc.plan.plan import CrowdPlan

Provenance = Mapping[str, str | int | float | None]


@dataclass(frozen=True, eq=False)
class World:
    """A populated world.

    Attributes:
        plan: who does what, where and when; holds the environment.
        motion: how it was carried out.
        provenance: what it was made from and with (text, seed, theme, model and its hash, steering, version of
            genc): plain strings and numbers, never a clock reading, so that equal runs give equal bytes.
    """

    plan: CrowdPlan
    motion: Motion
    provenance: Provenance = field(default_factory=dict)
