"""A real Chromium, and pages opened in it that must be quiet: no complaint in the console, nothing from the network."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsing import ARGS, CHROMIUMS, LOCAL, PATIENCE_MS, missing, paged
from tiling import tiled

import genc


@pytest.fixture(scope="session")
def launch() -> Iterator[Callable[..., Any]]:
    """Starts a Chromium with further arguments; all are closed at the end."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        missing("the browser tests need Playwright: pip install playwright")
    program = next(filter(None, map(shutil.which, CHROMIUMS)), None)
    if program is None:
        missing("the browser tests need Chromium: install the package 'chromium' of your system")
    with sync_playwright() as playwright:
        started: list[Any] = []

        def start(*args: str) -> Any:
            started.append(playwright.chromium.launch(executable_path=program, args=[*ARGS, *args]))
            return started[-1]

        yield start
        for browser in started:
            browser.close()


@pytest.fixture(scope="session")
def browser(launch):
    return launch()


@pytest.fixture(scope="session")
def world() -> genc.World:
    """An authored station, played for three minutes."""
    return genc.stage(genc.load_corpus(["train station"])[0], minutes=3)


@pytest.fixture(scope="session")
def page_file(world, tmp_path_factory) -> Path:
    return paged(world, tmp_path_factory.mktemp("station"))


@pytest.fixture(scope="session")
def crowd_file(world, tmp_path_factory) -> Path:
    """The page of a thousand people."""
    return paged(tiled(world, 1000, np.random.default_rng(0)), tmp_path_factory.mktemp("crowd"))


@pytest.fixture
def visit(browser, page_file) -> Iterator[Callable[..., Any]]:
    """Opens a page and waits until the world is drawn; afterwards checks that it was quiet."""
    heard: list[str] = []
    pages: list[Any] = []

    def open_page(hash_: str = "", path: Path = page_file, size: tuple[int, int] = (1000, 640), **options: Any) -> Any:
        page = browser.new_page(viewport={"width": size[0], "height": size[1]}, **options)
        pages.append(page)
        page.set_default_timeout(PATIENCE_MS)
        page.on("console", lambda message: heard.append(f"{message.type}: {message.text}"))
        page.on("pageerror", lambda error: heard.append(f"error: {error}"))
        page.on("request", lambda request: request.url.startswith(LOCAL) or heard.append(f"request: {request.url}"))
        page.goto(f"{path.as_uri()}#{hash_}")
        page.wait_for_selector("html[data-ready='1']")
        return page

    yield open_page
    for page in pages:
        page.close()
    assert heard == []
