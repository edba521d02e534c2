"""Pages opened in the system's Chromium, as people would see them; skipped with a reason where there is none."""

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

Open = Callable[..., Any]
OWN = ("file:", "data:", "blob:")
"""How addresses begin that no network is asked for."""


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """The system's Chromium, or the one that Playwright has installed."""
    playwright = pytest.importorskip("playwright.sync_api", reason="needs playwright: pip install playwright")
    found = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    with playwright.sync_playwright() as driver:
        try:
            chromium = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        except playwright.Error as error:
            pytest.skip(f"needs a Chromium: {str(error).splitlines()[0]}")
        yield chromium
        chromium.close()


@pytest.fixture
def open_page(browser: Any) -> Iterator[Open]:
    """Opens a file, offline; afterwards no script may have failed and nothing may have been asked of the network."""
    wrong: list[str] = []
    pages = []

    def opened(path: Path, *, place: str = "", width: int = 1280, height: int = 800) -> Any:
        page = browser.new_page(viewport={"width": width, "height": height}, offline=True)
        page.on("pageerror", lambda error: wrong.append(f"script: {error}"))
        page.on("console", lambda said: wrong.append(said.text) if said.type == "error" else None)
        page.on("request", lambda asked: None if asked.url.startswith(OWN) else wrong.append(asked.url))
        page.on("dialog", lambda dialog: wrong.append(f"dialog: {dialog.message}"))
        page.goto(path.as_uri() + place)
        pages.append(page)
        return page

    yield opened
    for page in pages:
        page.close()
    assert not wrong
