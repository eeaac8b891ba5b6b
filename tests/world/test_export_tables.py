from __future__ import annotations

import csv
import io

import numpy as np
import odd_worlds
import pyarrow.parquet as pq
import pytest

from genc.motion.motion import Motion
from genc.world.activity_table import COLUMNS, write_table
from genc.world.export import export_world
from genc.world.export.actions import ACTION_NAMES, PHASES, doings
from genc.world.export.eth_ucy import resampled
from genc.world.export.tables import INTEGER_COLUMNS, TEXT_COLUMNS, activities


@pytest.fixture(scope="module", params=["authored", "rare"])
def exported(request, short_world, tmp_path_factory):
    world = short_world if request.param == "authored" else odd_worlds.rare()
    folder = tmp_path_factory.mktemp("tables")
    export_world(world, folder, ["csv", "parquet", "eth-ucy"])
    return world, folder


def read_csv(path) -> dict[str, list[str]]:
    rows = list(csv.DictReader(io.StringIO(path.read_text(encoding="utf-8"), newline="")))
    return {name: [row[name] for row in rows] for name in rows[0]}


def test_trajectories_are_the_frames_of_who_is_there(exported):
    world, folder = exported
    motion, done = world.motion, doings(world)
    table = pq.read_table(folder / "trajectories.parquet").to_pydict()
    agent, frame = np.array(table["agent"]), np.array(table["frame"])
    assert len(agent) == motion.present.sum()
    assert motion.present[frame, agent].all()
    assert np.array_equal(np.lexsort((frame, agent)), np.arange(len(agent)))
    assert np.allclose(table["t_s"], frame * motion.dt_s)
    assert np.allclose(np.column_stack([table["x_m"], table["y_m"]]), motion.positions_m[frame, agent], atol=6e-4)
    assert np.allclose(table["heading_rad"], motion.headings_rad[frame, agent], atol=6e-5)
    assert table["action"] == [ACTION_NAMES[code] for code in done.action[frame, agent]]
    assert table["phase"] == [PHASES[code] for code in done.phase[frame, agent]]


def test_csv_and_parquet_say_the_same(exported):
    _, folder = exported
    for name in ("trajectories", "activities", "people"):
        text, typed = read_csv(folder / f"{name}.csv"), pq.read_table(folder / f"{name}.parquet").to_pydict()
        assert list(text) == list(typed)
        for column, cells in typed.items():
            assert [_spelled(cell) for cell in cells] == _read(text[column], cells), column


def _spelled(cell: object) -> object:
    return " ".join(map(str, cell)) if isinstance(cell, list) else cell


def _read(cells: list[str], like: list[object]) -> list[object]:
    """A column of CSV as what it is in Parquet."""
    (kind,) = {type(value) for value in like} - {type(None)}
    if kind is list:
        return list(cells)
    read = (lambda cell: bool(int(cell))) if kind is bool else kind
    return [None if cell == "" and None in like else read(cell) for cell in cells]


def test_words_are_dictionary_encoded(exported):
    _, folder = exported
    schema = pq.read_schema(folder / "trajectories.parquet")
    assert str(schema.field("action").type).startswith("dictionary<values=string")
    activities, people = (pq.read_schema(folder / f"{name}.parquet") for name in ("activities", "people"))
    assert str(activities.field("partners").type).startswith("list<")
    assert str(activities.field("implied").type) == str(people.field("leaves").type) == "bool"
    assert str(activities.field("agent").type) == str(people.field("group").type) == "int32"


def test_activities_are_the_table_of_the_world_file(exported):
    world, folder = exported
    assert (folder / "activities.csv").read_text() == write_table(world.plan, world.motion.executed)


def test_every_column_of_the_activity_table_has_a_kind(short_world):
    assert {*INTEGER_COLUMNS, *TEXT_COLUMNS} <= set(COLUMNS)
    columns = activities(short_world)
    assert tuple(columns) == COLUMNS
    for name, cells in columns.items():
        kind = int if name in INTEGER_COLUMNS else str if name in TEXT_COLUMNS else float
        assert all(cell is None or isinstance(cell, kind) for cell in cells), name


# ETH/UCY.


def test_eth_text_loads_as_four_columns(exported):
    world, folder = exported
    motion = world.motion
    rows = np.loadtxt(folder / "eth_ucy.txt", delimiter="\t", ndmin=2)
    assert rows.shape[1] == 4
    assert set(np.unique(rows[:, 0]) % 10) == {0}
    assert np.array_equal(np.lexsort((rows[:, 1], rows[:, 0])), np.arange(len(rows)))
    for frame, agent, x_m, y_m in rows[:: max(1, len(rows) // 400)]:
        at = frame / 25 / motion.dt_s
        before, after = int(np.floor(at + 1e-6)), int(np.ceil(at - 1e-6))
        assert motion.present[before, int(agent)] and motion.present[after, int(agent)]  # noqa: PT018
        ends_m = motion.positions_m[[before, after], int(agent)]
        assert np.allclose([x_m, y_m], ends_m[0] + (at - before) * (ends_m[1] - ends_m[0]), atol=6e-4)


def test_groups_are_lines_of_people_who_belong_together(exported):
    world, folder = exported
    seen = set(np.loadtxt(folder / "eth_ucy.txt", ndmin=2)[:, 1].astype(int).tolist())
    lines = [list(map(int, line.split())) for line in (folder / "groups.txt").read_text().splitlines()]
    assert all(len(line) > 1 and set(line) <= seen for line in lines)
    for line in lines:
        assert len({world.plan.people[agent].group for agent in line}) == 1
    together = {agent for line in lines for agent in line}
    alone = [world.plan.people[agent].group for agent in seen - together]
    assert len(alone) == len(set(alone))


@pytest.mark.parametrize("dt_s", [0.04, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5, 1.0])
def test_rows_are_0_4_seconds_apart_whatever_the_frames_are(dt_s):
    n_frames = int(6 / dt_s) + 1
    t_s = np.arange(n_frames) * dt_s
    positions_m = np.zeros((n_frames, 1, 2), np.float32)
    positions_m[:, 0, 0] = 1.5 * t_s
    present = np.ones((n_frames, 1), bool)
    motion = Motion(dt_s, positions_m, np.zeros((n_frames, 1), np.float32), present, ())
    found_m, there = resampled(motion, 0.4)
    assert there.all()
    assert len(found_m) == int(t_s[-1] / 0.4 + 1e-6) + 1
    assert np.allclose(found_m[:, 0, 0], 0.6 * np.arange(len(found_m)), atol=6e-4)
