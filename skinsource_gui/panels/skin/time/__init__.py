"""The skin map in time: frames, and what chooses them."""
