"""Hypothesis strategies for sound scenarios."""

from __future__ import annotations

from hypothesis import strategies as st

from genc.scenario.draft import clean
from genc.scenario.faults import LETTERS
from genc.scenario.scenario import Environment, Event, Group, Location, Scenario
from genc.words.vocabulary import ACTIONS, CATEGORIES

texts = st.text(st.characters(exclude_categories=("Cs",)), min_size=1, max_size=30).map(clean).filter(bool)
names = texts.map(lambda text: clean(text.replace(",", " ").replace("|", " "))).filter(bool)
metres = st.floats(-1e4, 1e4)
sizes = st.floats(1e-3, 1e4)


@st.composite
def environments(draw: st.DrawFn) -> Environment:
    unique = draw(st.lists(names, min_size=1, max_size=4, unique=True))
    return Environment(
        tuple(
            Location(
                name,
                draw(st.sampled_from(CATEGORIES)),
                (draw(metres), draw(metres)),
                (draw(sizes), draw(sizes)),
            )
            for name in unique
        )
    )


@st.composite
def scenarios(draw: st.DrawFn) -> Scenario:
    environment = draw(environments())
    ids = draw(st.lists(st.integers(0, 999), min_size=2, max_size=12, unique=True))
    # An event may wait for any that stands before it in one hidden order, so triggers make no circle.
    hidden = draw(st.permutations(ids))
    after = {
        event_id: draw(st.none() | st.sampled_from(hidden[:i])) if i else None for i, event_id in enumerate(hidden)
    }
    cut = draw(st.integers(1, len(ids) - 1))
    groups = tuple(draw(_groups(part, after, environment)) for part in (ids[:cut], ids[cut:]))
    return Scenario(
        slug=draw(texts),
        theme=draw(st.just("") | texts),
        sentence=draw(texts),
        paraphrases=tuple(draw(st.lists(texts, max_size=3))),
        environment=environment,
        groups=groups,
    )


@st.composite
def _groups(draw: st.DrawFn, ids: list[int], after: dict[int, int | None], where: Environment) -> Group:
    everybody = LETTERS[: draw(st.integers(1, 4))]
    locations = st.sampled_from([location.name for location in where.locations])
    pairs = st.lists(st.tuples(st.sampled_from(ACTIONS), locations), min_size=1, max_size=3)
    events = []
    for i, event_id in enumerate(ids):
        some = everybody if i == 0 else draw(st.lists(st.sampled_from(everybody), min_size=1, unique=True))
        events.append(Event(event_id, tuple(some), tuple(draw(pairs)), after[event_id]))
    return Group(draw(texts), tuple(draw(st.permutations(events))))
