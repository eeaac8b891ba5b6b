"""The files of the field are opened and analysed by PedPy."""

from __future__ import annotations

import json
import os
import sqlite3
import subprocess
import sys
from contextlib import closing

import h5py
import numpy as np
import odd_worlds
import pedpy
import pytest
import shapely

from genc.world.activity_table import COLUMNS
from genc.world.export import export_world
from genc.world.export.tables import activities
from genc.world.world_file import write_world

STATIONARY = ("wait", "sit", "discuss", "meet", "object interact", "read", "look at", "wave at")


@pytest.fixture(scope="module")
def folder(world, tmp_path_factory):
    folder = tmp_path_factory.mktemp("pedpy")
    export_world(world, folder, ["jupedsim", "hdf5"])
    return folder


@pytest.fixture(scope="module", params=["sqlite", "hdf5"])
def loaded(request, folder):
    """The trajectories and the walkable area, as PedPy reads them."""
    if request.param == "sqlite":
        file = folder / "trajectories.sqlite"
        trajectories = pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=file)
        return trajectories, pedpy.load_walkable_area_from_jupedsim_sqlite(trajectory_file=file)
    file = folder / "trajectories.h5"
    trajectories = pedpy.load_trajectory_from_ped_data_archive_hdf5(trajectory_file=file)
    return trajectories, pedpy.load_walkable_area_from_ped_data_archive_hdf5(trajectory_file=file)


def test_trajectories_are_the_frames_of_who_is_there(world, loaded):
    trajectories, _ = loaded
    motion, data = world.motion, trajectories.data
    assert trajectories.frame_rate == pytest.approx(1 / motion.dt_s)
    assert len(data) == motion.present.sum()
    frame, agent = data["frame"].to_numpy(), data["id"].to_numpy()
    assert motion.present[frame, agent].all()
    assert np.abs(data[["x", "y"]].to_numpy() - motion.positions_m[frame, agent]).max() < 6e-4


def test_the_ground_is_one_polygon_and_everybody_is_on_it(world, loaded):
    trajectories, ground = loaded
    polygon = ground.polygon
    assert polygon.geom_type == "Polygon"
    assert polygon.is_valid
    points = trajectories.data[["x", "y"]].to_numpy()
    off_m = shapely.distance(polygon, shapely.points(points))
    assert off_m.max() < 1e-3
    assert pedpy.is_trajectory_valid(traj_data=trajectories, walkable_area=pedpy.WalkableArea(polygon.buffer(1e-3)))


def own_speeds(world) -> dict[tuple[int, int], float]:
    """The speed of each person at each frame, over the frame before and the one after, in m/s."""
    motion = world.motion
    there = motion.present[2:] & motion.present[1:-1] & motion.present[:-2]
    step_m = motion.positions_m[2:].astype(float) - motion.positions_m[:-2]
    speeds_mps = np.linalg.norm(step_m, axis=2) / (2 * motion.dt_s)
    return {(agent, frame + 1): speeds_mps[frame, agent] for frame, agent in np.argwhere(there).tolist()}


def test_speeds_are_those_of_the_world(world, loaded):
    trajectories, _ = loaded
    table = pedpy.compute_individual_speed(traj_data=trajectories, frame_step=1)
    found = dict(zip(zip(table["id"], table["frame"], strict=True), table["speed"], strict=True))
    own = own_speeds(world)
    assert len(found) >= len(own)
    theirs = np.array([found.get(key, np.nan) for key in own])
    assert np.abs(theirs - list(own.values())).max() < 0.01
    assert theirs.mean() == pytest.approx(np.mean(list(own.values())), rel=1e-3)


def test_density_and_who_is_where_can_be_analysed(world, loaded):
    trajectories, ground = loaded
    place = max(world.plan.environment.locations, key=lambda place: place.size_m[0] * place.size_m[1])
    (x, y), (width, depth) = place.position_m, place.size_m
    area = pedpy.MeasurementArea(shapely.box(x - width / 2, y - depth / 2, x + width / 2, y + depth / 2))
    density = pedpy.compute_classic_density(traj_data=trajectories, measurement_area=area)
    inside = np.abs(world.motion.positions_m - np.array(place.position_m)) < np.array(place.size_m) / 2
    expected = (inside.all(axis=2) & world.motion.present).sum(axis=1)[density.index.to_numpy()] / (width * depth)
    assert np.abs(density["density"].to_numpy() - expected).mean() < 0.01 * expected.mean() + 1e-9
    few = pedpy.TrajectoryData(trajectories.data[trajectories.data["frame"] < 20], trajectories.frame_rate)
    cells = pedpy.compute_individual_voronoi_polygons(traj_data=few, walkable_area=ground)
    assert len(cells) > 0


# The activity table, joined to the trajectories.


def test_at_every_stationary_beginning_the_person_is_at_the_place(world, folder):
    query = """
        SELECT a.agent, a.action, a.x_m, a.y_m, t.pos_x, t.pos_y
        FROM agent_action a JOIN metadata m ON m.key = 'fps'
        JOIN trajectory_data t ON t.id = a.agent AND t.frame = CAST(a.start_s * m.value + 0.999 AS INTEGER)
        WHERE a.start_s IS NOT NULL
    """
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        rows = [row for row in base.execute(query) if row[1] in STATIONARY]
    assert len(rows) > 100
    for agent, action, x_m, y_m, pos_x, pos_y in rows:
        assert np.hypot(x_m - pos_x, y_m - pos_y) < 0.3, (agent, action)


