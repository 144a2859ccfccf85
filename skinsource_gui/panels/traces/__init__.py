"""Acceleration over time."""
