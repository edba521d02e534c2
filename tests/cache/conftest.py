"""A disk cache, and what it reports."""

import pytest

from graphface.cache.disk import DiskTier


@pytest.fixture
def reports() -> list[str]:
    return []


@pytest.fixture
def tier(tmp_path, reports) -> DiskTier:
    return DiskTier(tmp_path / "cache", 100 << 20, report=reports.append)
