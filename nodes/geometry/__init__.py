"""A face's geometry from its landmarks: `facemesh` uses the network's depth, `morphable` fits a face model, `average`
poses the model's mean."""
