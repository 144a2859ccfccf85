"""
Which frequencies of an impulse get through?
============================================

An impulse holds all frequencies. Spectra at three outputs, from the finger to the wrist, show which
of them arrive: high ones are lost on the way.
"""

import skinsource as ss

pulse = ss.track(7, ss.waveforms.Impulse())
design = ss.Design(limb="synthetic-1", inputs=(pulse,))
figure = ss.plot.spectra(design, outputs=(28, 33, 52), normalised=True)

found = ss.result(design, "selected_spectra", view=ss.View(outputs=(28, 33, 52)))
for output, spectrum in zip(found.axes["n_selected"], found.values, strict=True):
    above = found.axes["n_bins"] > 100.0
    share = (spectrum[above] ** 2).sum() / (spectrum**2).sum()
    print(f"output {output}: {100 * share:.1f} % of the energy above 100 Hz")
