"""The line at one place: who stands in it, in what order, and who is being served."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

from genc.motion.clock import Signal
from genc.plan.plan import Slot


@dataclass(eq=False)
class Party:
    """People who stand in a line together.

    Attributes:
        members: all of them, in the order in which they stand.
        customers: those who take a service slot when it is their turn, each with the slot that the plan has in mind;
            nobody, if the line itself is the goal.
        ready: False while the plan does not let them be served yet; they let others pass.
        turn: it is their turn. Customers have their service slot then and the party has left the line; a party
            without customers is at the head and leaves by itself.
    """

    members: tuple[int, ...]
    customers: Mapping[int, Slot] = field(default_factory=dict)
    ready: bool = False
    turn: Signal = field(default_factory=Signal)


class Line:
    """First come, first served.

    Args:
        positions: where people stand, head first.
        service: the service slots; their number is the capacity.
        send: sends an agent to a slot of the line or, if False, to room near it: who finds none in the line stands
            about its end until there is.
        fire: says that a signal has happened.
    """

    def __init__(
        self,
        positions: Sequence[Slot],
        service: Sequence[Slot],
        send: Callable[[int, Slot, bool], object],
        fire: Callable[[Signal], None],
    ) -> None:
        self._positions = positions
        self._free = list(service)
        self._capacity = len(service)
        self._send = send
        self._fire = fire
        self._parties: list[Party] = []
        self._gathering: list[int] = []
        self._stands_at: dict[int, int] = {}
        self.served: dict[int, Slot] = {}
        """Who has a service slot, and which."""

    def tail(self) -> Slot:
        """Where the next to come would stand."""
        return self._positions[min(len(self._stands_at), len(self._positions) - 1)]

    def gather(self, agent: int) -> None:
        """Puts somebody behind the line who waits for the rest of a party."""
        self._gathering.append(agent)
        self._close_up()

    def join(self, party: Party) -> None:
        """Puts a party at the end of the line; its members gather no longer."""
        self._gathering = [agent for agent in self._gathering if agent not in party.members]
        self._parties.append(party)
        self._close_up()

    def let(self, party: Party) -> None:
        """Says that a party may be served from now on."""
        party.ready = True
        self._call()

    def leave(self, party: Party) -> None:
        """Takes a party out of the line, and calls the next."""
        self._parties.remove(party)
        for agent in party.members:
            self._stands_at.pop(agent, None)
        self._close_up()
        self._call()

    def release(self, agent: int) -> None:
        """Takes back the service slot of an agent who has one, and calls the next."""
        slot = self.served.pop(agent, None)
        if slot is not None:
            self._free.append(slot)
            self._call()

    def _close_up(self) -> None:
        standing = [agent for party in self._parties for agent in party.members] + self._gathering
        for rank, agent in enumerate(standing):
            place = min(rank, len(self._positions))
            if self._stands_at.get(agent) != place:
                self._stands_at[agent] = place
                fits = place < len(self._positions)
                self._send(agent, self._positions[place if fits else -1], fits)

    def _call(self) -> None:
        """Gives its turn to the first party that is ready, if there is room."""
        party = next((party for party in self._parties if party.ready), None)
        if party is None or party.turn.happened:
            return
        if party.customers:
            customers = list(party.customers)[: self._capacity]
            if len(self._free) < len(customers):
                return
            for customer in customers:
                wished = party.customers[customer]
                self.served[customer] = self._free.pop(self._free.index(wished) if wished in self._free else 0)
        self._fire(party.turn)
        if party.customers:
            self.leave(party)
