"""Figures of signals: noise, spectrograms, statistics, transfer functions and wave speed."""
