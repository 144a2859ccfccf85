"""Spectra of the selected outputs."""
