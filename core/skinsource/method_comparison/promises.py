"""What the program promises about errors, time and memory."""

from dataclasses import dataclass

from skinsource.method_comparison.accuracy import Errors
from skinsource.method_comparison.method import Precision
from skinsource.method_comparison.scenes import ComparedScene
from skinsource.method_comparison.signal_scenes import SignalScene

#: Largest error over the peak, by precision.
PEAK_ERROR: dict[Precision, float] = {"float64": 1e-14, "float32": 2e-6}
#: Largest error of a window of 100 ms over its own peak, down to -120 dB, in float64.
WINDOW_ERROR = 1e-9
#: One frame of the screen, and what still feels like an answer, s.
FRAME_S, ANSWER_S = 0.016, 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """What the promises are compared with.

    Attributes
    ----------
    errors
        Errors of the method.
    minimum_s
        Its shortest run.
    bytes_above_idle
        Memory it held; None where unknown.
    """

    errors: Errors
    minimum_s: float
    bytes_above_idle: float | None


def broken_promises(
    outcome: Outcome, scene: ComparedScene | SignalScene, precision: Precision, *, is_ours: bool
) -> tuple[str, ...]:
    """Name each promise that does not hold, with the figure found and the one promised.

    Promises about silence, time and memory are made only for this program's own engine.
    """
    errors = outcome.errors
    signal = isinstance(scene, SignalScene)
    allowed = scene.allowed_error if isinstance(scene, SignalScene) else PEAK_ERROR[precision]
    checks = [("error of the peak", errors.peak, allowed)]
    if precision == "float64" and not signal:
        checks.append(("error of a window", errors.window, WINDOW_ERROR))
    if is_ours:
        checks.append(("sample in silence", errors.silence, 0.0))
        if scene.allowed_s is not None:
            checks.append(("time in s", outcome.minimum_s, scene.allowed_s))
        if scene.allowed_bytes is not None and outcome.bytes_above_idle is not None:
            checks.append(
                ("memory in MB", outcome.bytes_above_idle / 1e6, scene.allowed_bytes / 1e6)
            )
    # Not "found > allowed": an error that is not a number breaks its promise too.
    return tuple(
        f"{name} {found:.3g}, promised {allowed:g}"
        for name, found, allowed in checks
        if not found <= allowed
    )
