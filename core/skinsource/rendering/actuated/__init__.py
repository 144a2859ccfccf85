"""Limbs as they answer through actuators."""

from skinsource.rendering.actuated.actuated_limb import actuated_limb

__all__ = ["actuated_limb"]
