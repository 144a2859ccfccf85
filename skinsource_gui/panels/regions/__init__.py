"""Levels by region: of snapshots, and of all people."""
