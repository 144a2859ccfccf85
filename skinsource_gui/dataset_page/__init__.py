"""The page on which the measured limbs are installed."""
