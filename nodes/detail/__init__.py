"""The detail map: what the photo has and the rendering of albedo, geometry and light lacks.

Every method of the family `detail.*` answers the same question and differs in what goes where; `detail.edit.*` changes
a map once it is made. `graphface.nodes.rendering.applied` puts a map onto a rendering, whichever method made it.
"""
