"""The map of the skin."""
