"""Measuring: what graphs give on ground truth and on photographs, and what that costs."""
