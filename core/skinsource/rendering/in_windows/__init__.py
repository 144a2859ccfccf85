"""RMS of all outputs in windows that follow each other."""
