"""The page that describes the script must be true."""

from __future__ import annotations

import re
from pathlib import Path

from genc.scenario.exchange import parse_json
from genc.scenario.script import parse_script
from genc.words.vocabulary import ACTIONS, CATEGORIES

PAGE = (Path(__file__).parents[2] / "docs" / "script.md").read_text(encoding="utf-8")


def block(language: str) -> str:
    (only,) = re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)
    return str(only)


def test_its_script_is_sound() -> None:
    (scenario,) = parse_script(block("script"), "docs/script.md")
    assert [len(group.agents) for group in scenario.groups] == [1, 2]


def test_its_json_is_sound() -> None:
    (scenario,) = parse_json(block("json"), "docs/script.md")
    assert scenario.slug == "corner-kiosk"


def test_it_names_every_action_and_category() -> None:
    assert [word for word in (*ACTIONS, *CATEGORIES) if f"`{word}`" not in PAGE] == []
