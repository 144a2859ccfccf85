"""Fields and editors of values."""
