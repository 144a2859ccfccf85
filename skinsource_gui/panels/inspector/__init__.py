"""Everything about the selected input."""
