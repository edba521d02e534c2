"""A run as one HTML file that works offline: `write_report`, and `read_report` for comparing runs."""
