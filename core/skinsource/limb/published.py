"""Sizes of the published limbs, and of the synthetic ones, which are like them.

What computes asks the limb it is given, never these.
"""

from skinsource.limb.band import Band

N_INPUTS, N_OUTPUTS, N_AXES, N_TAPS = 20, 72, 3, 522
SAMPLE_RATE_HZ = 1300.0
#: The band in which the responses were measured.
BAND_HZ: Band = (25.0, 600.0)
#: Time between the trigger and the pulse in the measured responses.
PRE_TRIGGER_DELAY_S = 0.052
#: Outputs on the palmar side: they have no place on the dorsal map.
VOLAR_OUTPUTS = (61, 62, 63, 64, 65, 66)

#: The largest number that a place or an output of any limb can have.
MOST_PLACES = 10_000

#: Hand lengths of limbs 1 to 4, measured and synthetic alike.
HAND_LENGTHS_MM = (175.0, 165.0, 185.0, 165.0)
#: Every limb that exists, installed or not, but for those that a lab has imported.
LIMB_NAMES = tuple(f"{kind}-{k}" for kind in ("measured", "synthetic") for k in range(1, 5))
