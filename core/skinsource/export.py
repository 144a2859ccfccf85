"""Tables of what is predicted, as CSV.

Comment lines with all that is needed to understand them, one header line, then numbers that read
back exactly.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from skinsource.design import Design
from skinsource.files import write_bytes
from skinsource.limb import N_OUTPUTS
from skinsource.quantities import new_graph, sources
from skinsource.view import View

Floats = NDArray[np.float64]


def export_traces(path: Path, design: Design, view: View) -> None:
    """Compute and write the traces of the selected outputs: times in s, then m/s².

    Raises
    ------
    StorageError
        The folder cannot be written, or the disk is full.
    """
    wanted = new_graph().evaluate({"response_time_s", "selected_traces"}, sources(design, view))
    header = ["time_s", *(f"output_{output}_m_per_s2" for output in view.outputs)]
    shift = "removed from" if view.delay_removed else "contained in"
    about = [*_about(design, view), f"pre-trigger delay of 52 ms: {shift} the times"]
    table = np.vstack((wanted["response_time_s"], wanted["selected_traces"])).T
    _save(path, about, header, table)


def export_levels(path: Path, design: Design, view: View) -> None:
    """Compute and write the RMS of each of the 72 outputs, in m/s² and in dB re 1 m/s²."""
    wanted = new_graph().evaluate({"output_rms", "output_levels_db"}, sources(design, view))
    outputs = np.arange(1, N_OUTPUTS + 1)
    header = ["output", "rms_m_per_s2", "level_db_re_1_m_per_s2"]
    table = np.vstack((outputs, wanted["output_rms"], wanted["output_levels_db"])).T
    _save(path, _about(design, view), header, table)


def _about(design: Design, view: View) -> list[str]:
    lines = ["SkinSource studio"]
    if design.limb.startswith("synthetic"):
        lines.append("SYNTHETIC LIMB: computed responses, not measured ones")
    lines.append(f"limb: {design.limb}; scaling: {design.scaling}")
    method = "" if len(view.axes) == 1 else f"; method: {view.method}"
    lines.append(f"axes: {view.axes}{method}")
    for one in design.inputs:
        muted = ", muted" if one.muted else ""
        solo = ", solo" if one.solo else ""
        lines.append(
            f"input at place {one.location}: {one.waveform}, amplitude {one.amplitude!r}, "
            f"onset {one.onset_s!r} s{muted}{solo}"
        )
    return lines


def _save(path: Path, about: list[str], header: list[str], table: Floats) -> None:
    lines = [f"# {line}" for line in about]
    lines.append(",".join(header))
    lines.extend(",".join(_exact(value) for value in row) for row in table.tolist())
    write_bytes(path, ("\n".join(lines) + "\n").encode())


def _exact(value: float) -> str:
    # The shortest digits that read back as the same number.
    return str(int(value)) if value == int(value) and abs(value) < 2**53 else repr(value)
