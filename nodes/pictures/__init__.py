"""How the values of face operators are looked at: one drawing for each type (`graphface.values.picture`).

Masks, regions and points are drawn over the photo that they were made from, where there is one. A drawing samples first
and computes then, so that it costs as much as its own pixels, not as the photo's. Every note states the scale.
`graphface.nodes.pack` says which function draws which type.
"""
