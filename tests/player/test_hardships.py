"""What goes wrong: damaged files, hostile texts, a browser without 3D; and files that are dropped on the page."""

from __future__ import annotations

import base64
import re
from dataclasses import replace
from importlib.resources import files
from pathlib import Path

import pytest
from browsing import PATIENCE_MS, paged, until

EVIL = "<img src=x onerror=\"document.title='owned'\"></script><script>document.title='owned'</script>"


def _holding(page_file: Path, content: str, out: Path) -> Path:
    """The page with something else in place of its world."""
    page = page_file.read_text(encoding="utf-8")
    out.write_text(re.sub(r'(id="world">)[^<]*', lambda found: found[1] + content, page), encoding="utf-8")
    return out


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda held: held[: len(held) // 2 // 4 * 4], "cut short or damaged"),
        (lambda held: held[:9000] + "AAAAAAAA" + held[9008:], "damaged"),
        (lambda held: "!!" + held, "damaged"),
        (lambda _: base64.b64encode(b"hello").decode(), "not a world file"),
    ],
)
def test_a_damaged_world_is_told_in_one_line(visit, page_file, tmp_path, spoil, said):
    held = base64.b64encode((page_file.parent / "world.genc").read_bytes()).decode()
    page = visit(path=_holding(page_file, spoil(held), tmp_path / "w.html"))
    alert = page.get_by_role("alert")
    assert said in alert.inner_text()
    assert alert.locator("p").inner_text().count("\n") == 0


def test_what_a_world_says_is_text_and_never_markup(visit, world, tmp_path):
    places = world.plan.environment.locations
    named = tuple(replace(place, name=f"{EVIL} {i}") for i, place in enumerate(places))
    plan = replace(
        world.plan,
        environment=replace(world.plan.environment, locations=named),
        captions=tuple(f"{EVIL} {i}" for i in range(len(world.plan.captions))),
        notes=(EVIL,),
    )
    page = visit("t=90&agent=2", path=paged(replace(world, plan=plan, provenance={"text": EVIL}), tmp_path))
    page.get_by_role("button", name="More about this world").click()
    page.keyboard.press("/")
    page.get_by_role("combobox").fill("img")
    assert page.locator("img").count() == 0
    assert page.title() == EVIL
    assert EVIL in page.locator("h1").inner_text()


def test_without_3d_there_is_a_map_and_the_panels_work(launch, page_file):
    browser = launch("--disable-3d-apis")
    page = browser.new_page()
    page.set_default_timeout(PATIENCE_MS)
    page.goto(f"{page_file.as_uri()}#t=90&agent=2")
    page.wait_for_selector("html[data-ready='1']")
    assert "cannot draw in 3D" in page.locator(".notice").inner_text()
    assert page.get_by_role("heading", name="Person 2", exact=True).is_visible()
    page.keyboard.press("Space")
    until(page, "genc.time > 90.2")


def test_the_player_without_a_world_asks_for_one_and_plays_it(visit, page_file):
    page = visit(path=Path(str(files("genc.world").joinpath("player", "index.html"))))
    assert "Drop a world file here" in page.get_by_role("alert").inner_text()
    page.get_by_label("Choose a world file").set_input_files(page_file.parent / "world.genc")
    until(page, "window.genc && genc.duration === 180")
    page.get_by_role("slider", name="Time").wait_for()


def test_a_file_dropped_on_the_page_takes_the_place_of_its_world(visit, page_file):
    page = visit("t=90")
    held = base64.b64encode((page_file.parent / "world.genc").read_bytes()).decode()
    drop = """([held, name]) => {
      const data = new DataTransfer();
      data.items.add(new File([Uint8Array.from(atob(held), (c) => c.charCodeAt(0))], name));
      for (const kind of ["dragover", "drop"])
        dispatchEvent(new DragEvent(kind, { dataTransfer: data, cancelable: true }));
    }"""
    page.evaluate("window.before = genc")
    page.evaluate(drop, [held, "other.genc"])
    until(page, "genc !== before")
    assert page.locator("canvas").count() == 2  # the scene and the strip of the time line: the old ones are gone
    page.evaluate(drop, [base64.b64encode(b"no world").decode(), "odd.genc"])
    page.get_by_role("alert").wait_for()
    assert "not a world file" in page.get_by_role("alert").inner_text()
