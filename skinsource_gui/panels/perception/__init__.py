"""Levels above the threshold of detection."""
