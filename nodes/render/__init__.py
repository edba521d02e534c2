"""Rendering under new light: sample points, irradiance, shadows, highlights, and the picture beyond the face."""
