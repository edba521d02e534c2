"""Dense optical flow that refines the correspondence of the meshes (paper: "optical flow based warping").

One file per method, which computes the displacement between two grey pictures; `refine` makes an operator of it.
"""
