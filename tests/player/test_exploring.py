"""Finding people, groups and places, and what the panels say of them, against the plan."""

from __future__ import annotations

import json
from collections import Counter

import pytest
from browsing import until

# Points of the page at which somebody stands, apart from the panels.
SOMEBODY = """() => {
  for (let y = 120; y < innerHeight - 90; y += 3)
    for (let x = 20; x < innerWidth - 20; x += 3) {
      if (document.elementFromPoint(x, y)?.tagName !== "CANVAS") continue;
      const { agent } = genc.pick(x, y);
      if (agent !== null && genc.pick(x + 1, y + 1).agent === agent) return [x + 1, y + 1, agent];
    }
  return null;
}"""


def test_a_click_on_a_person_in_the_scene_tells_of_that_person(visit, world):
    page = visit("t=90&view=top")
    page.wait_for_timeout(1500)
    x, y, agent = page.evaluate(SOMEBODY)
    page.mouse.click(x, y)
    assert page.evaluate("genc.selected") == agent
    panel = page.get_by_label("In focus")
    assert panel.get_by_role("heading", name=f"Person {agent}", exact=True).is_visible()
    assert f"Group {world.plan.people[agent].group}" in panel.inner_text()
    page.keyboard.press("Escape")
    assert page.evaluate("genc.selected") is None
    assert panel.is_hidden()


def test_pointing_at_a_person_tells_what_they_do(visit):
    page = visit("t=90&view=top")
    page.wait_for_timeout(1500)
    x, y, agent = page.evaluate(SOMEBODY)
    page.mouse.move(x - 1, y)
    page.wait_for_timeout(150)
    page.mouse.move(x, y)
    label = page.locator(".hover")
    label.wait_for(state="visible")
    assert label.inner_text().startswith(f"Person {agent} ")


def test_the_panel_lists_every_activity_with_its_time(visit, world):
    agent = _busy(world)
    page = visit(f"t=90&agent={agent}")
    rows = page.locator(".activities li")
    activities = world.plan.people[agent].activities
    assert rows.count() == len(activities)
    done = {row.step: row for row in world.motion.executed if row.agent == agent}
    for step, activity in enumerate(activities):
        said = rows.nth(step).inner_text()
        assert activity.action.value in said
        assert world.plan.environment.locations[activity.location].name in said
        if step in done and done[step].start_s == done[step].start_s:
            assert said.startswith(_clock(done[step].start_s))
    current = page.locator(".activities li[data-state=now]")
    now = [row for row in done.values() if row.leave_s <= 90 and not row.end_s <= 90]
    assert current.count() == len(now)


def test_an_activity_a_piece_of_the_plan_and_a_chip_lead_on(visit, world):
    agent = _busy(world)
    page = visit(f"t=0&agent={agent}")
    first = next(row for row in world.motion.executed if row.agent == agent and row.start_s > 0)
    page.locator(".activities li").nth(first.step).get_by_role("button").click()
    assert page.evaluate("genc.time") == pytest.approx(first.start_s)
    box = page.locator(".strip").bounding_box()
    page.mouse.click(box["x"] + box["width"] * 0.75, box["y"] + 5)
    assert page.evaluate("genc.time") == pytest.approx(135, abs=2)
    chip = page.locator(".chip").first
    other = int(chip.inner_text().split()[-1])
    chip.click()
    assert page.evaluate("genc.selected") == other


def test_search_finds_people_groups_places_and_actions(visit, world):
    page = visit("t=90")
    page.keyboard.press("/")
    box = page.get_by_role("combobox")
    box.fill("person 12")
    page.keyboard.press("Enter")
    assert page.evaluate("genc.selected") == 12
    assert page.get_by_role("button", name="Follow").get_attribute("aria-pressed") == "true"
    place = world.plan.environment.locations[0].name
    for words, title in ((place, place), ("group 2", "Group 2"), ("wander", "wander")):
        page.keyboard.press("/")
        box.fill(words)
        page.keyboard.press("Enter")
        page.get_by_label("In focus").get_by_role("heading", name=title, exact=True).wait_for()
    page.keyboard.press("/")
    box.fill("1")
    page.keyboard.press("ArrowDown")
    second = page.get_by_role("option", selected=True).inner_text().split("\n")[0]
    page.keyboard.press("Enter")
    assert f"Person {page.evaluate('genc.selected')}" == second
    page.keyboard.press("/")
    box.fill("no such thing at all")
    assert "Nothing of that name" in page.locator(".hits").inner_text()


