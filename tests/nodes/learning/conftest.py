"""Lets the tests of learning import `drawn`, and `faces` of the tests of morphable."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "morphable"))
sys.path.insert(0, str(Path(__file__).parent))
