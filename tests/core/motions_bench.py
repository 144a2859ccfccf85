"""What tests of motions draw at random."""

from hypothesis import strategies as st

PLACES = st.integers(1, 20)
PATHS = st.lists(PLACES, min_size=2, max_size=12).map(tuple)
