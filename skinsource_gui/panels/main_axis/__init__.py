"""Main axes of the selected outputs."""
