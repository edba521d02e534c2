"""Faces found in a photograph and the points on them.

- `blazeface`: the detector network, one look at a picture;
- `search`: what is tried when one look finds nothing;
- `crop`: the upright square that a face is read from;
- `facemesh`: the operator, 468 points on the chosen face;
- `given`: points that somebody placed instead; `files` reads them;
- `schemes`: what the points are called and how one scheme is read from another;
- `network`, `weights`: running the networks, and the files they need.
"""
