"""Playing in the window: the bar, Esc Esc, and who is told."""
