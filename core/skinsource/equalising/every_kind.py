"""Every kind of equaliser."""

from skinsource.equalising.equaliser import Equaliser
from skinsource.equalising.pole_pair import PolePairReplacement
from skinsource.equalising.regularised_inverse import RegularisedInverse

#: Every kind, in the order in which a user meets them.
EQUALISERS: tuple[type[Equaliser], ...] = (RegularisedInverse, PolePairReplacement)
