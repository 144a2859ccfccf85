"""Pictures with axes of their own, where curves over one axis are not enough."""
