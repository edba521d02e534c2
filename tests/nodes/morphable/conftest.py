"""Lets the tests of geometry import `faces`, which pytest's importlib mode leaves unfindable."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
