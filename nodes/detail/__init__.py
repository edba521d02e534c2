"""The detail map: what the photo has and the rendering of albedo, geometry and light lacks.

Every method of the family `detail.*` answers the same question and differs in what goes where; `detail.edit.*` changes
a map once it is made. `applied` puts a map onto a rendering, whichever method made it.
"""

from graphface.nodes.detail.additive import additive
from graphface.nodes.detail.bands import bands
from graphface.nodes.detail.multiplicative import multiplicative
from graphface.nodes.detail.none import none
from graphface.nodes.detail.rendering import applied, rendering
from graphface.nodes.detail.shine import shine
from graphface.nodes.detail.split import split
from graphface.nodes.detail.wrinkles import wrinkles

__all__ = ["additive", "applied", "bands", "multiplicative", "none", "rendering", "shine", "split", "wrinkles"]
