"""Training, behind `graphface models`:

- `learn`: `face_model` (photographs to landmarks), `linear_model` (landmarks to a model), `coefficient_prior`;
- `relief`: `relief` (the path-traced heads), `surface_relief` (the correction of the mean shape);
- `head`: `head_model` (ICT-FaceKit reduced), `head_points` (FaceMesh's points on it), `decimation` (fewer triangles);
- `labels`: `label_pictures` (labelled pictures), `label_variations` (augmentation), `label_training` (PyTorch),
  `label_learning` (all of it);
- `render`: `rendering` (path-traced heads with everything known);
- `normals`: `normal_lessons` (what the network sees of them), `normal_training` (PyTorch), `normal_learning`.

`unet_training` is what both networks are in PyTorch.

`topology` made the triangles of FaceMesh's points.
"""
