"""How large the pictures of a report are, in pixels of their longer side.

Measured with `tests/bench/report_cost.py`, photos of 1 megapixel (4 : 5 and square), seconds of CPU and page:

    size    relight            makeup
     192    +0.44 s, 1.8 MB    +1.1 s,  4.9 MB
     256    +0.57 s, 2.8 MB    +1.2 s,  7.7 MB
     320    +0.84 s, 3.9 MB    +1.8 s, 11.0 MB
     384    +0.96 s, 5.2 MB    +2.3 s, 14.9 MB

A relight without a report took 1.27 s, a makeup 2.63 s.
"""

DEFAULT = 256
SMALLEST, LARGEST = 32, 4096
