"""Training, behind `graphface models`:

- `learn`: `face_model` (photographs to landmarks), `linear_model` (landmarks to a model), `coefficient_prior`;
- `relief`: `relief` (the path-traced heads), `surface_relief` (the correction of the mean shape);
- `head`: `head_model` (ICT-FaceKit reduced), `head_points` (FaceMesh's points on it), `decimation` (fewer triangles);
- `labels`: `label_pictures` (labelled pictures), `label_variations` (augmentation), `label_training` (PyTorch),
  `label_learning` (all of it).

`topology` made the triangles of FaceMesh's points.
"""
