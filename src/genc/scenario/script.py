"""The scenario script: parser and writer (docs/script.md describes the format)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path as FilePath

from genc.errors import ScriptError
from genc.scenario.draft import Draft, clean, read_text, settle
from genc.scenario.faults import Fault, Path, suggest
from genc.scenario.scenario import Environment, Event, Group, Location, Scenario
from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category, parse_action, parse_category

_EVENT = re.compile(r"([0-9]{1,9}) +(-|> ?[0-9]{1,9}) +([A-Za-z]+) ?: ?(.*)", re.ASCII)
_EVENT_LIKE = "'3 >2 ab: action@location, action@location' ('-' in place of '>2' for the start)"
_NUMBER = r"[^,x×X ]+"
_LOCATION = re.compile(rf"([^|]*)\|([^|]*)\| *({_NUMBER}) *, *({_NUMBER}) *\| *({_NUMBER}) *[x×X] *({_NUMBER})")


def parse_script(text: str, source: str) -> tuple[Scenario, ...]:
    """The scenarios of a script; `source` names it in messages.

    Raises:
        ScriptError: with every problem of the text: file, line, what is wrong, how to mend it.
    """
    return settle(script_drafts(text, source))


def read_script(path: FilePath | str) -> tuple[Scenario, ...]:
    """The scenarios of a script file.

    Raises:
        ScriptError: if the file cannot be read, or with every problem of its text.
    """
    return parse_script(read_text(path), str(path))


def write_script(scenarios: Iterable[Scenario]) -> str:
    """The script of these scenarios: `parse_script` gives them back, equal in every part."""
    theme = ""
    lines: list[str] = []
    for scenario in scenarios:
        if scenario.theme != theme:
            lines += [f"T: {scenario.theme}".rstrip(), ""]
            theme = scenario.theme
        lines += [*_scenario_lines(scenario), ""]
    return "\n".join(lines)


def script_drafts(text: str, source: str) -> list[Draft]:
    """The scenarios of a script as drafts, faults and all.

    Raises:
        ScriptError: if there is no scenario in the text.
    """
    pens: list[_Pen] = []
    theme = ""
    for number, raw in enumerate(text.split("\n"), start=1):
        line = clean(raw)
        if not line or line.startswith("#"):
            continue
        if line.startswith("T:"):
            theme = line[2:].strip()
            if pens and pens[-1].is_blank:
                pens[-1].theme = theme
        elif line.startswith("==="):
            pens.append(_Pen(line[3:].strip(), theme, number))
        else:
            if not pens:
                pens.append(_Pen("", theme, number))
            pens[-1].take(line, number)
    # A file of another kind altogether deserves one line, not one for each of its own.
    if not pens or (len(pens) == 1 and pens[0].is_blank and not pens[0].slug):
        raise ScriptError([f"{source}: no scenario in it; begin one with a line '=== short-name'"])
    return [pen.draft(source) for pen in pens]


class _Pen:
    """Takes the lines of one scenario."""

    def __init__(self, slug: str, theme: str, line: int) -> None:
        self.slug, self.theme, self.sentence = slug, theme, ""
        self.paraphrases: list[str] = []
        self.locations: list[Location] = []
        self.groups: list[tuple[str, list[Event]]] = []
        self.line_of: dict[Path, int] = {(): line}
        self.found: list[Fault] = []
        self.unsure: set[Path] = set()

    @property
    def is_blank(self) -> bool:
        """True as long as no line below the header was understood."""
        return not (self.sentence or self.paraphrases or self.locations or self.groups)

    def take(self, line: str, number: int) -> None:
        """Reads one line."""
        mark, rest = line[:2], line[2:].strip()
        if mark == "S:":
            self._take_sentence(rest, number)
        elif mark == "P:":
            self.line_of["paraphrases", len(self.paraphrases)] = number
            self.paraphrases.append(rest)
        elif mark == "L:":
            self._take_location(rest, number)
        elif mark == "G:":
            self.line_of["groups", len(self.groups)] = number
            self.groups.append((rest, []))
        elif line[0].isdecimal():
            self._take_event(line, number)
        else:
            how = f"a line begins with T:, ===, S:, P:, L:, G: or is an event, {_EVENT_LIKE}"
            self._fault_at_line(number, f"not understood: {_short(line)}", how)

    def draft(self, source: str) -> Draft:
        """What was read, with the line of everything."""
        groups = tuple(Group(caption, tuple(events)) for caption, events in self.groups)
        environment = Environment(tuple(self.locations))
        scenario = Scenario(self.slug, self.theme, self.sentence, tuple(self.paraphrases), environment, groups)

        def locate(path: Path) -> tuple[int, str]:
            while path not in self.line_of:
                path = path[:-1]
            return self.line_of[path], f"{source}:{self.line_of[path]}"

        return Draft(scenario, tuple(self.found), frozenset(self.unsure), locate)

    def _fault(self, path: Path, what: str, how: str) -> None:
        self.found.append(Fault(path, what, how))

    def _fault_at_line(self, number: int, what: str, how: str) -> None:
        path = ("lines", number)
        self.line_of[path] = number
        self._fault(path, what, how)

    def _take_sentence(self, text: str, number: int) -> None:
        if self.sentence:
            self._fault_at_line(number, "a second sentence (S:)", "keep one; other wordings are P: lines")
        else:
            self.line_of["sentence",] = number
            self.sentence = text

    def _take_location(self, text: str, number: int) -> None:
        path = ("locations", len(self.locations))
        self.line_of[path] = number
        match = _LOCATION.fullmatch(text)
        numbers = _floats(match.groups()[2:]) if match else None
        if match is None or numbers is None:
            how = "write 'L: name | category | x,y | WxD', in metres"
            self._fault(path, f"location not understood: {_short(text)}", how)
            self.locations.append(_stand_in(text.partition("|")[0].strip()))
            return
        name, word = match[1].strip(), match[2].strip()
        category = parse_category(word)
        if category is None:
            self._fault(path, f"unknown category {word!r}", suggest(word, CATEGORIES))
        x, y, width, depth = numbers
        self.locations.append(Location(name, category or Category.ROOM, (x, y), (width, depth)))

    def _take_event(self, line: str, number: int) -> None:
        if not self.groups:
            self._fault_at_line(number, "an event before any group", "begin the group with 'G: caption'")
            self.line_of["groups", 0] = number
            self.groups.append(("?", []))
        events = self.groups[-1][1]
        group_path: Path = ("groups", len(self.groups) - 1)
        path = (*group_path, "events", len(events))
        self.line_of[path] = number
        match = _EVENT.fullmatch(line)
        if match is None:
            self._fault(path, f"event not understood: {_short(line)}", f"write it as {_EVENT_LIKE}")
            # Its number still counts, so that events that wait for it are not blamed.
            head = re.match("[0-9]{1,9}", line)
            events.append(Event(int(head[0]) if head else -1, (), ()))
            self.unsure |= {path, group_path}
            return
        after = None if match[2] == "-" else int(match[2][1:])
        pairs = tuple(self._pair(path, i, pair) for i, pair in enumerate(match[4].split(",")))
        events.append(Event(int(match[1]), tuple(match[3]), pairs, after))

    def _pair(self, event_path: Path, i: int, text: str) -> tuple[Action, str]:
        path = (*event_path, "pairs", i)
        word, at, location = (part.strip() for part in text.partition("@"))
        if not at or not location:
            self._fault(path, f"{text.strip()!r} has no place", "write action@location, with commas between")
            self.unsure.add(path)
        action = parse_action(word)
        if at and action is None:
            self._fault(path, f"unknown action {word!r}", suggest(word, ACTIONS))
        return action or Action.WAIT, location


def _stand_in(name: str) -> Location:
    return Location(name or "?", Category.ROOM, (0.0, 0.0), (1.0, 1.0))


def _floats(texts: Iterable[str]) -> tuple[float, ...] | None:
    try:
        return tuple(map(float, texts))
    except ValueError:
        return None


def _short(text: str) -> str:
    return repr(text if len(text) <= 60 else text[:57] + "...")


def _scenario_lines(scenario: Scenario) -> Iterator[str]:
    yield f"=== {scenario.slug}"
    yield f"S: {scenario.sentence}"
    yield from (f"P: {paraphrase}" for paraphrase in scenario.paraphrases)
    for location in scenario.environment.locations:
        x, y, width, depth = map(_metres, (*location.position_m, *location.size_m))
        yield f"L: {location.name} | {location.category} | {x},{y} | {width}x{depth}"
    for group in scenario.groups:
        yield f"G: {group.caption}"
        yield from map(_event_line, group.events)


def _event_line(event: Event) -> str:
    trigger = "-" if event.after is None else f">{event.after}"
    pairs = ", ".join(f"{action}@{location}" for action, location in event.pairs)
    return f"{event.id} {trigger} {''.join(event.agents)}: {pairs}"


def _metres(value: float) -> str:
    return repr(float(value)).removesuffix(".0")
