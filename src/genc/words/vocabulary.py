"""The closed vocabulary of the paper: 13 actions and 8 location categories (Gen-C, Overview).

The position of a word in `ACTIONS` or `CATEGORIES` is its index in every array and in every model;
`vocabulary_hash` guards trained weights against a changed order.
"""

from __future__ import annotations

import hashlib
from enum import StrEnum


class Action(StrEnum):
    """What an agent does at one step."""

    WAIT = "wait"
    SIT = "sit"
    WANDER = "wander"
    QUEUE = "queue"
    ENTER_EXIT = "enter/exit"
    WAVE_AT = "wave at"
    DISCUSS = "discuss"
    MEET = "meet"
    OBJECT_INTERACT = "object interact"
    TALK_ON_PHONE = "talk on phone"
    READ = "read"
    LOOK_AT = "look at"
    CARRY = "carry"


class Category(StrEnum):
    """What kind of place a location is."""

    BUILDING = "building"
    ROOM = "room"
    ENTRANCE = "entrance"
    EXHIBIT = "exhibit"
    FURNITURE = "furniture"
    OUTDOOR_AREA = "outdoor area"
    ITEM = "item"
    SERVICE_AREA = "service area"


ACTIONS: tuple[Action, ...] = tuple(Action)
CATEGORIES: tuple[Category, ...] = tuple(Category)
ACTION_INDEX: dict[Action, int] = {action: i for i, action in enumerate(ACTIONS)}
CATEGORY_INDEX: dict[Category, int] = {category: i for i, category in enumerate(CATEGORIES)}

MAX_AGENTS = 15
"""Most agents in one group (Gen-C, Data Preprocessing)."""
MAX_NODES = 100
"""Most nodes in one group."""
MAX_EVENTS = 30
"""Most events in one group."""

CATEGORY_ALIASES: dict[str, Category] = {"service station": Category.SERVICE_AREA}
"""Other names in use: the paper's tables say "service station" where its vocabulary says "service area"."""


def parse_action(text: str) -> Action | None:
    """The action of that name, or None."""
    return Action(text) if text in Action._value2member_map_ else None


def parse_category(text: str) -> Category | None:
    """The category of that name or alias, or None."""
    if text in CATEGORY_ALIASES:
        return CATEGORY_ALIASES[text]
    return Category(text) if text in Category._value2member_map_ else None


def vocabulary_hash() -> str:
    """Sixteen hex digits that change whenever an index would mean another word."""
    text = "|".join([*ACTIONS, "#", *CATEGORIES, f"#{MAX_AGENTS},{MAX_NODES},{MAX_EVENTS}"])
    return hashlib.sha256(text.encode()).hexdigest()[:16]
