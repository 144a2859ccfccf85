"""Heads of the tracks, one row each: colour, place, level, mute, solo."""
