/** The activity table of a world file (docs/formats.md, "activities.csv"). */

import { parseCsv } from "./csv";
import { ACTIONS, type Action, type Activity, type Status } from "./world";

const COLUMNS = [
  ...["agent", "step", "action", "location", "occasion", "partners", "implied"],
  ...["plan_x_m", "plan_y_m", "plan_facing_rad", "plan_leave_s", "plan_start_s", "plan_end_s"],
  ...["status", "leave_s", "arrive_s", "start_s", "end_s", "x_m", "y_m", "facing_rad"],
] as const;
type Column = (typeof COLUMNS)[number];
type Cells = (column: Column) => string;

/** The activities of each person, in order. `places` maps the names of the locations to their numbers. */
export function readActivities(text: string, places: ReadonlyMap<string, number>, nAgents: number): Activity[][] {
  const [header, ...rows] = parseCsv(text);
  const columns = new Map(header?.map((name, i) => [name, i]));
  const missing = COLUMNS.find((name) => !columns.has(name));
  if (missing !== undefined) throw new Error(`activities.csv has no column ${missing}`);
  const people: Activity[][] = Array.from({ length: nAgents }, () => []);
  for (const row of rows) {
    const activity = readRow((column) => row[columns.get(column)!] ?? "", places, nAgents);
    const own = people[activity.agent]!;
    if (activity.step !== own.length)
      throw new Error(`step ${activity.step} of person ${activity.agent} is out of order`);
    own.push(activity);
  }
  return people;
}

function readRow(cells: Cells, places: ReadonlyMap<string, number>, nAgents: number): Activity {
  const status = readStatus(cells("status"));
  const place = status === null ? "plan_" : "";
  const location = places.get(cells("location"));
  if (location === undefined)
    throw new Error(`activities.csv names a location '${cells("location")}' that is not there`);
  return {
    agent: agentNumber(cells("agent"), nAgents),
    step: Number(cells("step")),
    action: readAction(cells("action")),
    location,
    occasion: Number(cells("occasion")),
    partners: cells("partners")
      .split(" ")
      .filter((name) => name !== "")
      .map((name) => agentNumber(name, nAgents)),
    implied: cells("implied") === "1",
    planStart: seconds(cells("plan_start_s")),
    planEnd: seconds(cells("plan_end_s")),
    status,
    leave: seconds(cells("leave_s")),
    arrive: seconds(cells("arrive_s")),
    start: seconds(cells("start_s")),
    end: seconds(cells("end_s")),
    x: Number(cells(`${place}x_m`)),
    y: Number(cells(`${place}y_m`)),
    facing: Number(cells(`${place}facing_rad`)),
  };
}

function agentNumber(cell: string, nAgents: number): number {
  const agent = cell === "" ? Number.NaN : Number(cell);
  if (!(Number.isInteger(agent) && agent >= 0 && agent < nAgents))
    throw new Error(`activities.csv names a person '${cell}'`);
  return agent;
}

/** An empty cell is a time that did not come. */
function seconds(cell: string): number {
  const value = cell === "" ? Number.NaN : Number(cell);
  if (cell !== "" && Number.isNaN(value)) throw new Error(`activities.csv has a time '${cell}'`);
  return value;
}

function readAction(cell: string): Action {
  const action = ACTIONS.find((known) => known === cell);
  if (action === undefined) throw new Error(`activities.csv has an action '${cell}'`);
  return action;
}

function readStatus(cell: string): Status {
  if (cell === "") return null;
  if (cell === "done" || cell === "timeout" || cell === "cut") return cell;
  throw new Error(`activities.csv has a status '${cell}'`);
}
