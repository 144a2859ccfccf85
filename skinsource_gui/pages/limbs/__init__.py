"""Limbs of the user."""
