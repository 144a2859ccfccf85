"""Import of recordings."""
