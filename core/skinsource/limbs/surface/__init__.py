"""Interpolation of values at the outputs over the surface of the limb."""
