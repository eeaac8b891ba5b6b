from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from genc.motion.motion import Motion
from genc.world.frames import Grid, grid_of, pack, unpack

shapes = st.tuples(st.integers(0, 6), st.integers(0, 4))


def motion_of(positions_m: np.ndarray, headings_rad: np.ndarray) -> Motion:
    return Motion(0.2, positions_m, headings_rad, np.ones(headings_rad.shape, dtype=bool), ())


@st.composite
def motions(draw, reach_m: float = 250.0) -> Motion:
    shape = draw(shapes)
    metres = st.floats(-reach_m, reach_m, width=32)
    radians = st.floats(-4.0, 4.0, width=32)
    return motion_of(
        draw(hnp.arrays(np.float32, (*shape, 2), elements=metres)),
        draw(hnp.arrays(np.float32, shape, elements=radians)),
    )


def round_trip(motion: Motion) -> tuple[np.ndarray, np.ndarray, Grid]:
    grid = grid_of(motion)
    return *unpack(*pack(motion, grid), grid), grid


@given(motions())
def test_positions_come_back_to_half_a_centimetre(motion):
    positions_m, _, grid = round_trip(motion)
    assert grid.quantum_m == 0.01
    assert positions_m.dtype == np.float32
    assert np.abs(positions_m - motion.positions_m).max(initial=0.0) <= 0.005 + 1e-4


@given(motions(reach_m=50_000.0))
def test_a_wide_world_has_a_coarser_grid_and_still_fits(motion):
    positions_m, _, grid = round_trip(motion)
    assert np.abs(positions_m - motion.positions_m).max(initial=0.0) <= 0.51 * grid.quantum_m + 0.01


@given(motions())
def test_headings_come_back_as_the_same_directions(motion):
    _, headings_rad, _ = round_trip(motion)
    assert np.all((headings_rad >= -np.pi - 1e-6) & (headings_rad <= np.pi + 1e-6))
    apart_rad = np.abs(np.angle(np.exp(1j * (headings_rad.astype(float) - motion.headings_rad))))
    assert apart_rad.max(initial=0.0) <= 2 * np.pi / 65_536


@given(motions())
def test_what_has_been_packed_once_is_packed_the_same_again(motion):
    positions_m, headings_rad, grid = round_trip(motion)
    again = motion_of(positions_m, headings_rad)
    assert grid_of(again) == grid
    assert all(np.array_equal(a, b) for a, b in zip(pack(motion, grid), pack(again, grid), strict=True))


def test_who_stands_costs_nothing():
    positions_m = np.full((50, 3, 2), 12.34, dtype=np.float32)
    motion = motion_of(positions_m, np.ones((50, 3), dtype=np.float32))
    positions, headings = pack(motion, grid_of(motion))
    assert not positions[1:].any()
    assert not headings[1:].any()
