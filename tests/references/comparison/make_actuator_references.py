"""Steps of the actuators of ``skinsource bench`` to 60 digits: ``data/bench-actuators.npz``.

The parameters are those of the scenes; the equations and their exponential are those of
``make_actuators.py`` beside the folder, which knows nothing of the library.

    python tests/references/comparison/make_actuator_references.py
"""

import importlib.util
from dataclasses import asdict
from pathlib import Path

import numpy as np
from mpmath import mp

from skinsource.files.assets import data_folder
from skinsource.method_comparison.signal_scenes import FILE_NAME, N_STEPS, SIGNAL_SCENES

SCRIPT = Path(__file__).parents[1] / "make_actuators.py"


def main():
    """Write all scenes of actuators."""
    spec = importlib.util.spec_from_file_location("make_actuators", SCRIPT)
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    mp.dps = 60
    found = {}
    for scene in SIGNAL_SCENES:
        if scene.actuator is not None:
            case = {"kind": "VoiceCoil", **asdict(scene.actuator)}
            found[scene.key] = script.motion(case, np.ones(N_STEPS + 1), "zero")
    np.savez_compressed(data_folder() / FILE_NAME, **found)


if __name__ == "__main__":
    main()
