"""Face, hair and background of a portrait (paper, section 2, "Face segmentation"), in the order of the graph:

- `geometric`: three masks from the projected geometry; `face`: the cheap soft mask from that alone;
- `window`, `features`, `texture`: color and MR8 responses around the face, at working size;
- `kernel_density`, `mixture`: densities, learned on every photo; `density`: the choice between them;
- `layout`, `prior`: geometry of the face at working size, and the prior over classes from it;
- `exposed_skin`, `skin_color`: skin that continues the forehead above the mesh; skin and its highlights by color;
- `hair`, `hair_detector`: hair learned from the top of this head;
- `cue`: a prior segmentation by a small network (`label_network`, `label_weights`, `network_input`) on the
  `upright_grid`. It replaces the detector (through `cued_hair`) and the prior from geometry. `network`: the large
  network (`selfie_network`) that it was trained on;
- `initialization`, `classify`, `smoothing`, `connected`, `geodesic`: labels for every pixel;
- `given_head`, `given_hair`, `given_labels`: masks by the user instead (`given_mask` is what they share).

The positions of cranium, ears and neck are in `graphface.nodes.head_shape`. The soft edge is `graphface.nodes.matting`;
the whole is `graphs/segment.yaml`.
"""
