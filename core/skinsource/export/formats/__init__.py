"""Formats of stimulus files."""
