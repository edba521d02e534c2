"""Command lines that know about faces: demo, gallery, bench, models."""
