"""Panel of the history."""
