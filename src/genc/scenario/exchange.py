"""Scenarios as JSON: what the paper's Q1 (environment) and Q2 (events) give, and the texts around them.

    {"scenarios": [{
      "slug": "...", "theme": "...", "sentence": "...", "paraphrases": ["..."],
      "locations": [{"name": "...", "category": "...", "position": [x, y], "scale": [width, depth]}],
      "groups": [{"caption": "...", "events": [
        {"id": 1, "after": null, "agents": ["a", "b"], "pairs": [{"action": "...", "location": "..."}]}]}]}]}

`locations` is Q1's reply and `events` Q2's (Gen-C, Bootstrapping Crowd Scenarios via LLMs).
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path as FilePath
from typing import Any, TypeVar

from genc.errors import LayoutError, ScriptError
from genc.scenario.draft import Draft, clean, read_text, settle
from genc.scenario.faults import Fault, Path, suggest
from genc.scenario.scenario import Environment, Event, Group, Location, Scenario
from genc.scenario.script import script_drafts
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category, parse_action, parse_category

_T = TypeVar("_T")
_Object = dict[str, Any]


def parse_json(text: str, source: str) -> tuple[Scenario, ...]:
    """The scenarios of a JSON text; `source` names it in messages.

    Raises:
        ScriptError: with every problem of the text: where, what is wrong, how to mend it.
    """
    return settle(json_drafts(text, source))


def write_json(scenarios: Iterable[Scenario]) -> str:
    """The JSON of these scenarios: `parse_json` gives them back, equal in every part."""
    document = {"scenarios": [_scenario_object(scenario) for scenario in scenarios]}
    return json.dumps(document, ensure_ascii=False, indent=1) + "\n"


def read_drafts(path: FilePath | str) -> list[Draft]:
    """The scenarios of a file, script or JSON (told apart by content), as drafts.

    Raises:
        ScriptError: if the file cannot be read or holds no scenario.
    """
    text = read_text(path)
    read = json_drafts if text.lstrip()[:1] in ("{", "[") else script_drafts
    return read(text, str(path))


def read_environment(path: FilePath | str) -> Environment:
    """The environment of the first scenario of a script or JSON file, or of a file of locations only.

    Raises:
        ScriptError: if the file cannot be read, or with every problem of its locations.
        LayoutError: if it has fewer than two locations.
    """
    draft = read_drafts(path)[0]
    environment = draft.scenario.environment
    # A line that was not understood may have been meant as a location; all else is of no concern here.
    found = [fault for fault in draft.faults() if fault.path[:1] in (("locations",), ("lines",))]
    if found:
        raise ScriptError(draft.lines(found))
    if (n := len(environment.locations)) < 2:
        raise LayoutError(f"{path}: an environment with {n} location(s); a crowd needs at least two places (L:)")
    return environment


def json_drafts(text: str, source: str) -> list[Draft]:
    """The scenarios of a JSON text as drafts, faults and all; one bare scenario is a list of one.

    Raises:
        ScriptError: if the text is no JSON or holds no scenario.
    """
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        raise ScriptError([f"{source}:{error.lineno}: not JSON ({error.msg}); mend the syntax"]) from None
    except (RecursionError, ValueError) as error:
        raise ScriptError([f"{source}: JSON out of all measure ({error}); mend it"]) from None
    listed = isinstance(document, dict) and "scenarios" in document
    scenarios = document["scenarios"] if listed else [document]
    if not (isinstance(scenarios, list) and scenarios and all(isinstance(s, dict) for s in scenarios)):
        raise ScriptError([f'{source}: no scenario in it; write {{"scenarios": [...]}}'])
    return [
        _Reader(f"{source}: " + (f"scenarios[{i}]" if listed else "")).draft(data) for i, data in enumerate(scenarios)
    ]


class _Reader:
    """Reads one scenario, leaving a stand-in where something else than expected is found."""

    def __init__(self, prefix: str) -> None:
        self.prefix = prefix
        self.found: list[Fault] = []
        self.unsure: set[Path] = set()
        self.broken: set[Path] = set()
        """Places without an object: that its parts are missing too is no news."""

    def draft(self, data: _Object) -> Draft:
        """What was read; places are spelled as paths into the JSON."""
        scenario = Scenario(
            slug=self._text(data.get("slug", ""), ("slug",)),
            theme=self._text(data.get("theme", ""), ("theme",)),
            sentence=self._text(data.get("sentence", ""), ("sentence",)),
            paraphrases=self._each(data, ("paraphrases",), self._text),
            environment=Environment(self._each(data, ("locations",), self._location)),
            groups=self._each(data, ("groups",), self._group),
        )
        found = (f for f in self.found if not any(f.path[:n] in self.broken for n in range(len(f.path))))
        return Draft(scenario, tuple(found), frozenset(self.unsure), self._locate)

    def _locate(self, path: Path) -> tuple[int, str]:
        steps = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path)
        return 0, (self.prefix + steps).replace(": .", ": ").removesuffix(": ")

    def _location(self, value: Any, path: Path) -> Location:
        data = self._object(value, path)
        category = self._word(data.get("category"), (*path, "category"), parse_category, CATEGORIES)
        return Location(
            name=self._text(data.get("name"), (*path, "name")),
            category=category or Category.ROOM,
            position_m=self._two_numbers(data.get("position"), (*path, "position"), (0.0, 0.0)),
            size_m=self._two_numbers(data.get("scale"), (*path, "scale"), (1.0, 1.0)),
        )

    def _group(self, value: Any, path: Path) -> Group:
        data = self._object(value, path)
        caption = self._text(data.get("caption", ""), (*path, "caption"))
        return Group(caption, self._each(data, (*path, "events"), self._event))

    def _event(self, value: Any, path: Path) -> Event:
        data = self._object(value, path)
        number: Any = data.get("id")
        after: Any = data.get("after")
        agents: Any = data.get("agents")
        if not _is_whole(number):
            number = self._fault((*path, "id"), "a whole number", number, stand_in=-1)
        if not (after is None or _is_whole(after)):
            after = self._fault((*path, "after"), "the number of an event, or null", after, stand_in=None)
        if not (isinstance(agents, list) and all(isinstance(agent, str) for agent in agents)):
            agents = self._fault((*path, "agents"), 'a list of letters, as ["a", "b"]', agents, stand_in=())
            self.unsure |= {path, path[:-2]}
        return Event(number, tuple(agents), self._each(data, (*path, "pairs"), self._pair), after)

    def _pair(self, value: Any, path: Path) -> tuple[Action, str]:
        data = self._object(value, path)
        action = self._word(data.get("action"), (*path, "action"), parse_action, ACTIONS)
        location = self._text(data.get("location"), (*path, "location"))
        if not location:
            self.unsure.add(path)
        return action or Action.WAIT, location

    def _each(self, data: _Object, path: Path, read: Callable[[Any, Path], _T]) -> tuple[_T, ...]:
        items = data.get(str(path[-1]), [])
        if not isinstance(items, list):
            items = self._fault(path, "a list", items, stand_in=[])
        return tuple(read(item, (*path, i)) for i, item in enumerate(items))

    def _object(self, value: Any, path: Path) -> _Object:
        if isinstance(value, dict):
            return value
        self.broken.add(path)
        return self._fault(path, "an object {...}", value, stand_in={})

    def _text(self, value: Any, path: Path) -> str:
        text = value if isinstance(value, str) else self._fault(path, "a text", value, stand_in="")
        # JSON can spell half of a surrogate pair, which no file can hold.
        return clean(text.encode("utf-8", "replace").decode("utf-8"))

    def _word(self, value: Any, path: Path, parse: Callable[[str], _T | None], known: Sequence[str]) -> _T | None:
        text = self._text(value, path)
        word = parse(text)
        if word is None and isinstance(value, str):
            self.found.append(Fault(path, f"unknown {path[-1]} {text!r}", suggest(text, known)))
        return word

    def _two_numbers(self, value: Any, path: Path, stand_in: tuple[float, float]) -> tuple[float, float]:
        if isinstance(value, list) and len(value) == 2 and all(map(_is_number, value)):
            return float(value[0]), float(value[1])
        return self._fault(path, "two numbers in metres", value, stand_in=stand_in)

    def _fault(self, path: Path, expected: str, found: Any, *, stand_in: _T) -> _T:
        shown = json.dumps(found, ensure_ascii=False)
        what = "missing" if found is None else f"found {shown if len(shown) <= 60 else shown[:57] + '...'}"
        self.found.append(Fault(path, what, f"write {expected}"))
        self.unsure |= {path, path[:-1]} if path else {path}
        return stand_in


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e300


def _scenario_object(scenario: Scenario) -> _Object:
    return {
        "slug": scenario.slug,
        "theme": scenario.theme,
        "sentence": scenario.sentence,
        "paraphrases": list(scenario.paraphrases),
        "locations": [
            {
                "name": location.name,
                "category": location.category,
                "position": list(location.position_m),
                "scale": list(location.size_m),
            }
            for location in scenario.environment.locations
        ],
        "groups": [
            {"caption": group.caption, "events": list(map(_event_object, group.events))} for group in scenario.groups
        ],
    }


def _event_object(event: Event) -> _Object:
    return {
        "id": event.id,
        "after": event.after,
        "agents": list(event.agents),
        "pairs": [{"action": action, "location": location} for action, location in event.pairs],
    }
