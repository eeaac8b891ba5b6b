"""The overview: a whole world on one page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from genc.world.census import tell_minutes, tell_people, tell_places, tell_status
from genc.world.story import tell_group
from genc.world.world import World

_N_EXAMPLES = 2


def tell_world(world: World) -> list[str]:
    """What the world is, how it was made, what goes on in it minute by minute, and the stories of two groups."""
    text = world.provenance.get("text")
    examples = _examples(world)
    return [
        *([str(text)] if text else []),
        tell_people(world),
        *world.plan.notes,
        *_section("Minute by minute", tell_minutes(world)),
        *_section("Places, the busiest first", tell_places(world)),
        *_section("Some of the groups", [line for group in examples for line in tell_group(world, group)]),
        "",
        tell_status(world),
    ]


def _section(title: str, lines: Sequence[str]) -> list[str]:
    return ["", f"{title}:", *lines] if lines else []


def _examples(world: World) -> list[int]:
    """Groups whose stories are worth reading first: those whose people did most together, in order of number."""
    together: Counter[int] = Counter()
    for done in world.motion.executed:
        person = world.plan.people[done.agent]
        together[person.group] += bool(person.activities[done.step].partners)
    most = sorted(together, key=lambda group: (-together[group], group))[:_N_EXAMPLES]
    return sorted(most)
