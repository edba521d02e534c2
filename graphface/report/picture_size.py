"""How large the pictures of a report are, in pixels of their longer side.

Measured with `tests/bench/report_cost.py` on photos of 1 megapixel, 4 : 5, on two busy cores; seconds of CPU and page:

    size    relight            makeup
     192    +0.4 s, 1.8 MB     +1.1 s,  4.9 MB
     224    +0.5 s, 2.2 MB     +1.2 s,  6.2 MB
     256    +0.5 s, 2.8 MB     +1.5 s,  7.7 MB
     320    +0.8 s, 3.9 MB     +2.0 s, 11.0 MB
     384    +1.0 s, 5.2 MB     +2.3 s, 14.9 MB

Without a report a relight takes 1.3 s, a makeup 2.8 s. At the default a makeup of two square photos stays below 8 MB:
7.5 MB, at 240 pixels 8.3 and at 256 pixels 8.9.
"""

DEFAULT = 224
SMALLEST, LARGEST = 32, 4096
