"""Error against run time: what ``skinsource bench`` measures, and how.

A new engine, or a scene of another family (actuators, resamplers), is one more entry in
`skinsource.method_comparison.engines.ENGINES` or `skinsource.method_comparison.scenes.SCENES`.
"""
