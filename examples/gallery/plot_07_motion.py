"""
How does a movement along the palm look?
========================================

Apparent motion plays a tone at one place after another; the law of Israr and Poupyrev says how much
they overlap. The strip shows the skin in six windows of time.
"""

import skinsource as ss

motion = ss.motions.ApparentMotion(path=(16, 18, 20))
design = ss.edits.add_motion(ss.Design(limb="synthetic-1"), ss.View(), motion).design
figure = ss.plot.strip(design, count=6)

print(motion.law)
for number, track in enumerate(design.inputs, start=1):
    print(f"track {number}: place {track.location}, begins at {track.clips[0].onset_s:.3f} s")
