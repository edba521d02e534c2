"""Face models as their makers distribute them, read into one container."""
