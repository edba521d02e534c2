"""Several photographs of one person, fitted together: `morphable`."""
