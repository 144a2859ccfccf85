"""Presets, shipped and of the user."""
