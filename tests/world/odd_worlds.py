"""Small worlds with everything in them that is rare: written by hand, not simulated."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from genc.motion.motion import Executed, Motion, Status
from genc.plan.plan import Activity, CrowdPlan, Person, Slot
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action, Category
from genc.world.world import World

NAMES = ('Café "Zoë"', "cafe zoe", "CAFE ZOE", "東京駅", "東京 駅", "9th gate", "Ground", "a/b\\c<d>,\t'e'", "hall")
HALL, KIOSK, SHOP = 8, 5, 0
DT_S = 0.3
N_FRAMES = 41
NAN = float("nan")


def environment() -> Environment:
    """A hall with odd things in it, named as oddly as names may be."""
    places = [
        Location(name, Category.SERVICE_AREA, (4.0 * i - 12.0, 6.0), (2.0, 1.0)) for i, name in enumerate(NAMES[:8])
    ]
    places[SHOP] = replace(places[SHOP], category=Category.BUILDING)
    return Environment((*places, Location("hall", Category.ROOM, (0.0, 0.0), (40.0, 8.0))))


def activity(action: Action, location: int, occasion: int, partners: tuple[int, ...] = ()) -> Activity:
    return Activity(action, location, Slot((1.0, -1.5), 0.5), 0.0, 2.0, 5.0, occasion, partners)


def nobody() -> World:
    empty = np.zeros((3, 0, 2), np.float32), np.zeros((3, 0), np.float32), np.zeros((3, 0), bool)
    return World(CrowdPlan(environment(), (), 0.6), Motion(DT_S, *empty, ()))


def one_frame() -> World:
    """A single person, who stands there for the one frame there is."""
    done = Executed(0, 0, 0.0, 0.0, 0.0, NAN, (1.0, -1.5), 0.5, Status.CUT)
    plan = CrowdPlan(environment(), (Person(0, 1.2, (activity(Action.READ, HALL, 0),), False),), 0.0, ("alone",))
    motion = Motion(0.2, np.full((1, 1, 2), [[[1.0, -1.5]]], np.float32), np.full((1, 1), 0.5, np.float32), *there(1))
    return World(plan, replace(motion, executed=(done,)), {"text": "one"})


def there(n_frames: int) -> tuple[np.ndarray, tuple[Executed, ...]]:
    return np.ones((n_frames, 1), bool), ()


def rare() -> World:
    """Five people in 12 seconds.

    0 turns on the spot, more than once round; 1 is in the scene for one frame; 2 never comes; 3 walks to the shop, is
    in it, and comes out again elsewhere; 4 is there all the time and 3's partner, and has a plan that ends early.
    """
    t_s = np.arange(N_FRAMES) * DT_S
    positions_m = np.zeros((N_FRAMES, 5, 2), np.float32)
    headings_rad = np.zeros((N_FRAMES, 5), np.float32)
    present = np.zeros((N_FRAMES, 5), bool)
    present[:, [0, 4]] = present[17, 1] = True
    headings_rad[:, 0] = (1.1 * t_s + np.pi) % (2 * np.pi) - np.pi
    positions_m[:, 0] = -3.25, -2.0
    positions_m[:, 1] = 5.0, 1.0
    inside = (t_s > 4) & (t_s < 8)
    present[:, 3] = ~inside
    positions_m[:, 3] = np.where(t_s[:, None] <= 4, [[0.0, 0.0]] + t_s[:, None] * [[-1.2, 0.5]], [[9.0, 4.0]])
    positions_m[:, 4, 0] = np.where(t_s < 6, t_s, 6.0)
    people = (
        Person(0, 1.0, (activity(Action.WANDER, HALL, 0),), False),
        Person(0, 1.5, (activity(Action.ENTER_EXIT, KIOSK, 1),), True),
        Person(1, 1.4, (activity(Action.SIT, HALL, 2),), False),
        Person(2, 1.2, (activity(Action.ENTER_EXIT, SHOP, 3, (4,)), activity(Action.DISCUSS, HALL, 4, (4,))), False),
        Person(2, 1.3, (activity(Action.ENTER_EXIT, SHOP, 3, (3,)), activity(Action.DISCUSS, HALL, 4, (3,))), False),
    )
    executed = (
        Executed(0, 0, 0.0, 0.6, 1.2, NAN, (-3.25, -2.0), 0.0, Status.CUT),
        Executed(1, 0, 5.1, 5.1, 5.1, 5.4, (5.0, 1.0), 0.0, Status.DONE),
        Executed(3, 0, 0.0, 4.0, 4.0, 8.0, (-4.8, 2.0), 0.0, Status.DONE),
        Executed(3, 1, 8.0, 9.0, 9.5, NAN, (9.0, 4.0), 0.0, Status.CUT),
        Executed(4, 0, 0.0, 4.0, 4.0, 8.0, (4.0, 0.0), 0.0, Status.TIMEOUT),
        Executed(4, 1, 8.0, 8.0, 9.5, 10.0, (6.0, 0.0), 0.0, Status.DONE),
    )
    plan = CrowdPlan(environment(), people, 12.0, ('a "caption", odd\nand long', "", "friends"))
    return World(plan, Motion(DT_S, positions_m, headings_rad, present, executed), {"text": "rare", "model": None})
