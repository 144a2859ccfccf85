"""Frequency and amplitude of the selected input, large: for presenting."""
