"""The perception panel."""
