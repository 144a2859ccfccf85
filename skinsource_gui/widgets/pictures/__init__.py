"""Pictures that are saved: how large, in which colours, and as what."""
