"""The activity table: for everything that anybody was to do, the plan and what became of it, one row each.

`docs/formats.md` describes every column.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Iterator, Sequence

from genc.motion.motion import Executed, Status
from genc.plan.plan import Activity, CrowdPlan, Slot
from genc.scenario.scenario import Environment
from genc.words.vocabulary import Action

PLANNED = (
    *("agent", "step", "action", "location", "occasion", "partners", "implied"),
    *("plan_x_m", "plan_y_m", "plan_facing_rad", "plan_leave_s", "plan_start_s", "plan_end_s"),
)
REAL = ("status", "leave_s", "arrive_s", "start_s", "end_s", "x_m", "y_m", "facing_rad")
COLUMNS = (*PLANNED, *REAL)


def write_table(plan: CrowdPlan, executed: Iterable[Executed]) -> str:
    """The table as CSV with a header, ordered by agent, then step.

    A cell is empty where there is nothing to say: a time that the end of the world did not let come, every real
    column of an activity that was never set off for.
    """
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(table_rows(plan, executed))
    return text.getvalue()


def table_rows(plan: CrowdPlan, executed: Iterable[Executed]) -> Iterator[tuple[object, ...]]:
    """The rows of the table: a cell for each of `COLUMNS`, "" for an empty one."""
    real = {(done.agent, done.step): done for done in executed}
    for agent, person in enumerate(plan.people):
        for step, activity in enumerate(person.activities):
            name = plan.environment.locations[activity.location].name
            yield (agent, step, *_planned_cells(activity, name), *_real_cells(real.get((agent, step))))


def read_table(text: str, environment: Environment, n_agents: int) -> tuple[list[list[Activity]], list[Executed]]:
    """The planned activities of each agent, and the executed ones.

    Raises:
        ValueError, LookupError: for a text that is no such table.
    """
    rows = csv.reader(io.StringIO(text, newline=""))
    if tuple(next(rows, ())) != COLUMNS:
        raise ValueError("the activity table has other columns")
    index = {location.name: i for i, location in enumerate(environment.locations)}
    activities: list[list[Activity]] = [[] for _ in range(n_agents)]
    executed: list[Executed] = []
    for cells in rows:
        agent, step = int(cells[0]), int(cells[1])
        if step != len(activities[agent]):
            raise ValueError(f"step {step} of agent {agent} is out of order in the activity table")
        activities[agent].append(_activity(cells[2 : len(PLANNED)], index))
        if cells[len(PLANNED)]:
            executed.append(_executed(agent, step, cells[len(PLANNED) :]))
    return activities, executed


def _planned_cells(activity: Activity, location: str) -> Iterator[object]:
    yield from (activity.action.value, location, activity.occasion, " ".join(map(str, activity.partners)))
    yield int(activity.implied)
    yield from (*activity.slot.position_m, activity.slot.facing_rad)
    yield from (activity.leave_s, activity.start_s, activity.end_s)


def _activity(cells: Sequence[str], index: dict[str, int]) -> Activity:
    action, location, occasion, partners, implied = cells[:5]
    x_m, y_m, facing_rad, leave_s, start_s, end_s = map(float, cells[5:])
    return Activity(
        action=Action(action),
        location=index[location],
        slot=Slot((x_m, y_m), facing_rad),
        leave_s=leave_s,
        start_s=start_s,
        end_s=end_s,
        occasion=int(occasion),
        partners=tuple(map(int, partners.split())),
        implied=implied == "1",
    )


def _real_cells(done: Executed | None) -> Iterable[object]:
    if done is None:
        return [""] * len(REAL)
    times_s = (done.leave_s, done.arrive_s, done.start_s, done.end_s)
    cells = ("" if math.isnan(t_s) else t_s for t_s in times_s)
    return (done.status.value, *cells, *done.position_m, done.facing_rad)


def _executed(agent: int, step: int, cells: Sequence[str]) -> Executed:
    leave_s, arrive_s, start_s, end_s, x_m, y_m, facing_rad = (float(c) if c else math.nan for c in cells[1:])
    return Executed(agent, step, leave_s, arrive_s, start_s, end_s, (x_m, y_m), facing_rad, Status(cells[0]))
