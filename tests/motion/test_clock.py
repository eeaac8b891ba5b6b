from __future__ import annotations

import pytest

from genc.motion.clock import Clock, Errand, Life, Signal, Wait


def run(clock: Clock, until_s: float, dt_s: float = 0.1) -> None:
    for step in range(round(until_s / dt_s) + 1):
        clock.advance(step * dt_s)


def test_a_life_runs_at_once_up_to_its_first_wait():
    clock, seen = Clock(), []

    def life() -> Life:
        seen.append("begun")
        yield Wait(until_s=1.0)
        seen.append(clock.now_s)

    clock.start(life())
    assert seen == ["begun"]
    run(clock, 2.0)
    assert seen[1] == pytest.approx(1.0)


def test_a_signal_wakes_all_who_wait_in_the_order_in_which_they_came():
    clock, signal, seen = Clock(), Signal(), []

    def life(name: str) -> Life:
        happened = yield Wait(signal, until_s=5.0)
        seen.append((name, happened))

    for name in "abc":
        clock.start(life(name))
    clock.advance(1.0)
    assert seen == []
    clock.fire(signal)
    clock.advance(1.1)
    assert seen == [("a", True), ("b", True), ("c", True)]
    run(clock, 10.0)
    assert len(seen) == 3


def test_patience_ends_when_nothing_happens():
    clock, signal, seen = Clock(), Signal(), []

    def life() -> Life:
        seen.append((yield Wait(signal, until_s=1.0)))

    clock.start(life())
    run(clock, 2.0)
    assert seen == [False]
    clock.fire(signal)
    run(clock, 3.0)
    assert seen == [False]


def test_what_has_happened_is_not_waited_for():
    clock, seen = Clock(), []

    def life() -> Life:
        seen.append((yield Wait(Signal(happened=True))))

    clock.start(life())
    clock.advance(0.0)
    assert seen == [True]


def test_a_chain_of_happenings_unfolds_within_one_moment():
    clock, links, seen = Clock(), [Signal() for _ in range(4)], []

    def life(k: int) -> Life:
        yield Wait(links[k])
        seen.append((k, clock.now_s))
        clock.fire(links[k + 1])

    for k in (2, 1, 0):
        clock.start(life(k))
    clock.fire(links[0])
    clock.advance(7.0)
    assert seen == [(0, 7.0), (1, 7.0), (2, 7.0)]


def test_an_errand_gives_its_result_to_the_life_that_runs_it():
    clock, seen = Clock(), []

    def errand() -> Errand:
        yield Wait(until_s=1.0)
        return True

    def life() -> Life:
        seen.append((yield from errand()))

    clock.start(life())
    run(clock, 1.0)
    assert seen == [True]


def test_a_sum_of_steps_that_misses_the_moment_by_rounding_still_meets_it():
    clock, seen = Clock(), []

    def life() -> Life:
        for _ in range(10):
            yield Wait(until_s=clock.now_s + 0.1)
            seen.append(clock.now_s)

    clock.start(life())
    run(clock, 1.0)
    assert len(seen) == 10
