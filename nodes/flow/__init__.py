"""Dense optical flow that refines the meshes' correspondence: one file a method, `refine` what they share."""
