"""Signals: generators, spectra, projection, resampling, formulas and analysis."""
