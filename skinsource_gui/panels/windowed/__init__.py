"""The panel of windows that follow each other."""
