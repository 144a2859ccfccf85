"""The chain of effects of the selected clip."""
