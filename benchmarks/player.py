"""Script time of a frame in the browser player, and its draw calls, while a world plays.

    python benchmarks/player.py out/big

The budget for 1,000 people is 4 ms and 60 draw calls. Script time is the mean processor time of the page's own thread
in scripts, for a frame: where there is no GPU the rendering is software, takes other threads, and is not counted.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from playwright.sync_api import CDPSession, Page, sync_playwright

BUDGET_MS = 4.0
MOST_DRAW_CALLS = 60
WARM_UP_S = 4
SCENES = {
    "alone": "t=120&play=1",
    "person, graph, heat map": "t=120&play=1&agent=2&heat=1",
    "following": "t=120&play=1&agent=2&follow=1",
}
ARGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


@dataclass(frozen=True)
class Figures:
    """What a while of playing came to."""

    script_ms: float
    draw_calls: int
    frames_per_s: float


def measure(page: Page, address: str, seconds: float) -> Figures:
    """Plays a page for a while, after some seconds of warming up."""
    session = page.context.new_cdp_session(page)
    session.send("Performance.enable", {"timeDomain": "threadTicks"})
    page.goto(address)
    page.wait_for_selector("html[data-ready='1']", timeout=120_000)
    page.wait_for_timeout(1000 * WARM_UP_S)
    script_s, n_frames = script_and_frames(page, session)
    page.wait_for_timeout(1000 * seconds)
    script_end_s, n_end = script_and_frames(page, session)
    n = max(n_end - n_frames, 1)
    return Figures(1000 * (script_end_s - script_s) / n, page.evaluate("genc.stats().drawCalls"), n / seconds)


def script_and_frames(page: Page, session: CDPSession) -> tuple[float, int]:
    """Processor time of scripts so far, and the number of frames drawn."""
    metrics = {metric["name"]: metric["value"] for metric in session.send("Performance.getMetrics")["metrics"]}
    return metrics["ScriptDuration"], page.evaluate("genc.stats().nFrames")


def main() -> None:
    """Prints a table; exits with 1 if a figure is over its budget."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("world", type=Path, help="folder with a world.html, or the page itself")
    parser.add_argument("--seconds", type=float, default=15.0, help="how long to play each")
    options = parser.parse_args()
    file = options.world / "world.html" if options.world.is_dir() else options.world
    program = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    over = False
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=ARGS)
        print(f"{'':26}{'script ms':>10}{'draw calls':>12}{'frames/s':>10}")
        for name, wishes in SCENES.items():
            page = browser.new_page(viewport={"width": 480, "height": 270})
            found = measure(page, f"{file.resolve().as_uri()}#{wishes}", options.seconds)
            page.close()
            print(f"{name:26}{found.script_ms:>10.2f}{found.draw_calls:>12}{found.frames_per_s:>10.1f}")
            over |= found.script_ms > BUDGET_MS or found.draw_calls > MOST_DRAW_CALLS
    if over:
        sys.exit(f"over the budget of {BUDGET_MS} ms and {MOST_DRAW_CALLS} draw calls")


if __name__ == "__main__":
    main()
