"""File > Check against a recording: predictions held against what was measured."""
