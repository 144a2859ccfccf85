"""Rigs and their measurement."""
