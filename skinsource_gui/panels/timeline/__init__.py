"""Tracks and their clips over time."""
