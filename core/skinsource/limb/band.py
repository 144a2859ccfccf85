"""Bands of frequencies."""

#: Lowest and highest frequency, Hz.  ``Band | None``: that of a limb, None where it is not known.
Band = tuple[float, float]
