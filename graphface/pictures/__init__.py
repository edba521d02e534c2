"""A picture for every value: as its type's pack draws it, else as the engine does.

`draw` is all that others need. The engine itself knows numbers, texts, arrays, lists and records. No tile is blank.
"""

from graphface.pictures.draw import draw

__all__ = ["draw"]
