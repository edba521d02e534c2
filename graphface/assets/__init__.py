"""Files that graphface needs and does not ship, known by their hash: network weights, face models."""