def test_partners_stand_together_while_they_talk(world, folder):
    query = """
        SELECT a.agent, b.agent, t.pos_x - u.pos_x, t.pos_y - u.pos_y
        FROM agent_action a JOIN agent_action b ON a.occasion = b.occasion AND a.agent < b.agent
        JOIN metadata m ON m.key = 'fps'
        JOIN trajectory_data t ON t.id = a.agent AND t.frame = CAST((a.start_s + 1) * m.value AS INTEGER)
        JOIN trajectory_data u ON u.id = b.agent AND u.frame = t.frame
        WHERE a.action IN ('discuss', 'meet') AND a.start_s = b.start_s AND a.end_s > a.start_s + 1
    """
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        rows = base.execute(query).fetchall()
    assert len(rows) > 20
    apart_m = np.array([np.hypot(dx, dy) for _, _, dx, dy in rows])
    assert np.median(apart_m) < 2.0
    assert apart_m.max() < 6.0  # seats round a large table, fifteen people in a circle


def test_the_tables_hold_the_whole_activity_table(world, folder):
    own = activities(world)
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        found = list(zip(*base.execute("SELECT * FROM agent_action"), strict=True))
        names = [column[1] for column in base.execute("PRAGMA table_info(agent_action)")]
        groups = base.execute("SELECT agent, group_number, caption FROM agent_group ORDER BY agent").fetchall()
    assert tuple(names) == COLUMNS
    assert dict(zip(names, map(list, found), strict=True)) == own
    people, captions = world.plan.people, world.plan.captions
    assert groups == [(agent, person.group, captions[person.group]) for agent, person in enumerate(people)]
    with h5py.File(folder / "trajectories.h5") as archive:
        table = archive["actions"][:]
        people_table = archive["people"][:]
    assert table.dtype.names == COLUMNS
    for name, cells in own.items():
        for cell, value in zip(cells, table[name], strict=True):
            if isinstance(cell, float):
                assert cell == value
            elif cell is not None:
                assert cell == (value.decode() if isinstance(value, bytes) else value)
            else:
                assert value == b"" or np.isnan(value)
    assert people_table["group"].tolist() == [person.group for person in people]


# What JuPedSim itself asks for.


def test_the_file_is_what_jupedsim_plays(world, folder):
    recording = pytest.importorskip("jupedsim.recording").Recording(str(folder / "trajectories.sqlite"))
    motion = world.motion
    assert recording.num_frames == len(motion.present)
    assert recording.fps == pytest.approx(1 / motion.dt_s)
    bounds = recording.bounds()
    assert recording.geometry().bounds == pytest.approx((bounds.xmin, bounds.ymin, bounds.xmax, bounds.ymax))
    assert recording.geometry_id_for_frame(0) == recording.geometry_id_for_frame(len(motion.present) - 1)
    middle = len(motion.present) // 2
    agents = recording.frame(middle).agents
    assert [agent.id for agent in agents] == np.flatnonzero(motion.present[middle]).tolist()
    for agent in agents:
        heading_rad = motion.headings_rad[middle, agent.id]
        assert agent.orientation == pytest.approx((np.cos(heading_rad), np.sin(heading_rad)), abs=1e-4)
    recording.db.close()


def test_the_rows_are_in_the_order_of_each_tool(world, folder):
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        frame, agent = np.array(base.execute("SELECT frame, id FROM trajectory_data ORDER BY rowid").fetchall()).T
        explained = " ".join(map(str, base.execute("EXPLAIN QUERY PLAN SELECT * FROM trajectory_data WHERE frame = 3")))
    assert np.array_equal(np.lexsort((agent, frame)), np.arange(len(frame)))
    assert "frame_id_idx" in explained
    with h5py.File(folder / "trajectories.h5") as archive:
        rows = archive["trajectory"][:]
    assert np.array_equal(np.lexsort((rows["frame"], rows["id"])), np.arange(len(rows)))
    heading_rad = world.motion.headings_rad[rows["frame"], rows["id"]]
    assert np.abs(rows["ox"] - np.cos(heading_rad)).max() < 1e-4
    assert np.abs(rows["oy"] - np.sin(heading_rad)).max() < 1e-4
    assert not rows["z"].any()


def test_an_absence_is_a_gap_in_the_frames_of_one_id(tmp_path):
    world = odd_worlds.rare()
    (file,) = export_world(world, tmp_path, ["jupedsim"])["jupedsim"]
    trajectories = pedpy.load_trajectory_from_jupedsim_sqlite(trajectory_file=file).data
    frames = trajectories[trajectories["id"] == 3]["frame"].to_numpy()
    assert np.array_equal(frames, np.flatnonzero(world.motion.present[:, 3]))
    assert set(trajectories["id"]) == {0, 1, 3, 4}


def test_another_process_writes_the_same_bytes(world, folder, tmp_path):
    write_world(world, tmp_path / "world.genc")
    program = (
        "from genc.world.export import export_world; from genc.world.world_file import read_world;"
        f"export_world(read_world({str(tmp_path / 'world.genc')!r}), {str(tmp_path)!r}, ['jupedsim', 'hdf5'])"
    )
    for salt in ("1", "2"):
        subprocess.run([sys.executable, "-c", program], check=True, env={**os.environ, "PYTHONHASHSEED": salt})
        for name in ("trajectories.sqlite", "trajectories.h5"):
            (tmp_path / name).rename(tmp_path / f"{name}.{salt}")
    for name in ("trajectories.sqlite", "trajectories.h5"):
        assert (tmp_path / f"{name}.1").read_bytes() == (tmp_path / f"{name}.2").read_bytes()


def test_provenance_is_in_both(world, folder):
    with closing(sqlite3.connect(folder / "trajectories.sqlite")) as base:
        (said,) = base.execute("SELECT value FROM metadata WHERE key = 'genc_provenance'").fetchone()
    with h5py.File(folder / "trajectories.h5") as archive:
        assert said == archive.attrs["genc_provenance"]
    assert json.loads(said) == dict(world.provenance)
