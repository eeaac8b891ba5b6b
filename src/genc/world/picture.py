"""Still pictures: the player at one moment, photographed by a browser; where there is none, a plan from above."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlencode

from genc.errors import BriefError
from genc.files import written_beside
from genc.world.drawing import draw
from genc.world.page import write_page
from genc.world.world_file import read_world

BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
VIEWS = ("overview", "top", "street")
THEMES = ("light", "dark")
_SIZES = range(200, 8001)
_PATIENCE_S = 180
_SETTLED_MS = 10_000
"""So much of the page's own time passes before the picture is taken."""


@dataclass(frozen=True)
class Shot:
    """What a picture shows.

    Attributes:
        at_s: the moment, seconds from the beginning of the world.
        width, height: pixels.
        view, theme: as in the player.
        agent: whom to mark; None for nobody.
        names: whether to name the places.

    Raises:
        BriefError: for what the player does not have.
    """

    at_s: float
    width: int = 1600
    height: int = 900
    view: str = "overview"
    theme: str = "light"
    agent: int | None = None
    names: bool = True

    def __post_init__(self) -> None:
        if self.width not in _SIZES or self.height not in _SIZES:
            raise BriefError(
                f"a picture of {self.width} x {self.height} pixels cannot be made: ask for {_SIZES[0]} to {_SIZES[-1]}"
            )
        for wish, known in ((self.view, VIEWS), (self.theme, THEMES)):
            if wish not in known:
                raise BriefError(f"{wish!r} is not known: choose {' or '.join(known)}")


def take_picture(world_file: Path, path: Path, shot: Shot, *, plain: bool = False) -> bool:
    """Writes a PNG; gives back whether it shows the player, not the plain plan.

    Args:
        world_file: the world.
        path: where the picture goes.
        shot: what it shows.
        plain: draw the plan from above even if there is a browser.

    Raises:
        WorldFileError: if the world file cannot be read.
        BriefError: for a moment or a person that the world does not have.
        OutputError: if nothing can be written there.
    """
    world = read_world(world_file)
    n_agents, duration_s = len(world.plan.people), world.plan.duration_s
    if not 0 <= shot.at_s <= duration_s:
        raise BriefError(f"there is no moment {shot.at_s:g} s in a world of {duration_s:g} s: ask for 0 to its end")
    if shot.agent is not None and not 0 <= shot.agent < n_agents:
        raise BriefError(f"there is no person {shot.agent}: the world has 0 to {n_agents - 1}")
    browser = None if plain else next(filter(None, map(shutil.which, BROWSERS)), None)
    with written_beside(path) as part:
        if browser is not None and _photograph(browser, world_file, part, shot):
            return True
        draw(world, shot.at_s, (shot.width, shot.height), agent=shot.agent, names=shot.names).save(part, "PNG")
        return False


def _photograph(browser: str, world_file: Path, path: Path, shot: Shot) -> bool:
    """Whether the browser could take the picture."""
    wishes = {"t": shot.at_s, "ui": 0, "view": shot.view, "theme": shot.theme, "names": int(shot.names)}
    if shot.agent is not None:
        wishes["agent"] = shot.agent
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "world.html")
        write_page(world_file, page)
        command = [
            browser,
            *("--headless", "--hide-scrollbars", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"),
            *("--ignore-gpu-blocklist", "--no-first-run", "--disable-sync", "--disable-background-networking"),
            *("--disable-component-update", f"--user-data-dir={folder}/profile"),
            *(["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []),
            *(f"--window-size={shot.width},{shot.height}", f"--virtual-time-budget={_SETTLED_MS}"),
            *(f"--screenshot={Path(folder, 'shot.png')}", f"{page.as_uri()}#{urlencode(wishes)}"),
        ]
        try:
            subprocess.run(command, capture_output=True, timeout=_PATIENCE_S, check=True)
            shutil.copyfile(Path(folder, "shot.png"), path)
        except (subprocess.SubprocessError, OSError):
            return False
    return True
