"""`world.html` as a user meets it: it plays, scrubs, and shows what it is asked for in its address."""

from __future__ import annotations

import re

import pytest
from browsing import until


def test_it_plays_by_itself_and_stops_when_told(visit, world):
    page = visit()
    assert page.title() == world.provenance["text"]
    until(page, "genc.playing && genc.time > 0.5")
    page.get_by_role("button", name="Pause").click()
    stopped = page.evaluate("genc.time")
    page.wait_for_timeout(300)
    assert page.evaluate("genc.time") == stopped
    assert page.locator(".clock").inner_text() == f"{_clock(stopped)} / 03:00"


def test_speed_makes_it_faster(visit):
    page = visit("play=1&speed=16")
    until(page, "genc.time > 8")
    page.get_by_role("button", name="Slower").click()
    assert page.get_by_label("Speed").locator("output").inner_text() == "8×"


def test_at_the_end_it_stops_and_plays_again(visit):
    page = visit("t=179.5&play=1")
    page.get_by_role("button", name="Play again").click()
    until(page, "genc.playing && genc.time > 0 && genc.time < 100")


def test_who_wishes_for_less_motion_finds_it_standing(visit):
    page = visit(reduced_motion="reduce")
    page.wait_for_timeout(300)
    assert page.evaluate("[genc.playing, genc.time]") == [False, 0]


def test_the_slider_scrubs_and_keeps_the_pointer(visit):
    page = visit("t=0")
    box = page.get_by_role("slider", name="Time").bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 4, middle)
    page.mouse.down()
    assert page.evaluate("genc.time") == pytest.approx(45, abs=1)
    page.mouse.move(box["x"] + box["width"] / 2, middle - 300)
    assert page.evaluate("genc.time") == pytest.approx(90, abs=1)
    page.mouse.up()
    page.mouse.move(box["x"] + 5, middle)
    assert page.evaluate("genc.time") == pytest.approx(90, abs=1)
    slider = page.get_by_role("slider", name="Time")
    assert slider.get_attribute("aria-valuetext") == f"{_clock(page.evaluate('genc.time'))} of 03:00"


def test_pointing_at_the_strip_tells_how_many_do_what(visit, world):
    page = visit("t=0")
    page.get_by_role("slider", name="Time").hover()
    said = page.locator(".tip").inner_text()
    frame = round(90 / world.motion.dt_s)
    n = int(re.search(r"(\d+) people in sight", said)[1])
    assert n == pytest.approx(int(world.motion.present[frame].sum()), abs=2)


@pytest.mark.parametrize(
    ("keys", "seconds"),
    [
        (["ArrowRight"], 95),
        (["ArrowLeft"], 85),
        (["Shift+ArrowRight"], 120),
        (["Shift+ArrowLeft", "ArrowLeft"], 55),
        (["Home"], 0),
        (["End"], 180),
        (["End", "ArrowRight"], 180),
    ],
)
def test_keys_move_in_time(visit, keys, seconds):
    page = visit("t=90")
    for key in keys:
        page.keyboard.press(key)
    assert page.evaluate("genc.time") == seconds


def test_keys_switch_what_there_is_to_switch(visit):
    page = visit("t=90&theme=light&names=1")
    for key, name in (
        ("h", "Heat map"),
        ("n", "Names of places"),
        ("t", "Dark"),
        ("2", "Top"),
        ("3", "Street"),
        ("1", "Overview"),
    ):
        button = page.get_by_role("toolbar").get_by_role("button", name=name, exact=True)
        before = button.get_attribute("aria-pressed")
        page.keyboard.press(key)
        assert button.get_attribute("aria-pressed") != before or (key, before) == ("1", "true"), key
    page.keyboard.press("+")
    assert page.locator(".speed output").inner_text() == "2×"
    page.keyboard.press("Space")
    until(page, "genc.playing")
    page.keyboard.press("?")
    assert page.get_by_role("dialog", name="Help").is_visible()
    page.keyboard.press("Escape")
    page.get_by_role("dialog", name="Help").wait_for(state="hidden")


def test_space_presses_the_button_that_the_keyboard_is_on(visit):
    page = visit("t=90")
    page.keyboard.press("Tab")
    page.get_by_role("button", name="Faster").focus()
    page.keyboard.press("Space")
    assert page.locator(".speed output").inner_text() == "2×"
    assert not page.evaluate("genc.playing")


def test_the_theme_follows_the_system_and_the_switch(visit):
    page = visit("t=90", color_scheme="dark")
    theme = "document.documentElement.dataset.theme"
    assert page.evaluate(theme) == "dark"
    dark = page.evaluate("getComputedStyle(document.querySelector('.dock')).backgroundColor")
    page.get_by_role("button", name="Dark").click()
    assert page.evaluate(theme) == "light"
    assert page.evaluate("getComputedStyle(document.querySelector('.dock')).backgroundColor") != dark


def test_a_still_is_asked_for_in_the_address(visit):
    page = visit("t=60&ui=0&agent=2&view=top&theme=dark&heat=1&names=0")
    assert page.evaluate("[genc.time, genc.playing, genc.selected]") == [60, False, 2]
    assert page.locator("canvas").first.is_visible()
    assert not page.locator(".ui").is_visible()


def test_a_changed_address_is_heeded(visit):
    page = visit("t=60")
    page.evaluate("location.hash = '#t=100&agent=3'")
    until(page, "genc.time === 100 && genc.selected === 3")


def test_it_rests_when_nothing_moves(visit):
    page = visit("t=60")
    page.wait_for_timeout(2500)
    before = page.evaluate("genc.stats().nFrames")
    page.wait_for_timeout(700)
    assert page.evaluate("genc.stats().nFrames") == before
    page.keyboard.press("ArrowRight")
    until(page, f"genc.stats().nFrames > {before}")


def test_a_thousand_people_take_few_draw_calls(visit, crowd_file):
    page = visit("t=90&heat=1", path=crowd_file)
    assert "1,000 people" in page.locator(".counts").inner_text()
    assert page.evaluate("genc.stats().drawCalls") <= 60


def _clock(time_s: float) -> str:
    return f"{int(time_s) // 60:02d}:{int(time_s) % 60:02d}"
