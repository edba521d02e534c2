"""How large the pictures of a report are, in pixels of their longer side.

Measured on the shipped graphs with `tests/bench/report_cost.py`.
"""

DEFAULT = 256
SMALLEST, LARGEST = 32, 4096
