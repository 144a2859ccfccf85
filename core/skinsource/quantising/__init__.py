"""From numbers in parts of full scale to whole numbers: the one place where that is done."""

from skinsource.quantising.quantiser import KINDS, IntegerKind, Quantised, quantised

__all__ = ["KINDS", "IntegerKind", "Quantised", "quantised"]
