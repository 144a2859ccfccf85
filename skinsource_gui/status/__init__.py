"""The status bar: what was computed, how fast, how exact."""
