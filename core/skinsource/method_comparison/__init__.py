"""Error against run time: what ``skinsource bench`` measures, and how.

A new engine, or a scene, is one more entry in `skinsource.method_comparison.engines.ENGINES` or
`skinsource.method_comparison.scenes.scenes_on`; of actuators and resamplers, in
`skinsource.method_comparison.signal_engines` or `skinsource.method_comparison.signal_scenes`.
"""
