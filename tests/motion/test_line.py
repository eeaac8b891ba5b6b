from __future__ import annotations

from collections import Counter

from hypothesis import given
from hypothesis import strategies as st
from small_world import at

from genc.motion.clock import Signal
from genc.motion.line import Line, Party
from genc.plan.plan import Slot

POSITIONS = [at(float(-k), 0.0) for k in range(1, 6)]
SERVICE = [at(0.0, 0.0), at(0.0, 1.0)]


class Bystander:
    """A line whose moves and calls are written down."""

    def __init__(self, n_service: int = 2) -> None:
        self.at: dict[int, Slot] = {}
        self.called: list[Signal] = []
        self.n_sent: Counter[int] = Counter()
        self.beyond: set[int] = set()
        self.line = Line(POSITIONS, SERVICE[:n_service], self.send, self.fire)

    def send(self, agent: int, slot: Slot, fits: bool) -> None:
        self.at[agent] = slot
        self.n_sent[agent] += 1
        self.beyond = (self.beyond | {agent}) - ({agent} if fits else set())

    def fire(self, signal: Signal) -> None:
        signal.happened = True
        self.called.append(signal)


def customer(agent: int, wished: int = 0) -> Party:
    return Party((agent,), {agent: SERVICE[wished]})


def join(seen: Bystander, *parties: Party) -> None:
    for party in parties:
        seen.line.join(party)
        seen.line.let(party)


def test_who_comes_first_is_served_first():
    seen = Bystander(n_service=1)
    a, b, c = (customer(agent) for agent in "abc")  # type: ignore[arg-type]
    join(seen, a, b, c)
    assert seen.called == [a.turn]
    seen.line.release("a")  # type: ignore[arg-type]
    assert seen.called == [a.turn, b.turn]
    seen.line.release("b")  # type: ignore[arg-type]
    assert seen.called == [a.turn, b.turn, c.turn]


def test_everybody_moves_up_when_the_head_is_called():
    seen = Bystander(n_service=1)
    join(seen, customer(0), customer(1), customer(2))
    assert (seen.at[1], seen.at[2]) == (POSITIONS[0], POSITIONS[1])
    seen.line.release(0)
    assert seen.at[2] == POSITIONS[0]


def test_a_party_is_called_as_a_whole_or_not_at_all():
    seen = Bystander(n_service=2)
    pair = Party((1, 2), {1: SERVICE[0], 2: SERVICE[1]})
    join(seen, customer(0), pair, customer(3))
    assert not pair.turn.happened
    seen.line.release(0)
    assert pair.turn.happened
    assert set(seen.line.served) == {1, 2}


def test_a_party_larger_than_the_service_takes_all_of_it():
    seen = Bystander(n_service=2)
    trio = Party((1, 2, 3), dict.fromkeys((1, 2, 3), SERVICE[0]))
    join(seen, trio)
    assert trio.turn.happened
    assert seen.line.served == {1: SERVICE[0], 2: SERVICE[1]}


def test_the_slot_that_the_plan_has_in_mind_is_given_where_it_is_free():
    seen = Bystander()
    join(seen, customer(0, wished=1))
    assert seen.line.served == {0: SERVICE[1]}


def test_who_may_not_be_served_yet_lets_others_pass():
    seen = Bystander(n_service=1)
    early, ready = customer(0), customer(1)
    seen.line.join(early)
    join(seen, ready)
    assert seen.called == [ready.turn]
    seen.line.let(early)
    seen.line.release(1)
    assert seen.called == [ready.turn, early.turn]


def test_a_party_without_customers_keeps_the_head_until_it_leaves():
    seen = Bystander(n_service=1)
    idlers, follower = Party((0, 1)), customer(2)
    join(seen, idlers, follower)
    assert seen.called == [idlers.turn]
    seen.line.leave(idlers)
    assert seen.called == [idlers.turn, follower.turn]


def test_who_waits_for_friends_stands_behind_the_line_and_joins_at_its_end():
    seen = Bystander(n_service=1)
    seen.line.gather(9)
    join(seen, customer(0), customer(1))
    assert seen.at[9] == POSITIONS[1]
    friends = Party((9, 8))
    join(seen, friends, customer(2))
    assert (seen.at[1], seen.at[9], seen.at[8], seen.at[2]) == tuple(POSITIONS[:4])


def test_who_finds_no_room_stands_at_the_last_position():
    seen = Bystander(n_service=1)
    join(seen, *(customer(agent) for agent in range(9)))
    assert seen.at[8] == POSITIONS[-1]
    assert seen.line.tail() == POSITIONS[-1]


@given(st.lists(st.integers(1, 4), min_size=1, max_size=12), st.integers(1, 2), st.randoms(use_true_random=False))
def test_every_party_is_served_in_order_and_never_more_than_there_are_slots(sizes, n_service, random):
    seen = Bystander(n_service)
    parties = []
    for k, size in enumerate(sizes):
        members = tuple(100 * k + i for i in range(size))
        parties.append(Party(members, dict.fromkeys(members, SERVICE[0])))
    join(seen, *parties)
    while seen.line.served:
        assert len(seen.line.served) <= n_service
        assert len({slot.position_m for slot in seen.line.served.values()}) == len(seen.line.served)
        seen.line.release(random.choice(sorted(seen.line.served)))
    assert seen.called == [party.turn for party in parties]


def test_who_finds_no_room_in_the_line_stays_about_its_end_until_there_is():
    seen = Bystander(n_service=1)
    join(seen, *(customer(agent) for agent in range(9)))
    assert [seen.at[agent] for agent in range(1, 6)] == POSITIONS
    assert seen.beyond == {6, 7, 8}
    seen.line.release(0)
    assert seen.at[6] == POSITIONS[-1]
    assert seen.beyond == {7, 8}
    assert [seen.n_sent[agent] for agent in (7, 8)] == [1, 1], "who has no room yet is not sent about"
