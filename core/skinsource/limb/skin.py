"""What holds for the skin of any limb."""

#: Up to here the skin was found to answer in proportion: third harmonics show at twice of it.
LARGEST_VELOCITY_M_PER_S = 0.04
