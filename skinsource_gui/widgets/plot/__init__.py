"""Plots of signals."""
