"""How well worlds are carried out: do people arrive, meet, keep apart, stay on the ground, and walk like people?

    python benchmarks/alignment.py --steering jupedsim --agents 200 --worlds 10

One sentence a world, in turn, each with its own seed; or `--files` for worlds that are there. See README.md.
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.spatial import KDTree

from genc import populate
from genc.motion.motion import Executed, Status
from genc.plan.ground import ground_polygon, on_ground
from genc.plan.plan import ON_THE_WAY, ROAMING, Activity
from genc.plan.walkable import Walkable
from genc.words.vocabulary import Action
from genc.world.world import World
from genc.world.world_file import read_world

SENTENCES = (
    "Commuters hurry through the station concourse, some buy coffee and wait for the train",
    "Students cross the campus quad, some read on benches, others talk in groups",
    "Visitors stroll through the shopping mall, friends meet at the fountain and families queue for ice cream",
    "A school class visits the museum while couples look at the paintings",
    "Patients wait in the hospital hall and nurses carry files between the desks",
    "People queue at the street food market and eat together at long tables",
    "Travellers check in at the airport and wait at the gate, talking on the phone",
    "Families picnic in the park, children wave at each other, joggers pass",
    "Employees meet in the office lobby, discuss and carry boxes",
    "Guests arrive at the beach promenade cafe and sit with friends",
)
BODIES_OVERLAP_M = 0.3
"""Two bodies of radius 0.2 m whose middles are nearer than this overlap by more than 0.1 m."""
NEAR_M = 2.0
AT_SLOT_M = 0.3
ELSEWHERE_M = 3.0
ABOUT = (*ROAMING, Action.ENTER_EXIT, Action.QUEUE)
"""Doings that do not stand at one slot."""
EVERY = 2
"""Frames looked at: every second."""

Figures = dict[str, float]


def main() -> None:
    """Prints one line for each world and one for all."""
    wishes = _arguments()
    rows = []
    for name, world, seconds in _worlds(wishes):
        rows.append({**figures(world), "seconds": seconds})
        print(name, _line(rows[-1]), flush=True)
    mean = {key: float(np.mean([row[key] for row in rows])) for key in rows[0]}
    print("mean", _line(mean))
    if wishes.json:
        wishes.json.write_text(json.dumps({"worlds": rows, "mean": mean}, indent=1))


def figures(world: World) -> Figures:
    """Shares in percent, lengths in metres, speeds in metres a second."""
    done = world.motion.executed
    timeouts = sum(row.status is Status.TIMEOUT for row in done)
    return {
        "agents": len(world.plan.people),
        "activities": len(done),
        "timeout_percent": 100 * timeouts / max(len(done), 1),
        **_bodies(world),
        **_speeds(world),
        **_meetings(world),
    }


def _bodies(world: World) -> Figures:
    """The share of people's time in which they overlap with somebody, or are off the ground."""
    motion, n_overlap, n_seen = world.motion, 0, 0
    for positions_m, present in zip(motion.positions_m[::EVERY], motion.present[::EVERY], strict=True):
        here_m = positions_m[present]
        n_seen += len(here_m)
        if len(here_m):
            n_overlap += len(np.unique(KDTree(here_m).query_pairs(BODIES_OVERLAP_M, output_type="ndarray")))
    seen_m = motion.positions_m[motion.present].astype(float)
    ground = ground_polygon(Walkable.of(world.plan.environment))
    return {
        "overlap_percent": 100 * n_overlap / max(n_seen, 1),
        "off_ground_percent": 100 * float(1 - on_ground(ground, seen_m).mean()),
    }


def _speeds(world: World) -> Figures:
    """Speeds of those who walk from place to place; free flow: with nobody within two metres."""
    motion = world.motion
    speeds_mps = np.linalg.norm(np.diff(motion.positions_m, axis=0), axis=2) / motion.dt_s
    seen = motion.present[1:] & motion.present[:-1]
    walks = np.zeros_like(seen)
    for row in motion.executed:
        if row.arrive_s - row.leave_s > 4:
            walks[int((row.leave_s + 1) / motion.dt_s) : int((row.arrive_s - 1) / motion.dt_s), row.agent] = True
    walks &= seen
    free = []
    for frame in range(0, len(walks), 5):
        walkers = np.flatnonzero(walks[frame])
        if len(walkers):
            tree = KDTree(motion.positions_m[frame, motion.present[frame]])
            apart_m, _ = tree.query(motion.positions_m[frame, walkers], k=2, distance_upper_bound=NEAR_M)
            free.append(speeds_mps[frame, walkers[~np.isfinite(apart_m[:, 1])]])
    free_mps = np.concatenate(free)
    return {
        "free_flow_mps": float(free_mps.mean()),
        "free_flow_sd_mps": float(free_mps.std()),
        "walk_mps": float(speeds_mps[walks].mean()),
        "fastest_mps": float(speeds_mps[seen].max()),
    }


def _meetings(world: World) -> Figures:
    """At the beginning of what stands at a slot: the share of people not at it, and of those without a partner near."""
    motion, last = world.motion, len(world.motion.present) - 1
    away, elsewhere, alone = [], [], []
    for row, activity in _stationary(world):
        frame = min(int(np.ceil((row.start_s + 0.3) / motion.dt_s)), last)
        if not motion.present[frame, row.agent]:
            continue
        here_m = motion.positions_m[frame, row.agent]
        away.append(np.linalg.norm(here_m - row.position_m) > AT_SLOT_M)
        elsewhere.append(math.dist(row.position_m, activity.slot.position_m) > ELSEWHERE_M)
        partners = [other for other in activity.partners if motion.present[frame, other]]
        if partners and row.status is Status.DONE:
            apart_m = np.linalg.norm(motion.positions_m[frame, partners] - here_m, axis=1)
            alone.append(apart_m.min() > NEAR_M)
    waits_s = [row.start_s - row.arrive_s for row in motion.executed if not np.isnan(row.start_s)]
    return {
        "away_from_slot_percent": 100 * float(np.mean(away)),
        "elsewhere_percent": 100 * float(np.mean(elsewhere)),
        "partner_far_percent": 100 * float(np.mean(alone)) if alone else 0.0,
        "mean_wait_s": float(np.mean(waits_s)),
    }


def _stationary(world: World) -> Iterator[tuple[Executed, Activity]]:
    for row in world.motion.executed:
        activity = world.plan.people[row.agent].activities[row.step]
        on_the_way = activity.action in ON_THE_WAY and row.arrive_s == row.leave_s
        if not np.isnan(row.start_s) and activity.action not in ABOUT and not on_the_way:
            yield row, activity


def _worlds(wishes: argparse.Namespace) -> Iterator[tuple[str, World, float]]:
    for file in wishes.files:
        yield str(file), read_world(file), 0.0
    for seed in range(wishes.seed, wishes.seed + wishes.worlds) if not wishes.files else ():
        begun_s = time.perf_counter()
        text = SENTENCES[seed % len(SENTENCES)]
        world = populate(text, n_agents=wishes.agents, minutes=wishes.minutes, seed=seed, steering=wishes.steering)
        yield f"seed {seed}", world, time.perf_counter() - begun_s


def _line(row: Figures) -> str:
    return "  ".join(f"{key} {value:.4g}" for key, value in row.items())


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steering", default="jupedsim")
    parser.add_argument("--agents", type=int, default=200)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--worlds", type=int, default=10)
    parser.add_argument("--seed", type=int, default=0, help="of the first world")
    parser.add_argument("--files", nargs="*", type=Path, default=[])
    parser.add_argument("--json", type=Path)
    return parser.parse_args()


if __name__ == "__main__":
    main()
