"""What maps of the skin are drawn with."""
