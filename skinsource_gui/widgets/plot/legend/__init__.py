"""Names of curves and what is read of them, in one line."""
