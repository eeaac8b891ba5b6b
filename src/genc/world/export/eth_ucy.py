"""ETH/UCY text: the four columns that trajectory prediction reads, and who belongs together."""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from genc.files import write_text, written_beside
from genc.motion.motion import Motion
from genc.world.export.tables import rows_of
from genc.world.world import World

INTERVAL_S = 0.4
FRAMES_A_ROW = 10
"""Frames are numbered as of a film with 25 a second."""


def write(world: World, folder: Path) -> tuple[Path, ...]:
    """Writes `eth_ucy.txt` (frame, person, x, y) and `groups.txt` (a line for each group of two or more)."""
    files = folder / "eth_ucy.txt", folder / "groups.txt"
    positions_m, present = resampled(world.motion, INTERVAL_S)
    row, agent = np.nonzero(present)
    x_m, y_m = positions_m[row, agent].T
    with written_beside(files[0]) as part, part.open("w", encoding="ascii", newline="") as stream:
        columns = (row * FRAMES_A_ROW, agent, x_m, y_m)
        stream.writelines(map("%d\t%d\t%.3f\t%.3f\n".__mod__, rows_of(columns)))
    groups: dict[int, list[int]] = defaultdict(list)
    for seen in np.unique(agent).tolist():
        groups[world.plan.people[seen].group].append(seen)
    together = [members for _, members in sorted(groups.items()) if len(members) > 1]
    write_text(files[1], "".join(f"{' '.join(map(str, members))}\n" for members in together))
    return files


def resampled(motion: Motion, interval_s: float) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Positions `[k, a, 2]` and presence `[k, a]` at multiples of an interval, between frames on a straight line.

    Between two frames a person is there only if it is in both.
    """
    n_frames = len(motion.present)
    n_rows = int((n_frames - 1) * motion.dt_s / interval_s + 1e-6) + 1 if n_frames else 0
    at = np.arange(n_rows) * (interval_s / motion.dt_s)
    before = np.floor(at + 1e-6).astype(np.int64)
    share = np.where(at - before > 1e-6, at - before, 0.0)
    after = np.where(share > 0, before + 1, before)
    step_m = motion.positions_m[after].astype(np.float64) - motion.positions_m[before]
    # adding zero turns -0.0 into 0.0
    positions_m = np.round(motion.positions_m[before] + share[:, None, None] * step_m, 3) + 0.0
    return positions_m, motion.present[before] & motion.present[after]
