"""Time, and lives that wait in it.

A life is a generator: it does something, yields what it waits for, and is resumed when that has happened or its
patience has ended. So a whole life reads from top to bottom, and nothing costs time between two happenings.
"""

from __future__ import annotations

import heapq
import math
from collections import deque
from collections.abc import Generator
from dataclasses import dataclass, field
from itertools import count

_INSTANT_S = 1e-9
"""Times that close are one: a moment computed by adding must not miss its step by a rounding error."""


@dataclass(eq=False)
class Signal:
    """Something that happens once."""

    happened: bool = False
    waiting: list[_Pause] = field(default_factory=list)


@dataclass(frozen=True)
class Wait:
    """What a life yields: it goes on when the signal happens, or at `until_s`, whichever is first.

    The yield returns True if the signal has happened.
    """

    signal: Signal | None = None
    until_s: float = math.inf


Life = Generator[Wait, bool, None]
Errand = Generator[Wait, bool, bool]
"""A part of a life that gives back whether it succeeded."""


@dataclass(eq=False)
class _Pause:
    """One life at one yield; `over` as soon as something has resumed it."""

    life: Life
    over: bool = False


class Clock:
    """Runs lives; equal lives give equal orders, for whoever is ready first goes first."""

    def __init__(self) -> None:
        self.now_s = 0.0
        self._alarms: list[tuple[float, int, _Pause]] = []
        self._ready: deque[tuple[Life, bool]] = deque()
        self._number = count()

    def start(self, life: Life) -> None:
        """Begins a life: it runs at once, up to its first wait."""
        self._await(life, next(life, None))

    def fire(self, signal: Signal) -> None:
        """Says that something has happened: all who wait for it go on within this `advance` or the next."""
        if signal.happened:
            return
        signal.happened = True
        for pause in signal.waiting:
            if not pause.over:
                pause.over = True
                self._ready.append((pause.life, True))
        signal.waiting.clear()

    def advance(self, to_s: float) -> None:
        """Moves on to a time and lets everybody go on who has reason to, until nobody has."""
        self.now_s = to_s
        while self._ready or self._due():
            while self._due():
                _, _, pause = heapq.heappop(self._alarms)
                if not pause.over:
                    pause.over = True
                    self._ready.append((pause.life, False))
            while self._ready:
                self._resume(*self._ready.popleft())

    def is_past(self, time_s: float) -> bool:
        """Whether a moment has come."""
        return time_s <= self.now_s + _INSTANT_S

    def _due(self) -> bool:
        return bool(self._alarms) and self.is_past(self._alarms[0][0])

    def _resume(self, life: Life, happened: bool) -> None:
        try:
            wait = life.send(happened)
        except StopIteration:
            return
        self._await(life, wait)

    def _await(self, life: Life, wait: Wait | None) -> None:
        if wait is None:
            return
        if wait.signal is not None and wait.signal.happened:
            self._ready.append((life, True))
            return
        pause = _Pause(life)
        if wait.signal is not None:
            wait.signal.waiting.append(pause)
        if wait.until_s < math.inf:
            heapq.heappush(self._alarms, (wait.until_s, next(self._number), pause))
