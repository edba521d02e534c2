"""Corrections of an albedo: `shadow_color`."""
