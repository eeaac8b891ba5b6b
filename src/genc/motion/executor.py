"""The executor: a plan carried out in closed loop.

Nothing begins because the clock says so alone: a doing begins when all its people have really arrived, at a service
when it is their turn, and never before the plan would have it (the plan knows what must come first). Who is early
waits in sight; who is late is waited for, up to a limit.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from genc.motion.clock import Clock, Errand, Life, Wait
from genc.motion.line import Line, Party
from genc.motion.motion import Motion, Status
from genc.motion.occasion import Occasion, Row, occasions
from genc.motion.spots import Spots
from genc.motion.stage import Stage
from genc.motion.steering import Steering, Target
from genc.motion.stroll import LONGEST_PAUSE_S, PACES, Strolls
from genc.plan.plan import ROAMING, Activity, CrowdPlan, Person, Slot, begins_on_the_way
from genc.plan.slots import Places
from genc.plan.walkable import Walkable, is_solid
from genc.words.vocabulary import Action, Category

_SLOWEST = 4.0
"""How many times as long as the straight way a walk may take, beside `_LOST_S`, before it counts as failed."""
_LOST_S = 60.0
_EXACTLY_M = 0.05
_NEAR_DOOR_M = 0.8
_NEAR_LINE_M = 1.2
"""Who comes so near to the end of a line stands in it, and is sent to their own place."""
_NEAR_SPOT_M = 1.0
"""From so near one sees whether somebody stands in one's slot, and looks for room beside."""
_STROLL_M = 0.4
_AT_ONCE_S = 5.0
"""Who goes on being served within this time keeps the service slot."""
_PASSING = (Action.ENTER_EXIT, *ROAMING)
"""Doings that take up no slot."""


@dataclass(frozen=True)
class Options:
    """How a plan is carried out.

    Attributes:
        patience_s: how long a late partner is waited for, counted from the planned beginning or from one's own
            arrival, whichever is later.
        patience_in_line_s: how much longer than planned one stands in a line at which one wants no service. Who
            wants to be served stays.
        n_steps_a_frame: steps of the steering for each stored frame; with the built-in one, a frame every 0.2 s.
    """

    patience_s: float = 180.0
    patience_in_line_s: float = 120.0
    n_steps_a_frame: int = 2


def simulate(
    plan: CrowdPlan,
    walkable: Walkable,
    places: Sequence[Places],
    steering: Steering,
    options: Options,
    rng: np.random.Generator,
) -> Motion:
    """What becomes of a plan: where everybody is at every frame, and what they really do.

    Args:
        plan: who is to do what, where and when.
        walkable: the free ground of the plan's environment.
        places: for each location, its service slots and its line.
        steering: what moves the people; made for as many as the plan has.
        options: patience and frame rate.
        rng: decides where people who wander turn next.
    """
    return _Play(plan, walkable, places, steering, options, rng).run()


