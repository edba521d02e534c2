"""Which nodes of two runs differ, by how much, where and why; and which node of a run first leaves known-good values.

from graphface.report.difference import compare

found = compare(relight.request(inputs), other.request(inputs))
found.first.name, found.first.parts, found.first.caused
"""

from graphface.report.difference.compare import compare
from graphface.report.difference.found import Differences
from graphface.report.difference.node import NodeDifference
from graphface.report.difference.values import PartDifference, differences

__all__ = ["Differences", "NodeDifference", "PartDifference", "compare", "differences"]
