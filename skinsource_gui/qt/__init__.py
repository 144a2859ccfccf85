"""Theme, text and small widgets."""
