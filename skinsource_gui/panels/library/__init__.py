"""Panel of the library: presets to look at, to place, and to keep."""
