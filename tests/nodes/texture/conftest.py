"""Lets the tests of projection import `faces` of the tests of geometry."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "morphable"))
