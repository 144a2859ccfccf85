"""The built-in limbs, computed from a model of dispersive waves on the project's own outline."""

from skinsource.synthetic.limbs import (
    SYNTHETIC_LIMBS,
    load_synthetic_limb,
    standard_hand,
    synthetic_model,
)

__all__ = ["SYNTHETIC_LIMBS", "load_synthetic_limb", "standard_hand", "synthetic_model"]
