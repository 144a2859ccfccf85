"""How much memory may hold what was computed before.

Each is what graphs that share hold together; limbs, with the responses that were read, and the
latest result of each rule come on top.
"""

_MIB = 2**20

#: Spectra of responses: those of twenty places for stimuli of four seconds.
RESPONSE_SPECTRA_BYTES = 204 * _MIB
#: Samples of clips, before and after their effects.
CLIPS_BYTES = 10 * _MIB
#: Drives, as samples, and as much again as spectra.
DRIVES_BYTES = 11 * _MIB
#: Spectra of single responses at exact lengths.
EXACT_SPECTRA_BYTES = 12 * _MIB
#: Gains of unit voices.
GAINS_BYTES = 1 * _MIB
#: Operators of the maps of a few limbs.
SURFACES_BYTES = 7 * _MIB

#: All of them together.
TOTAL_BYTES = (
    RESPONSE_SPECTRA_BYTES
    + CLIPS_BYTES
    + 2 * DRIVES_BYTES
    + EXACT_SPECTRA_BYTES
    + GAINS_BYTES
    + SURFACES_BYTES
)

#: What `skinsource.predict` remembers, beside all of that: twice what twenty places take for
#: stimuli of one second.
PREDICT_BYTES = 128 * _MIB
#: Gains that it remembers.
PREDICT_GAINS_BYTES = 1 * _MIB
