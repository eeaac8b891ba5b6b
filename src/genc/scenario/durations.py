"""How long things take: one table, used by rehearsals and by schedules.

A duration is drawn from a log-normal distribution and cut off at a shortest and a longest value: times of
human tasks are skewed to the right, and the log-normal fits them well (call centre service times: Brown et al.,
"Statistical Analysis of a Telephone Call Center", JASA 2005). The paper samples "from action-specific
distributions" and gives none (Gen-C, Bootstrapping Crowd Scenarios via LLMs); these are ours.

What is known is used:

- `look at` an exhibit: median 17 s, mean 27 s for a painting (Smith and Smith, "Spending Time on Art", Empirical
  Studies of the Arts 2001; 450 visitors of the Metropolitan Museum). Median 17 s and spread 0.9 give mean 25 s.
- `enter/exit`: a free or gated portal passes 25 to 60 people a minute, 1 to 2.4 s each (Fruin, Pedestrian
  Planning and Design, 1971); a second or two is added for slowing down and looking around.
- `queue` has a minimum only: the time in a queue emerges from the people ahead and from their service times.

All else is an estimate, made for worlds of about ten minutes: short doings (a wave, a glance, a purchase) have
their natural length, long ones (a lunch, a lecture, an hour on a bench) are shortened to a minute or two, so that
a plan of seven steps fits and the shorter-longer relations between doings stay.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from genc.words.vocabulary import ACTIONS, CATEGORIES, Action, Category


@dataclass(frozen=True)
class Duration:
    """A log-normal duration: median, standard deviation of its logarithm, and where it is cut off."""

    median_s: float
    spread: float
    shortest_s: float
    longest_s: float


ANYWHERE: dict[Action, Duration] = {
    Action.WAIT: Duration(30, 0.6, 5, 180),
    Action.SIT: Duration(60, 0.7, 10, 300),
    Action.WANDER: Duration(25, 0.5, 6, 120),
    Action.QUEUE: Duration(4, 0.3, 2, 10),
    Action.ENTER_EXIT: Duration(3, 0.3, 1.5, 8),
    Action.WAVE_AT: Duration(3, 0.3, 1.5, 8),
    Action.DISCUSS: Duration(40, 0.6, 8, 240),
    Action.MEET: Duration(10, 0.4, 3, 40),
    Action.OBJECT_INTERACT: Duration(30, 0.6, 4, 240),
    Action.TALK_ON_PHONE: Duration(45, 0.7, 8, 300),
    Action.READ: Duration(40, 0.6, 5, 240),
    Action.LOOK_AT: Duration(10, 0.5, 3, 90),
    Action.CARRY: Duration(15, 0.5, 4, 60),
}
"""How long an action takes where the kind of place makes no difference."""

THERE: dict[tuple[Action, Category], Duration] = {
    # Until the order is ready or the counter is free, as opposed to until the train comes.
    (Action.WAIT, Category.SERVICE_AREA): Duration(20, 0.5, 5, 120),
    (Action.SIT, Category.FURNITURE): Duration(75, 0.7, 10, 300),
    # With the staff, as opposed to among friends.
    (Action.DISCUSS, Category.SERVICE_AREA): Duration(25, 0.5, 8, 120),
    (Action.DISCUSS, Category.FURNITURE): Duration(60, 0.6, 10, 300),
    # One service: ordering, paying, taking.
    (Action.OBJECT_INTERACT, Category.SERVICE_AREA): Duration(45, 0.5, 10, 180),
    # A machine, a bin, a screen; a gate or a door; a meal or work at a table.
    (Action.OBJECT_INTERACT, Category.ITEM): Duration(20, 0.6, 4, 120),
    (Action.OBJECT_INTERACT, Category.ENTRANCE): Duration(6, 0.4, 2, 30),
    (Action.OBJECT_INTERACT, Category.FURNITURE): Duration(90, 0.6, 15, 300),
    # A board, a sign or a label, as opposed to a book.
    (Action.READ, Category.ITEM): Duration(12, 0.5, 4, 60),
    (Action.READ, Category.ENTRANCE): Duration(10, 0.5, 4, 60),
    (Action.READ, Category.EXHIBIT): Duration(20, 0.6, 5, 90),
    (Action.READ, Category.FURNITURE): Duration(75, 0.6, 10, 300),
    (Action.LOOK_AT, Category.EXHIBIT): Duration(17, 0.9, 3, 180),
}
"""What takes another time at one kind of place than elsewhere."""

_TABLE = [[THERE.get((action, category), ANYWHERE[action]) for category in CATEGORIES] for action in ACTIONS]
_MEDIAN_S = np.array([[duration.median_s for duration in row] for row in _TABLE])
_SPREAD = np.array([[duration.spread for duration in row] for row in _TABLE])
_SHORTEST_S = np.array([[duration.shortest_s for duration in row] for row in _TABLE])
_LONGEST_S = np.array([[duration.longest_s for duration in row] for row in _TABLE])


def sample_durations(
    actions: NDArray[np.int64], categories: NDArray[np.int64], rng: np.random.Generator
) -> NDArray[np.float64]:
    """Seconds that each doing takes; vocabulary indices in, the same shape out."""
    at = (actions, categories)
    drawn_s = _MEDIAN_S[at] * np.exp(_SPREAD[at] * rng.standard_normal(np.shape(actions)))
    return np.asarray(np.clip(drawn_s, _SHORTEST_S[at], _LONGEST_S[at]))


def median_s(action: Action, category: Category) -> float:
    """The median duration of an action at a kind of place, seconds."""
    return THERE.get((action, category), ANYWHERE[action]).median_s
