"""What every test may ask for: the shared pictures, a registry of toy operators, and an engine that counts what ran."""

import logging
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

sys.path.insert(0, str(Path(__file__).parent))  # importlib mode leaves `toys` unfindable otherwise

from browser import browser, open_page  # noqa: F401 - fixtures
from evaluator_lab import THREADS, TIERS, Lab, build
from toys import LOGGER, toy_registry

from graphface import Registry

settings.register_profile("any machine", deadline=None)  # how long an example takes says nothing on a busy machine
settings.load_profile("any machine")


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of test pictures and ground truth, which is no part of the repository."""
    default = Path(__file__).resolve().parents[2] / "shared" / "data"
    folder = Path(os.environ.get("GRAPHFACE_SHARED", default))
    if not folder.is_dir():
        pytest.skip(f"needs the shared test data; set GRAPHFACE_SHARED to its folder ({folder.name!r} is absent)")
    return folder


@pytest.fixture
def registry() -> Registry:
    """The toy operators, and nothing that is installed."""
    return toy_registry()


@pytest.fixture
def ran() -> Iterator[list[str]]:
    """Labels of the toy operators in the order they were called; `clear()` it between runs."""
    labels: list[str] = []

    class Collect(logging.Handler):
        def emit(self, record: logging.LogRecord) -> None:
            labels.append(record.getMessage())

    logger, handler = logging.getLogger(LOGGER), Collect()
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    yield labels
    logger.removeHandler(handler)


@pytest.fixture(params=[f"{tier}-{threads}" for tier in TIERS for threads in THREADS])
def lab(request: pytest.FixtureRequest, tmp_path: Path, registry: Registry, ran: list[str]) -> Lab:
    tier, threads = request.param.split("-")
    return build(tier, int(threads), tmp_path / "cache", registry, ran)


@pytest.fixture(params=[1, 4])
def quick(request: pytest.FixtureRequest, tmp_path: Path, registry: Registry, ran: list[str]) -> Iterator[Lab]:
    """A lab with a memory tier, for behaviour that no tier has a part in."""
    return build("memory", request.param, tmp_path, registry, ran)
