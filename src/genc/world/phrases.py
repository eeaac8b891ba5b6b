"""English for what people do: one phrase for each action and kind of place."""

from __future__ import annotations

from collections.abc import Sequence

from genc.scenario.scenario import Location
from genc.words.vocabulary import Action, Category

_INSIDE = {Category.ROOM, Category.BUILDING}
_GROUND = {Category.ROOM, Category.BUILDING, Category.OUTDOOR_AREA}
"""Places that one is in, as opposed to things that one stands before."""

_GENERAL: dict[Action, str] = {
    Action.WAIT: "wait {at}",
    Action.SIT: "sit {at}",
    Action.WANDER: "walk around {the}",
    Action.QUEUE: "stand in line {at}",
    Action.ENTER_EXIT: "go through {the}",
    Action.OBJECT_INTERACT: "use {the}",
    Action.TALK_ON_PHONE: "talk on the phone {at}",
    Action.READ: "read {at}",
    Action.LOOK_AT: "look at {the}",
    Action.CARRY: "carry something to {the}",
}
_ON_GROUND: dict[Action, str] = {
    Action.WANDER: "wander about {the}",
    Action.OBJECT_INTERACT: "be busy {at}",
    Action.LOOK_AT: "look around {at}",
    Action.CARRY: "carry something about {the}",
}
_READABLE = {Category.ITEM, Category.ENTRANCE, Category.EXHIBIT}

# What two or more do with each other, and what is said of somebody whose partner is not in the cast.
_SOCIAL: dict[Action, tuple[str, str]] = {
    Action.WAVE_AT: ("wave to {whom} {at}", "wave to somebody {at}"),
    Action.DISCUSS: ("talk with {whom} {at}", "talk to somebody {at}"),
    Action.MEET: ("meet {whom} {at}", "meet somebody {at}"),
}
_IRREGULAR = {"be": "is", "go": "goes", "carry": "carries"}


def doing(action: Action, place: Location, whom: str = "") -> str:
    """A verb phrase in the base form, such as "wait at the pizza van" or "talk with Person 3 in the hall".

    `whom` are the partners, as `names` or "each other"; empty for somebody alone.
    """
    return _template(action, place.category, bool(whom)).format(at=at(place), the=the(place), whom=whom)


def is_social(action: Action) -> bool:
    """Whether `doing` itself says with whom."""
    return action in _SOCIAL


def passing(place: Location, stay: str) -> str:
    """A phrase for coming or going: `stay` is "first" in a life, "last", "again" (from within) or "between"."""
    if place.category is Category.ENTRANCE:
        template = {"first": "come in by {the}", "last": "leave by {the}"}.get(stay, "go through {the}")
    elif stay == "first":
        template = "come out of {the}"
    else:
        template = "leave {the}" if stay == "again" else "go into {the}"
    return template.format(the=the(place))


def said_of(phrase: str, plural: bool) -> str:
    """A base-form phrase as said of one ("waits at ...") or of several ("wait at ...", "are busy ...")."""
    verb, space, rest = phrase.partition(" ")
    if plural:
        verb = "are" if verb == "be" else verb
    else:
        verb = _IRREGULAR.get(verb, verb + "s")
    return verb + space + rest


def names(agents: Sequence[int], most: int = 4) -> str:
    """ "Person 3", "Persons 3 and 4", "Persons 3, 4, 5 and 6 others"."""
    if len(agents) == 1:
        return f"Person {agents[0]}"
    shown = [str(agent) for agent in agents[:most]]
    left = len(agents) - len(shown)
    *head, tail = [*shown, f"{left} others"] if left > 1 else [str(agent) for agent in agents[: most + 1]]
    return f"Persons {', '.join(head)} and {tail}"


def the(place: Location) -> str:
    """The name with its article, where it takes one: "the pizza van", "platform 2"."""
    name = place.name
    last = name.split()[-1]
    proper = name[:1].isupper() or any(c.isdigit() for c in last) or (len(last) == 1 and " " in name)
    return name if proper or name.startswith(("the ", "a ", "an ")) else f"the {name}"


def at(place: Location) -> str:
    """ "at the pizza van", "in the waiting room"."""
    return f"{'in' if place.category in _INSIDE else 'at'} {the(place)}"


def clock(time_s: float) -> str:
    """A moment: minutes and seconds from the beginning, "02:45"."""
    return f"{int(time_s + 0.5) // 60:02d}:{int(time_s + 0.5) % 60:02d}"


def span(length_s: float) -> str:
    """A length of time: "40 s", "1:20 min"."""
    seconds = int(length_s + 0.5)
    return f"{seconds} s" if seconds < 60 else f"{seconds // 60}:{seconds % 60:02d} min"


def _template(action: Action, category: Category, accompanied: bool) -> str:
    if action in _SOCIAL:
        if action is Action.DISCUSS and category is Category.SERVICE_AREA and not accompanied:
            return "talk with the staff {at}"
        return _SOCIAL[action][0 if accompanied else 1]
    if action is Action.READ and category in _READABLE:
        return "read {the}"
    return (_ON_GROUND if category in _GROUND else {}).get(action, _GENERAL[action])
