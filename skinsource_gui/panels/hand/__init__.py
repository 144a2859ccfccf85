"""The hand on which inputs are placed."""
