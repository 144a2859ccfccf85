"""Gain curves of tracks, over their clips."""
