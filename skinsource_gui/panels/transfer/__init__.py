"""Transfer functions to the selected outputs."""
