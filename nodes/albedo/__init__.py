"""Albedos corrected: `shadow_color`."""
