"""Times on a ruler."""