def test_the_action_panel_counts_who_does_it_now(visit, world):
    action = Counter(_acting(world, 90.0).values()).most_common(1)[0][0]
    page = visit("t=90")
    page.keyboard.press("/")
    page.get_by_role("combobox").fill(action)
    page.keyboard.press("Enter")
    n = sum(other == action for other in _acting(world, 90.0).values())
    assert page.locator(".panel .told").inner_text() == f"{n} {'person' if n == 1 else 'people'} at it"


def test_the_graph_of_a_group_has_the_nodes_and_edges_of_the_plan(visit, world):
    for group in _largest_groups(world, 3):
        page = visit(f"t=90&group={group}")
        members = [i for i, person in enumerate(world.plan.people) if person.group == group]
        rows = [[a for a in world.plan.people[i].activities if not a.implied] for i in members]
        at = Counter(activity.occasion for row in rows for activity in row)
        graph = page.get_by_label("Crowd scenario graph", exact=True)
        assert graph.locator(".node").count() == sum(map(len, rows))
        assert graph.locator(".edge.sequence").count() == sum(max(len(row) - 1, 0) for row in rows)
        assert graph.locator(".edge.share").count() == sum(n * (n - 1) // 2 for n in at.values())
        assert graph.locator(".row-name").count() == len(members)


def test_the_graph_marks_what_goes_on_and_leads_to_it(visit, world):
    group = _largest_groups(world, 1)[0]
    page = visit(f"t=90&group={group}")
    going_on = {(row.agent, row.step) for row in world.motion.executed if row.start_s <= 90 and not row.end_s <= 90}
    people = world.plan.people
    expected = sum(people[a].group == group and not people[a].activities[s].implied for a, s in going_on)
    assert page.locator(".node[data-state=do]").count() == expected
    node = page.locator(".node").first
    agent = int(node.get_attribute("data-agent"))
    node.focus()
    page.keyboard.press("Enter")
    assert page.evaluate("genc.selected") == agent
    page.keyboard.press("g")
    assert page.get_by_label("Crowd scenario graph", exact=True).is_hidden()


def test_the_panel_follows_the_time(visit, world):
    agent = _busy(world)
    page = visit(f"t=0&agent={agent}")
    before = page.locator(".panel .told").inner_text()
    page.evaluate("genc.seek(179)")
    told = "document.querySelector('.panel .told').textContent"
    until(page, f"{told} !== {json.dumps(before)}")


@pytest.mark.parametrize("size", [(1280, 720), (1280, 800), (1920, 1080), (3840, 2160)])
def test_nothing_lies_on_anything_else(visit, world, size):
    page = visit(f"t=90&agent={_busy(world)}", size=size)
    page.get_by_role("button", name="More about this world").click()
    parts = [".tools", ".panel", ".graph", ".dock"]
    boxes = [page.locator(part).bounding_box() for part in parts]
    for part, box in zip(parts, boxes, strict=True):
        assert 0 <= box["x"] <= box["x"] + box["width"] <= size[0], part
        assert 0 <= box["y"] <= box["y"] + box["height"] <= size[1], part
    pairs = [(i, j) for i in range(len(parts)) for j in range(i)]
    assert not [(parts[i], parts[j]) for i, j in pairs if _meet(boxes[i], boxes[j])]
    assert not _meet(page.locator(".header").bounding_box(), boxes[0])


def _busy(world):
    """Somebody who does something with others."""
    return max(
        range(len(world.plan.people)),
        key=lambda agent: (
            sum(bool(a.partners) for a in world.plan.people[agent].activities),
            sum(row.agent == agent for row in world.motion.executed),
        ),
    )


def _largest_groups(world, n):
    return [group for group, _ in Counter(person.group for person in world.plan.people).most_common(n)]


def _acting(world, time_s):
    """For everybody in sight who does something at a time, what."""
    frame = round(time_s / world.motion.dt_s)
    return {
        row.agent: world.plan.people[row.agent].activities[row.step].action.value
        for row in world.motion.executed
        if row.start_s <= time_s and not row.end_s <= time_s and world.motion.present[frame, row.agent]
    }


def _meet(a, b):
    apart = a["x"] + a["width"] <= b["x"] or b["x"] + b["width"] <= a["x"]
    return not (apart or a["y"] + a["height"] <= b["y"] or b["y"] + b["height"] <= a["y"])


def _clock(time_s):
    return f"{int(time_s + 1e-6) // 60:02d}:{int(time_s + 1e-6) % 60:02d}"
