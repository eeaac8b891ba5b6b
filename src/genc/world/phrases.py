"""English for what people do: one phrase for each action and kind of place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from genc.scenario.scenario import Location
from genc.words.vocabulary import Action, Category

_ENCLOSED = {Category.ROOM, Category.BUILDING}
_GROUND = {Category.ROOM, Category.BUILDING, Category.OUTDOOR_AREA}
"""Places that one can be in, as opposed to things that one stands before."""

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
_WITHIN: dict[Action, str] = {
    Action.WANDER: "wander about {the}",
    Action.LOOK_AT: "look around {at}",
    Action.CARRY: "carry something about {the}",
}
"""What is said otherwise of those who are in the place."""
_READABLE = {Category.ITEM, Category.ENTRANCE, Category.EXHIBIT}

# What two or more do with each other, and what is said of somebody whose partner is not in the cast.
_SOCIAL: dict[Action, tuple[str, str]] = {
    Action.WAVE_AT: ("wave to {whom} {at}", "wave to somebody {at}"),
    Action.DISCUSS: ("talk with {whom} {at}", "talk to somebody {at}"),
    Action.MEET: ("meet {whom} {at}", "meet somebody {at}"),
}
_IRREGULAR = {"be": "is", "do": "does", "go": "goes", "carry": "carries"}


@dataclass(frozen=True)
class Setting:
    """Where somebody does something.

    Attributes:
        place: the location.
        within: whether one is inside its footprint, as opposed to beside it.
        named: whether the sentence has just named it, so that "it" and "there" will do.
    """

    place: Location
    within: bool
    named: bool = False

    @property
    def the(self) -> str:
        """The name with its article, where it takes one: "the pizza van", "platform 2"."""
        return "it" if self.named else with_article(self.place.name)

    @property
    def at(self) -> str:
        """ "at the pizza van", "in the waiting room"."""
        if self.named:
            return "there"
        inside = self.within and self.place.category in _ENCLOSED
        return f"{'in' if inside else 'at'} {self.the}"


def doing(action: Action, setting: Setting, whom: str = "") -> str:
    """A verb phrase in the base form, such as "wait at the pizza van" or "talk with Person 3 in the hall".

    `whom` are the partners, as `names` or "each other"; empty for somebody alone.
    """
    template = _template(action, setting, bool(whom))
    if setting.named:
        template = template.removesuffix(" {at}").removesuffix(" to {the}").removesuffix(" about {the}")
    return template.format(whom=whom, the=setting.the, at=setting.at)


def is_social(action: Action) -> bool:
    """Whether `doing` itself says with whom."""
    return action in _SOCIAL


def passing(place: Location, way: str) -> str:
    """A phrase for coming or going; `way` is "first" or "last" of a life, "in" or "out", or "through"."""
    if place.category is Category.ENTRANCE:
        template = {"first": "come in by {the}", "last": "leave by {the}"}.get(way, "go through {the}")
    else:
        template = {"first": "come out of {the}", "out": "leave {the}"}.get(way, "go into {the}")
    return template.format(the=with_article(place.name))


def said_of(phrase: str, plural: bool) -> str:
    """A base-form phrase as said of one ("waits at ...") or of several ("wait at ...", "are busy ...")."""
    verb, space, rest = phrase.partition(" ")
    if not plural:
        verb = _IRREGULAR.get(verb, verb + "s")
    elif verb == "be":
        verb = "are"
    return verb + space + rest


def names(agents: Sequence[int], most: int = 4) -> str:
    """ "Person 3", "Persons 3 and 4", "Persons 3, 4, 5 and 6 others"."""
    if len(agents) == 1:
        return f"Person {agents[0]}"
    shown = [str(agent) for agent in agents[:most]]
    left = len(agents) - len(shown)
    *head, tail = [*shown, f"{left} others"] if left > 1 else [str(agent) for agent in agents[: most + 1]]
    return f"Persons {', '.join(head)} and {tail}"


def with_article(name: str) -> str:
    """ "the pizza van", but "platform 2" and "Hall B"."""
    last = name.split()[-1]
    proper = name[:1].isupper() or any(c.isdigit() for c in last) or (len(last) == 1 and " " in name)
    return name if proper or name.startswith(("the ", "a ", "an ")) else f"the {name}"


def clock(time_s: float) -> str:
    """A moment: minutes and seconds from the beginning, "02:45"."""
    return f"{int(time_s + 0.5) // 60:02d}:{int(time_s + 0.5) % 60:02d}"


def span(length_s: float) -> str:
    """A length of time: "40 s", "1:20 min"."""
    seconds = int(length_s + 0.5)
    return f"{seconds} s" if seconds < 60 else f"{seconds // 60}:{seconds % 60:02d} min"


def _template(action: Action, setting: Setting, accompanied: bool) -> str:
    category = setting.place.category
    if action in _SOCIAL:
        if action is Action.DISCUSS and category is Category.SERVICE_AREA and not accompanied:
            return "talk with the staff {at}"
        return _SOCIAL[action][0 if accompanied else 1]
    if action is Action.READ and category in _READABLE:
        return "read {the}"
    if action is Action.OBJECT_INTERACT and category in _GROUND:
        return "be busy with something {at}"
    return (_WITHIN if setting.within and category in _GROUND else {}).get(action, _GENERAL[action])
