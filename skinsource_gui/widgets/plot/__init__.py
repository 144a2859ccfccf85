"""Plots of signals, on pyqtgraph."""
