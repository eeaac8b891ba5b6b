"""A counter with Poisson arrivals and exponential services is an M/M/c queue, and the executor agrees with its theory.

In two steps, for the mean of few customers scatters widely: customers of a world wait as long as in an exact queue with
the same arrivals and services; and the exact queue has, over very many customers, the mean wait of the theory.
"""

from __future__ import annotations

import heapq
import math

import numpy as np
import pytest

from genc.motion.executor import Options, simulate
from genc.motion.kinematic import Kinematic
from genc.plan.plan import Activity, CrowdPlan, Person
from genc.plan.slots import places_of
from genc.plan.walkable import Walkable
from genc.scenario.scenario import Environment, Location
from genc.words.vocabulary import Action, Category

HALL = Environment(
    (
        Location("door", Category.ENTRANCE, (0.0, 0.0), (4.0, 4.0)),
        Location("counter", Category.SERVICE_AREA, (20.0, 40.0), (3.2, 1.0)),
        Location("hall", Category.ROOM, (20.0, 20.0), (60.0, 60.0)),
    )
)
COUNTER = 1
GROUND = Walkable.of(HALL)
PLACES = places_of(HALL, GROUND)
SERVERS = PLACES[COUNTER].service
MEAN_GAP_S, MEAN_SERVICE_S = 40.0, 55.0
WALK_UP_S = 1.5
"""From the head of the line to the counter, in whole steps; meanwhile it serves nobody."""
N_CUSTOMERS, N_WORLDS, DT_S = 300, 3, 0.5


def erlang_c_wait_s(mean_gap_s: float, mean_service_s: float, n_servers: int) -> float:
    """The mean wait in an M/M/c queue."""
    load = mean_service_s / mean_gap_s
    last = load**n_servers / math.factorial(n_servers) / (1 - load / n_servers)
    all_busy = last / (sum(load**k / math.factorial(k) for k in range(n_servers)) + last)
    return all_busy / (n_servers / mean_service_s - 1 / mean_gap_s)


def first_come_first_served_s(arrivals_s: np.ndarray, services_s: np.ndarray, n_servers: int) -> np.ndarray:
    """The exact waits of a queue with these arrivals and services."""
    free_s, waits_s = [0.0] * n_servers, []
    for arrival_s, service_s in zip(arrivals_s.tolist(), services_s.tolist(), strict=True):
        start_s = max(arrival_s, heapq.heappop(free_s))
        heapq.heappush(free_s, start_s + service_s)
        waits_s.append(start_s - arrival_s)
    return np.array(waits_s)


def customers(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    arrivals_s = np.cumsum(rng.exponential(MEAN_GAP_S, N_CUSTOMERS))
    return arrivals_s, rng.exponential(MEAN_SERVICE_S, N_CUSTOMERS)


def waits_in_a_world_s(arrivals_s: np.ndarray, services_s: np.ndarray) -> np.ndarray:
    """How long each customer really waits: from standing in line to being called."""
    people = []
    for i, (come_s, lasts_s) in enumerate(zip(arrivals_s.tolist(), services_s.tolist(), strict=True)):
        line, slot = PLACES[COUNTER].line[0], SERVERS[i % len(SERVERS)]
        queue = Activity(Action.QUEUE, COUNTER, line, come_s, come_s, come_s, 2 * i)
        service = Activity(Action.OBJECT_INTERACT, COUNTER, slot, come_s, come_s, come_s + lasts_s, 2 * i + 1)
        people.append(Person(0, 1.3, (queue, service), leaves=True))
    plan = CrowdPlan(HALL, tuple(people), float(arrivals_s[-1]) + 3000.0, ("customers",))
    steering = Kinematic(N_CUSTOMERS, GROUND, DT_S)
    motion = simulate(plan, GROUND, PLACES, steering, Options(), np.random.default_rng(0))
    queued = [done for done in motion.executed if done.step == 0]
    return np.array([done.end_s - done.start_s for done in queued])


@pytest.fixture(scope="module")
def worlds() -> list[tuple[np.ndarray, np.ndarray]]:
    """For each world the waits of its people, and the exact ones."""
    n_servers = len(SERVERS)
    found = []
    for seed in range(N_WORLDS):
        arrivals_s, services_s = customers(np.random.default_rng(seed))
        exact_s = first_come_first_served_s(arrivals_s, services_s + WALK_UP_S, n_servers)
        found.append((waits_in_a_world_s(arrivals_s, services_s), exact_s))
    return found


def test_waits_are_those_of_first_come_first_served(worlds):
    for real_s, exact_s in worlds:
        assert exact_s.mean() > 10, "a case without queues proves nothing"
        assert real_s.mean() == pytest.approx(exact_s.mean(), rel=0.05)
        assert np.corrcoef(real_s, exact_s)[0, 1] > 0.99


def test_the_theory_holds_for_the_exact_queue():
    rng = np.random.default_rng(0)
    arrivals_s = np.cumsum(rng.exponential(MEAN_GAP_S, 200_000))
    exact_s = first_come_first_served_s(arrivals_s, rng.exponential(MEAN_SERVICE_S, 200_000), len(SERVERS))
    assert exact_s.mean() == pytest.approx(erlang_c_wait_s(MEAN_GAP_S, MEAN_SERVICE_S, len(SERVERS)), rel=0.05)