class _Play:
    """One run: the lives of all people, and the occasions at which they meet."""

    def __init__(
        self,
        plan: CrowdPlan,
        walkable: Walkable,
        places: Sequence[Places],
        steering: Steering,
        options: Options,
        rng: np.random.Generator,
    ) -> None:
        self.plan = plan
        self.options = options
        self.clock = Clock()
        n_frames = 1 + int(plan.duration_s / (steering.dt_s * options.n_steps_a_frame) + 1e-6)
        self.stage = Stage(steering, self.clock, n_frames, options.n_steps_a_frame)
        kept_free = [slot for place in places for slot in place.service]
        self.spots = Spots(len(plan.people), walkable, kept_free)
        self.strolls = Strolls(plan.environment, walkable, rng)
        self.lines = [Line(place.line, place.service, self._stand_in_line, self.clock.fire) for place in places]
        self.service = [{slot.position_m for slot in place.service} for place in places]
        self.solid = [
            solid and place.category is Category.BUILDING
            for place, solid in zip(plan.environment.locations, is_solid(plan.environment), strict=True)
        ]
        self.occasions = occasions(plan)
        self.rows: list[Row] = []
        self.inside: dict[int, int] = {}

    def run(self) -> Motion:
        """Lets everybody live until the world ends."""
        for agent, person in enumerate(self.plan.people):
            if person.activities:
                self.clock.start(self._life(agent, person))
        self.stage.play()
        for row in self.rows:
            if math.isnan(row.start_s):
                row.position_m, row.facing_rad = self.stage.position_m(row.agent), self.stage.facing_rad(row.agent)
        self.rows.sort(key=lambda row: (row.agent, row.step))
        return self.stage.motion(tuple(row.executed() for row in self.rows))

    # What one person goes through.

    def _life(self, agent: int, person: Person) -> Life:
        yield Wait(until_s=person.activities[0].leave_s)
        self._come(agent, person)
        for step, activity in enumerate(person.activities):
            occasion = self.occasions[activity.occasion]
            row = Row(agent, step, self.clock.now_s)
            self.rows.append(row)
            arrived = yield from self._go(agent, step, activity)
            row.arrive_s = self.clock.now_s
            yield from self._meet(agent, occasion)
            row.start_s = self.clock.now_s
            row.position_m, row.facing_rad = self.stage.position_m(agent), self.stage.facing_rad(agent)
            yield Wait(occasion.over)
            row.end_s = self.clock.now_s
            if self._is_on_the_way(agent, step):
                row.position_m, row.facing_rad = self.stage.position_m(agent), self.stage.facing_rad(agent)
            row.status = Status.DONE if arrived and not occasion.timed_out else Status.TIMEOUT
        self._end(agent, person)

    def _come(self, agent: int, person: Person) -> None:
        first = person.activities[0]
        slot = self.lines[first.location].tail() if self._lines_up(agent, 0) else self.spots.take(agent, first.slot)
        self.stage.appear(agent, slot, person.speed_mps)

    def _go(self, agent: int, step: int, activity: Activity) -> Errand:
        """Brings a person to where the activity is."""
        if self.inside.get(agent) == activity.location or self._is_on_the_way(agent, step):
            return True
        self._come_out(agent)
        self.spots.give_back(agent)
        line, company = self.lines[activity.location], self._company(agent, step)
        if agent in line.served:
            return (yield from self._walk(agent, line.served[agent]))
        if self._waits_in_line(agent, self.occasions[activity.occasion]):
            return (yield from self._walk(agent, line.tail(), company, _NEAR_LINE_M))
        if activity.action in _PASSING:
            return (yield from self._walk(agent, activity.slot, company, _NEAR_DOOR_M))
        arrived = yield from self._walk(agent, activity.slot, company, _NEAR_SPOT_M)
        return (yield from self._walk(agent, self.spots.take(agent, activity.slot))) and arrived

    def _company(self, agent: int, step: int) -> Hashable:
        """Who come from the same doing and go to the same place walk together."""
        activities = self.plan.people[agent].activities
        if step == 0 or not activities[step - 1].partners:
            return None
        return activities[step - 1].occasion, activities[step].location

    def _is_on_the_way(self, agent: int, step: int) -> bool:
        activities = self.plan.people[agent].activities
        return step > 0 and begins_on_the_way(activities[step - 1], activities[step])

    def _walk(self, agent: int, slot: Slot, company: Hashable = None, near_m: float = _EXACTLY_M) -> Errand:
        """Walks to a slot; False if it takes so long that the way must be lost. Then one stays where one is."""
        here_m = self.stage.position_m(agent)
        if here_m == slot.position_m:
            self.stage.face(agent, slot.facing_rad)
            return True
        shortest_s = math.dist(here_m, slot.position_m) / self.plan.people[agent].speed_mps
        limit_s = self.clock.now_s + _SLOWEST * shortest_s + _LOST_S
        target = Target(slot.position_m, company=company, near_m=near_m)
        arrived = yield Wait(self.stage.send(agent, slot, target), limit_s)
        self.stage.stop(agent)
        return arrived

    def _meet(self, agent: int, occasion: Occasion) -> Life:
        """Waits for the others and for the beginning; who comes too late finds it begun, or over."""
        if not occasion.gathered.happened:
            if not occasion.here:
                self.clock.start(self._conduct(occasion))
            occasion.here.append(agent)
            if len(occasion.here) == len(occasion.steps):
                self.clock.fire(occasion.gathered)
            elif self._waits_in_line(agent, occasion):
                self.lines[occasion.activity.location].gather(agent)
            limit_s = max(self.clock.now_s, occasion.activity.start_s) + self.options.patience_s
            yield Wait(occasion.gathered, limit_s)
            if not occasion.gathered.happened:
                occasion.timed_out = True
                self.clock.fire(occasion.gathered)
        yield Wait(occasion.begun)

    def _end(self, agent: int, person: Person) -> None:
        """What becomes of a person whose plan is done: gone, or in nobody's way."""
        if person.leaves:
            self.spots.give_back(agent)
            self.stage.vanish(agent)
        elif self._lines_up(agent, len(person.activities) - 1):
            last = person.activities[-1].slot
            here = Slot(self.stage.position_m(agent), last.facing_rad)
            self.stage.send(agent, self.spots.take(agent, self.spots.beside(here)))

    # What an occasion goes through.

    def _conduct(self, occasion: Occasion) -> Life:
        yield Wait(occasion.gathered)
        agents, activity = tuple(occasion.here), occasion.activity
        if activity.action is Action.QUEUE:
            yield from self._queue(occasion)
        elif any(self._lines_up(agent, occasion.steps[agent]) for agent in agents):
            yield from self._serve(occasion)
        elif any(self._is_on_the_way(agent, occasion.steps[agent]) for agent in agents):
            self._begin(occasion)
            yield from self._walk_on(occasion)
        else:
            yield Wait(until_s=activity.start_s)
            self._begin(occasion)
            if activity.action in ROAMING and not self.inside.keys() & set(agents):
                yield from self._stroll(occasion)
            else:
                yield Wait(until_s=self.clock.now_s + occasion.duration_s)
        self.clock.fire(occasion.over)

    def _queue(self, occasion: Occasion) -> Life:
        """Stands in line until it is their turn."""
        agents, line = tuple(occasion.here), self.lines[occasion.activity.location]
        following = {agent: occasion.steps[agent] + 1 for agent in agents if self._next_is_service(agent, occasion)}
        party = Party(agents, self._wishes(following))
        line.join(party)
        yield Wait(until_s=occasion.activity.start_s)
        self._begin(occasion)
        until_s = self.clock.now_s + occasion.duration_s
        line.let(party)
        if party.customers:
            yield Wait(party.turn)
            return
        limit_s = until_s + self.options.patience_in_line_s
        yield Wait(party.turn, limit_s)
        yield Wait(self.stage.arrival(agents[0]), limit_s)
        yield Wait(until_s=until_s)
        occasion.timed_out |= not party.turn.happened
        line.leave(party)

    def _serve(self, occasion: Occasion) -> Life:
        """Waits for a service slot, if nobody has one yet, is served, and makes room for the next."""
        agents, line = tuple(occasion.here), self.lines[occasion.activity.location]
        if not any(agent in line.served for agent in agents):
            served = {agent: occasion.steps[agent] for agent in agents if self._lines_up(agent, occasion.steps[agent])}
            party = Party(agents, self._wishes(served))
            line.join(party)
            yield Wait(until_s=occasion.activity.start_s)
            line.let(party)
            yield Wait(party.turn)
            yield from self._step_up(occasion, line)
        self._begin(occasion)
        yield Wait(until_s=self.clock.now_s + occasion.duration_s)
        for agent in agents:
            if not self._stays_served(agent, occasion):
                line.release(agent)

    def _stand_in_line(self, agent: int, slot: Slot, fits: bool) -> None:
        """Sends somebody to their place in a line, or to room about its end."""
        if fits:
            self.spots.hold(agent, slot)
            self.stage.send(agent, slot)
        else:
            self.stage.send(agent, self.spots.take(agent, slot))

    def _step_up(self, occasion: Occasion, line: Line) -> Life:
        """Brings a party from the line to the service slots; who has none stands beside."""
        arrivals = []
        for agent in occasion.here:
            planned = self.plan.people[agent].activities[occasion.steps[agent]].slot
            self.spots.give_back(agent)
            slot = line.served[agent] if agent in line.served else self.spots.take(agent, planned)
            arrivals.append(self.stage.send(agent, slot))
        for arrival in arrivals:
            yield Wait(arrival, self.clock.now_s + _LOST_S)

    def _walk_on(self, occasion: Occasion) -> Life:
        """Walks to the planned slots while doing what is to be done, and goes on doing it there."""
        end_s = self.clock.now_s + occasion.duration_s
        arrivals = []
        for agent in occasion.here:
            self._come_out(agent)
            slot = self.spots.take(agent, self.plan.people[agent].activities[occasion.steps[agent]].slot)
            arrivals.append(self.stage.send(agent, slot, Target(slot.position_m, company=id(occasion))))
        for arrival in arrivals:
            yield Wait(arrival, end_s + _LOST_S)
        yield Wait(until_s=end_s)

    def _stroll(self, occasion: Occasion) -> Life:
        """Goes from point to point, together, and is at the planned slot when the time is over."""
        agents, end_s = tuple(occasion.here), self.clock.now_s + occasion.duration_s
        home = [self.plan.people[agent].activities[occasion.steps[agent]].slot for agent in agents]
        pace = PACES[occasion.activity.action]
        pace_mps = pace * self.plan.people[agents[0]].speed_mps
        while not self.clock.is_past(end_s):
            here_m = [self.stage.position_m(agent) for agent in agents]
            goals = self.strolls.next(occasion.activity.location, here_m)
            goal_m = goals[0].position_m
            there_and_home_s = (math.dist(here_m[0], goal_m) + math.dist(goal_m, home[0].position_m)) / pace_mps
            is_last = self.clock.is_past(end_s - there_and_home_s - LONGEST_PAUSE_S)
            for agent, slot in zip(agents, home if is_last else goals, strict=True):
                self.stage.send(agent, slot, Target(slot.position_m, pace, near_m=_EXACTLY_M if is_last else _STROLL_M))
            for agent in agents:
                yield Wait(self.stage.arrival(agent), end_s)
            yield Wait(until_s=end_s if is_last else min(end_s, self.clock.now_s + self.strolls.pause_s()))
        for agent in agents:
            self.stage.stop(agent)

    def _begin(self, occasion: Occasion) -> None:
        if self.solid[occasion.activity.location]:
            self._use_door(occasion)
        self.clock.fire(occasion.begun)

    # Doors.

    def _use_door(self, occasion: Occasion) -> None:
        """Lets people go into a building, or come out, or find each other in it."""
        agents, activity = occasion.here, occasion.activity
        passing = activity.action is Action.ENTER_EXIT
        anybody_inside = any(self.inside.get(agent) == activity.location for agent in agents)
        for agent in agents:
            if passing and agent in self.inside:
                self._come_out(agent)
            elif anybody_inside or (passing and not self._comes_from(agent, occasion.steps[agent])):
                self.inside[agent] = activity.location
                self.spots.give_back(agent)
                self.stage.vanish(agent)

    def _comes_from(self, agent: int, step: int) -> bool:
        """Whether a life begins with coming out of a building: it goes on elsewhere."""
        activities = self.plan.people[agent].activities
        return step == 0 < len(activities) - 1 and activities[1].location != activities[0].location

    def _come_out(self, agent: int) -> None:
        if self.inside.pop(agent, None) is not None:
            slot = Slot(self.stage.position_m(agent), self.stage.facing_rad(agent))
            self.stage.appear(agent, slot, self.plan.people[agent].speed_mps)

    # What the plan says about services.

    def _lines_up(self, agent: int, step: int) -> bool:
        """Whether one stands in line for this, or would if the service were busy."""
        activity = self.plan.people[agent].activities[step]
        if activity.action is Action.QUEUE:
            return True
        return activity.action not in _PASSING and activity.slot.position_m in self.service[activity.location]

    def _waits_in_line(self, agent: int, occasion: Occasion) -> bool:
        """Whether one stands in line for an occasion, because nobody of it has a service slot yet."""
        served = self.lines[occasion.activity.location].served
        return self._lines_up(agent, occasion.steps[agent]) and not any(other in served for other in occasion.steps)

    def _next_is_service(self, agent: int, occasion: Occasion) -> bool:
        """Whether the next thing that an agent of this occasion does is to be served here, with nobody else."""
        step = occasion.steps[agent] + 1
        activities = self.plan.people[agent].activities
        if step == len(activities) or activities[step].location != occasion.activity.location:
            return False
        if activities[step].action is Action.QUEUE or not self._lines_up(agent, step):
            return False
        following = self.occasions[activities[step].occasion].steps
        return all(other in occasion.here and occasion.steps[other] + 1 == k for other, k in following.items())

    def _wishes(self, steps: Mapping[int, int]) -> dict[int, Slot]:
        """The service slot that the plan has in mind for each of these activities."""
        return {agent: self.plan.people[agent].activities[step].slot for agent, step in steps.items()}

    def _stays_served(self, agent: int, occasion: Occasion) -> bool:
        if not self._next_is_service(agent, occasion):
            return False
        now, then = self.plan.people[agent].activities[occasion.steps[agent] :][:2]
        return then.start_s - now.end_s < _AT_ONCE_S
