"""A mesh drawn into the picture (`rasterize`), face coordinates of pixels (`coordinates`), visibility of vertices
(`visibility`).

`refined` fits the normals to the picture, and finds the shadows in it (`cast_shadow`), by a network (`normal_network`)
that sees a crop about the face (`face_crop`).
"""
