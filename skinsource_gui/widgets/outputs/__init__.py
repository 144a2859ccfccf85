"""Outputs on a map: which one is meant by the mouse and by keys."""
