"""Drawings over a photo, for looking at a fit: mesh, normals, depth, and a checkerboard that moves with the face."""
