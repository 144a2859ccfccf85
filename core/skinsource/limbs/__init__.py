"""Limbs: what one is, where its places are, and the measured, synthetic and own ones."""
