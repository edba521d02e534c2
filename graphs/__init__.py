"""Graph and scene files. YAML only: no logic lives here."""
