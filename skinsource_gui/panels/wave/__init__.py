"""The wave along a line of outputs."""
