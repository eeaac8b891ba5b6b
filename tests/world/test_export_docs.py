"""What the documentation of the exports shows, runs."""

from __future__ import annotations

import re
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from genc.world.export import ALL, export_world

PAGE = (Path(__file__).parents[2] / "docs" / "formats.md").read_text(encoding="utf-8").split("## Exports")[1]


@pytest.fixture(scope="module")
def folder(short_world, tmp_path_factory):
    folder = tmp_path_factory.mktemp("docs")
    export_world(short_world, folder, [ALL])
    return folder


@pytest.mark.filterwarnings("ignore::ResourceWarning")
@pytest.mark.parametrize("snippet", re.findall(r"```python\n(.*?)```", PAGE, re.S), ids=lambda s: s.split()[-1][:20])
def test_every_snippet_runs(snippet, folder, monkeypatch):
    monkeypatch.chdir(folder)
    exec(compile(snippet, "formats.md", "exec"), {})


def test_the_query_finds_people_where_they_begin(folder, short_world):
    (query,) = re.findall(r"```sql\n(.*?)```", PAGE, re.S)
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        rows = base.execute(query).fetchall()
    begun = sum(row.start_s == row.start_s for row in short_world.motion.executed)
    assert 0.8 * begun < len(rows) <= begun


def test_every_file_is_in_the_table_of_files(folder):
    for file in folder.iterdir():
        assert f"`{file.name}`" in PAGE, file.name
