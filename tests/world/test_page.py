"""The page as a file: what stands in it. How it behaves in a browser is tested in tests/player."""

from __future__ import annotations

import base64
import hashlib
import re
from dataclasses import replace
from importlib.resources import files

import pytest

from genc.errors import OutputError, WorldFileError
from genc.world import page as page_room
from genc.world.page import write_page
from genc.world.world_file import write_world


@pytest.fixture(scope="module")
def world_file(short_world, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "world.genc"
    write_world(short_world, path)
    return path


@pytest.fixture(scope="module")
def page(world_file):
    path = world_file.with_name("world.html")
    write_page(world_file, path)
    return path.read_text(encoding="utf-8")


def test_the_page_holds_the_world_file_unchanged(page, world_file):
    (held,) = re.findall(r'<script type="application/octet-stream" id="world">([^<]*)</script>', page)
    assert base64.b64decode(held, validate=True) == world_file.read_bytes()


def test_its_title_is_the_sentence(page, short_world):
    assert f"<title>{short_world.provenance['text']}</title>" in page


def test_equal_worlds_give_equal_pages(page, world_file, tmp_path):
    write_page(world_file, tmp_path / "again.html")
    assert (tmp_path / "again.html").read_text(encoding="utf-8") == page


@pytest.mark.parametrize(
    ("text", "title"),
    [
        ("</title><script>alert(1)</script>", "&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt;"),
        ('two\nlines & "quotes"', "two lines &amp; &quot;quotes&quot;"),
        (None, "A populated world"),
        ("  ", "A populated world"),
        ("\\1 \\g<0>", "\\1 \\g&lt;0&gt;"),
    ],
)
def test_a_sentence_is_text_and_never_markup(short_world, tmp_path, text, title):
    write_world(replace(short_world, provenance={"text": text}), tmp_path / "w.genc")
    write_page(tmp_path / "w.genc", tmp_path / "w.html")
    written = (tmp_path / "w.html").read_text(encoding="utf-8")
    assert re.findall("<title>(.*?)</title>", written, re.S) == [title]
    assert written.count("<script") == 2


def test_the_page_asks_for_nothing_from_outside_and_runs_its_own_script_only(page):
    (policy,) = re.findall(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page)
    assert policy.startswith("default-src 'none'; script-src 'sha256-")
    assert "unsafe" not in policy
    assert "http" not in policy
    (script,) = re.findall(r'<script type="module"[^>]*>(.*?)</script>', page, re.S)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"'sha256-{digest}'" in policy
    assert not re.findall(r'<(?:script|link|img)[^>]*(?:src|href)="(?!data:)', page)


def test_the_licences_of_what_it_ships_stand_on_top(page):
    head = page[:4000]
    assert "three.js authors" in head
    assert "Arjun Barrett" in head
    assert head.count("Permission is hereby granted") == 2


def test_the_player_is_small():
    assert len(files("genc.world").joinpath("player", "index.html").read_bytes()) < 1_000_000


def test_a_world_that_cannot_be_read_is_refused(tmp_path):
    with pytest.raises(WorldFileError, match=r"none\.genc: the world file cannot be read"):
        write_page(tmp_path / "none.genc", tmp_path / "w.html")
    (tmp_path / "odd.genc").write_bytes(b"PK\x03\x04 no archive")
    with pytest.raises(WorldFileError, match="not a sound world file"):
        write_page(tmp_path / "odd.genc", tmp_path / "w.html")
    assert not (tmp_path / "w.html").exists()


def test_a_missing_or_damaged_player_is_named(world_file, tmp_path, monkeypatch):
    monkeypatch.setattr(page_room, "files", lambda _: tmp_path)
    with pytest.raises(OutputError, match="the player is missing from this installation"):
        write_page(world_file, tmp_path / "w.html")
    (tmp_path / "player").mkdir()
    (tmp_path / "player" / "index.html").write_text("<title>other</title>")
    with pytest.raises(OutputError, match="the player of this installation is damaged"):
        write_page(world_file, tmp_path / "w.html")


def test_a_place_where_nothing_can_be_written_is_named(world_file, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        write_page(world_file, tmp_path / "file" / "w.html")
