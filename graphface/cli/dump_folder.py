"""`graphface run --dump`."""

from __future__ import annotations

from graphface.cli.following import Follower
from graphface.report.dump import Dump


class DumpFolder(Dump, Follower):
    """`--dump DIR`."""
