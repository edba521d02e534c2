"""Faces found in a photograph and the points on them.

- `blazeface`: the detector network, run once on a picture;
- `search`: the detector on several views of the photo, for faces that one run misses;
- `crop`: the upright square around a face that the mesh network sees;
- `facemesh`: the operator, 468 points on the chosen face;
- `given`: points that the user gives instead (`graphface.nodes.io.landmarks` reads them);
- `network`, `weights`: running the networks, and their pinned weights.
"""
