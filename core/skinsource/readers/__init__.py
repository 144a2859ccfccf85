"""Readers of foreign files, run in a process of their own under limits."""
