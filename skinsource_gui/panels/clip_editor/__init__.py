"""The selected clip, large: looked at, drawn, shaped."""
