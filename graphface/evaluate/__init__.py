"""A request carried out: `evaluator`, one `run`, each node (`calling`), who watches (`observe`), what would run."""
