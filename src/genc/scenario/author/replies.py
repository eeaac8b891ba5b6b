"""What replies have to look like: the models whose JSON Schemas are sent along."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field

from genc.words.vocabulary import Action, Category

Metres = Annotated[list[float], Field(min_length=2, max_length=2)]


class _Strict(BaseModel):
    """Servers that hold replies to a schema want every field required and no other allowed."""

    model_config = ConfigDict(extra="forbid")


class Sentences(_Strict):
    """The reply with seeds or other wordings."""

    sentences: list[str]


class Place(_Strict):
    """A location."""

    name: str
    category: Category
    position: Metres
    scale: Metres


class Layout(_Strict):
    """The reply to Q1."""

    locations: list[Place]


class Pair(_Strict):
    """One thing done at one location."""

    action: Action
    location: str


class Happening(_Strict):
    """An event."""

    id: int
    after: int | None
    agents: list[str]
    pairs: list[Pair]


class Party(_Strict):
    """A group."""

    caption: str
    events: list[Happening]


class Happenings(_Strict):
    """The reply to Q2."""

    groups: list[Party]


def schema_of(reply: type[BaseModel], location_names: Sequence[str] = ()) -> dict[str, Any]:
    """The JSON Schema of a reply; with names of locations, no other location can be named."""
    schema = reply.model_json_schema()
    if location_names:
        schema["$defs"]["Pair"]["properties"]["location"]["enum"] = list(location_names)
    return schema
