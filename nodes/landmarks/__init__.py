"""Faces found in a photograph and the points on them.

- `blazeface`: the detector network, one look at a picture;
- `search`: what is tried when one look finds nothing;
- `crop`: the upright square that a face is read from;
- `facemesh`: the operator, 468 points on the chosen face;
- `given`: points that somebody placed instead (`graphface.nodes.io.landmarks` reads them);
- `network`, `weights`: running the networks, and the files they need.
"""
