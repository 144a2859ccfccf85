"""Spectrogram of a selected output."""
