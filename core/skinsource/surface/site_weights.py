"""What interpolation between scattered sites gives: a share of each site for each point."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from skinsource.arrays import Booleans

if TYPE_CHECKING:
    from scipy.sparse import csr_array


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SiteWeights:
    """Weights of sites for the values at points.

    Attributes
    ----------
    weights : (n_points, n_sites) sparse
        Not negative; rows sum to 1.
    outside : (n_points,) of bool
        Points beyond the convex hull of the sites; they take the value of the nearest place on it.
    fallback : (n_points,) of bool
        Where Sibson's weights missed the point's own coordinates (triangles without area), and
        those of linear interpolation were taken instead.
    """

    weights: "csr_array[np.float64]"
    outside: Booleans
    fallback: Booleans
