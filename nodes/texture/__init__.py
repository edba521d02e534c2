"""A photo unwrapped onto the model's texture (`unwrap`), and a texture put back onto a face (`project`)."""
