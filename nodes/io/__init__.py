"""Reading and writing files: pictures and the text in them, panoramas, meshes, landmarks, scenes, pins, judgements,
representations."""
