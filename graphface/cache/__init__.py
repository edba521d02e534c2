"""Results kept: in memory (`memory`) and on disk (`disk`), each under a budget in bytes."""
