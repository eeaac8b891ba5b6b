"""What the browser tests share: where a Chromium is, how it is started, and pages for it."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any, NoReturn

import pytest

from genc.world.page import write_page
from genc.world.world import World
from genc.world.world_file import write_world

CHROMIUMS = ("chromium", "chromium-browser", "google-chrome")
ARGS = (
    *("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"),
    *("--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update"),
    "--disable-sync",
)
MUST_RUN = os.environ.get("CI") == "true" or "GENC_REQUIRE_BROWSER" in os.environ
LOCAL = ("file:", "data:", "blob:")
PATIENCE_MS = 60_000
"""Software rendering on a busy machine is slow; a test that fails fails later for it."""


def missing(what: str) -> NoReturn:
    """Skips on a user's machine; in CI a browser that is not there is a fault."""
    (pytest.fail if MUST_RUN else pytest.skip)(what)


def paged(world: World, folder: Path) -> Path:
    """A page of this world."""
    write_world(world, folder / "world.genc")
    write_page(folder / "world.genc", folder / "world.html")
    return folder / "world.html"


def until(page: Any, expression: str) -> None:
    """Waits until an expression is true. (Playwright's own waiting needs `eval`, which the page forbids.)"""
    end_s = time.monotonic() + PATIENCE_MS / 1000
    while not page.evaluate(expression):
        assert time.monotonic() < end_s, f"waited in vain until {expression}"
        page.wait_for_timeout(30)
