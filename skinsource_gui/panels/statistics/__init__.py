"""Figures of the selected outputs."""
