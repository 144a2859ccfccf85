"""Presenting: one scene after another, in front of people."""
