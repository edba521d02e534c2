"""Face, hair and background of a portrait (paper, section 2, "Face segmentation"), in the order that it happens:

- `geometric`: three masks from the projected geometry; `face` is the cheap soft mask that needs no more than that;
- `window`, `features`, `texture`: color and MR8 responses around the face, at working size;
- `parzen`, `mixture`: densities and Gaussian mixtures, learnt on every photo anew; `likeness`: the swap between them;
- `exposed_skin`: skin that goes on from the forehead, above the mesh;
- `hair`: the detector, from the top of this very head;
- `cue`: what a small network guesses (`label_network`, its weights in `label_weights`) of the upright head (`upright`,
  `network_input`), in place of the detector (`cued_hair`) and of the hand-set `prior`; `network`: the large one that
  taught it;
- `start`, `smoothing`, `connected`, `classify`: labels for every pixel;
- `override`: what the user gives instead.

Where cranium, ears and neck lie is `graphface.nodes.head_shape`. The soft edge is `graphface.nodes.matting`; the
whole is `graphs/segment.yaml`.
"""
