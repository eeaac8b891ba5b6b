"""The stage: where bodies are, where they face, and the film that is taken of them."""

from __future__ import annotations

import numpy as np
from tqdm import tqdm

from genc.motion.clock import Clock, Signal
from genc.motion.motion import Executed, Motion
from genc.motion.steering import Steering, Target
from genc.plan.plan import Slot

_TURN_RADPS = 2 * np.pi
"""How fast a body turns to where it wants to face."""


class Stage:
    """Bodies that come, walk, stand, face and go, one frame for every `n_steps_a_frame` steps.

    Args:
        steering: what moves them.
        clock: whom to tell of arrivals.
        n_frames: length of the film.
        n_steps_a_frame: steps of the steering between two frames.
    """

    def __init__(self, steering: Steering, clock: Clock, n_frames: int, n_steps_a_frame: int) -> None:
        n_agents = len(steering.positions_m)
        self.steering = steering
        self.clock = clock
        self.present = np.zeros(n_agents, dtype=bool)
        self._facing_rad = np.zeros(n_agents)
        self._heading_rad = np.zeros(n_agents)
        self._under_way = np.zeros(n_agents, dtype=bool)
        self._arrival = [Signal(happened=True) for _ in range(n_agents)]
        self._n_steps_a_frame = n_steps_a_frame
        self._positions_m = np.zeros((n_frames, n_agents, 2), dtype=np.float32)
        self._headings_rad = np.zeros((n_frames, n_agents), dtype=np.float32)
        self._present = np.zeros((n_frames, n_agents), dtype=bool)

    def position_m(self, agent: int) -> tuple[float, float]:
        """Where an agent is."""
        x_m, y_m = self.steering.positions_m[agent].tolist()
        return x_m, y_m

    def appear(self, agent: int, slot: Slot, speed_mps: float) -> None:
        """Lets an absent agent stand in a slot."""
        self.steering.add(agent, slot.position_m, speed_mps)
        self.present[agent] = True
        self._facing_rad[agent] = self._heading_rad[agent] = slot.facing_rad

    def vanish(self, agent: int) -> None:
        """Takes an agent out of the scene."""
        if self.present[agent]:
            self.stop(agent)
            self.steering.remove(agent)
            self.present[agent] = False

    def send(self, agent: int, slot: Slot, target: Target | None = None) -> Signal:
        """Sends an agent to a slot, or to a target there, and gives back its arrival.

        Who was sent elsewhere before, arrives here now.
        """
        if not self._under_way[agent]:
            self._arrival[agent] = Signal()
            self._under_way[agent] = True
        self.steering.set_target(agent, target or Target(slot.position_m))
        self._facing_rad[agent] = slot.facing_rad
        return self._arrival[agent]

    def arrival(self, agent: int) -> Signal:
        """The end of the walk that an agent is on, or was on last."""
        return self._arrival[agent]

    def stop(self, agent: int) -> None:
        """Ends a walk here and now; that is its arrival."""
        if self._under_way[agent]:
            self.steering.hold(agent)
            self._arrive(agent)

    def face(self, agent: int, facing_rad: float) -> None:
        """Turns an agent, as soon as it stands."""
        self._facing_rad[agent] = facing_rad

    def facing_rad(self, agent: int) -> float:
        """Where an agent faces, or will as soon as it stands."""
        return float(self._facing_rad[agent])

    def play(self) -> None:
        """Lets the world run from its beginning to the last frame."""
        n_steps = (len(self._present) - 1) * self._n_steps_a_frame
        for step in tqdm(range(n_steps + 1), desc="moving", unit="step", disable=None, leave=False):
            self.clock.advance(round(step * self.steering.dt_s, 6))
            if step % self._n_steps_a_frame == 0:
                self._film(step // self._n_steps_a_frame)
            self.steering.step()
            self._turn()
            for agent in np.flatnonzero(self._under_way & ~self.steering.walking).tolist():
                self._arrive(agent)

    def motion(self, executed: tuple[Executed, ...]) -> Motion:
        """The film, with what was done in it."""
        first = self._present.argmax(axis=0)
        before = np.arange(len(self._present))[:, None] < first
        # Who has not come yet is where they will come in.
        self._positions_m = np.where(
            before[..., None], self._positions_m[first, np.arange(len(first))], self._positions_m
        )
        headings_rad = (self._headings_rad + np.pi) % (2 * np.pi) - np.pi
        dt_s = round(self.steering.dt_s * self._n_steps_a_frame, 6)
        return Motion(dt_s, self._positions_m, headings_rad, self._present, executed)

    def _arrive(self, agent: int) -> None:
        self._under_way[agent] = False
        self.clock.fire(self._arrival[agent])

    def _turn(self) -> None:
        wanted_rad = np.where(self.steering.walking, self.steering.headings_rad, self._facing_rad)
        turn_rad = (wanted_rad - self._heading_rad + np.pi) % (2 * np.pi) - np.pi
        most_rad = _TURN_RADPS * self.steering.dt_s
        self._heading_rad += np.clip(turn_rad, -most_rad, most_rad)

    def _film(self, frame: int) -> None:
        self._positions_m[frame] = self.steering.positions_m
        self._headings_rad[frame] = self._heading_rad
        self._present[frame] = self.present
