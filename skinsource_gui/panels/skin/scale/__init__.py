"""The scale of the colours, and the range of levels that they span."""
