"""Widgets that know neither panels nor the document."""
