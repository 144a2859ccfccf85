"""Numbers and choices that are edited in place."""
