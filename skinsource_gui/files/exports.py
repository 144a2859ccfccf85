"""The one table of exports: menus, shortcuts and the palette are made from it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from skinsource.actuators import rigs
from skinsource.base.job import Progress, Stop
from skinsource.design.design import Design
from skinsource.design.view import View
from skinsource.export import packing
from skinsource.export.map_files import export_map
from skinsource.export.tables import export_field, export_levels, export_traces, export_windows
from skinsource_gui.panels.skin.time.animation import SIZE_PX, export_animation
from skinsource_gui.panels.skin.time.film_options import KINDS, film_options
from skinsource_gui.panels.skin.time.film_words import film_name, film_remark
from skinsource_gui.widgets.pictures.picture_options import PictureOptions, Remark
from skinsource_gui.widgets.pictures.whole_picture import ALL_IN_SIGHT, IN_USE

#: By name, what a function that writes may want besides: `PictureOptions`, the part of the skin map
#: that is in sight, and the path of this machine's rig, or None.
SIZED, SEEN, WIRED = "options", "seen", "rig_path"


#: A function of `skinsource.export.exported_design`: given path, design and view, and by name
#: ``progress``, ``stop``, ``largest_error`` and what the export wants, it computes and writes.
Write = Callable[..., Any]


@dataclass(frozen=True, slots=True, kw_only=True)
class ExportSpec:
    """One thing that can be exported.

    It is either written by a function, as a job, or a picture of a panel.

    Attributes
    ----------
    name
        Of the action, after ``export_``.
    title
        What the menu says, after "Export".
    file_name, kinds
        Suggested name of the file; what can be written, as words and ending, first that of the
        suggested name.
    named
        The name that is suggested instead, of what is open and was chosen.
    hint
        What is written, in a sentence.
    write
        Computes and writes the file.
    wants
        What ``write`` is given besides: `SIZED` is asked of the user before, the others are known.
    begun, remark
        What is asked of the user begins with these, for what is open and with the sizes of the last
        time, and says as what it is written; what is said of what is chosen.
    panel, size_px
        The panel whose picture is saved, and width and height of that.
    package
        Name of what writes it, and of the extra that it comes with; none where it is always there.
    enabled
        Whether there is anything to export; always when not given.
    keys, keywords
        As those of an action.
    """

    name: str
    title: str
    file_name: str
    kinds: tuple[tuple[str, str], ...]
    hint: str
    write: Write | None = None
    begun: Callable[[Design, View, PictureOptions], PictureOptions] | None = None
    named: Callable[[Design, View, Any], str] | None = None
    wants: frozenset[str] = frozenset()
    remark: Callable[[Design, View, Any], Remark] | None = None
    panel: str = ""
    size_px: tuple[int, int] = (1200, 1800)
    package: tuple[str, str] | None = None
    enabled: Callable[[Design, View], bool] | None = None
    keys: tuple[str, ...] = ()
    keywords: str = ""

    @property
    def filter(self) -> str:
        """What the dialog offers."""
        return self.filter_for(self.kinds[0][1])

    def filter_for(self, ending: str) -> str:
        """The same, with one of the endings first: that is the one that it begins with."""
        kinds = sorted(self.kinds, key=lambda kind: kind[1] != ending)
        return ";;".join(f"{words} (*{ending})" for words, ending in kinds)

    @property
    def window_title(self) -> str:
        """Of the windows that ask how and where to."""
        return f"Export {self.title.removesuffix('…')}"

    @property
    def kind_words(self) -> str:
        """What can be written, as a sentence goes on: "PNG, SVG or PDF"."""
        *others, last = (words for words, _ in self.kinds)
        return f"{', '.join(others)} or {last}" if others else last

    @property
    def endings(self) -> tuple[str, ...]:
        """The endings that the file may have."""
        return tuple(ending for _, ending in self.kinds)


_PICTURES = (("PNG", ".png"), ("SVG", ".svg"), ("PDF", ".pdf"))


def _has_outputs(design: Design, view: View) -> bool:
    return bool(view.outputs)


def _pack(
    path: Path,
    design: Design,
    view: View,
    *,
    rig_path: Path | None,
    progress: Progress,
    stop: Stop,
    largest_error: float,
) -> None:
    del largest_error  # each table says its own
    rig = None if rig_path is None else rigs.open_rig(rig_path)
    packing.pack(path, design, view, rig=rig, progress=progress, stop=stop)


EXPORTS: tuple[ExportSpec, ...] = (
    ExportSpec(
        name="picture",
        title="picture of the skin map…",
        file_name="skin-map.png",
        kinds=_PICTURES,
        hint="Save the skin map as PNG, SVG or PDF, with its colour bar",
        panel="skin",
        keys=("Ctrl+Shift+E",),
        keywords="image figure screenshot heatmap vector pdf svg png",
    ),
    ExportSpec(
        name="panel_picture",
        title="picture of the panel in use…",
        file_name="panel.png",
        kinds=_PICTURES,
        hint="Save the panel that has the keyboard as PNG, SVG or PDF, for a paper or a slide",
        panel=IN_USE,
        keywords="image figure screenshot vector pdf svg png plot paper",
    ),
    ExportSpec(
        name="window_picture",
        title="picture of all panels…",
        file_name="studio.png",
        kinds=_PICTURES,
        hint="Save all panels that are in sight, arranged as they are, as PNG, SVG or PDF",
        panel=ALL_IN_SIGHT,
        keywords="image figure screenshot vector pdf svg png arrangement window slide",
    ),
    ExportSpec(
        name="animation",
        title="animation of the skin map…",
        file_name="skin-map.mp4",
        named=film_name,
        kinds=KINDS,
        hint="Save the skin map in time, in slow motion, as MP4, WebM or GIF",
        write=export_animation,
        wants=frozenset({SIZED, SEEN}),
        begun=film_options,
        remark=film_remark,
        size_px=SIZE_PX,
        package=("imageio_ffmpeg", "video"),
        keywords="video film movie wave gif mp4 webm slow motion time",
    ),
    ExportSpec(
        name="traces",
        title="traces as CSV…",
        file_name="traces.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the traces of the selected outputs, with times and units",
        write=export_traces,
        enabled=_has_outputs,
        keys=("Ctrl+E",),
        keywords="table excel matlab waveform acceleration",
    ),
    ExportSpec(
        name="levels",
        title="RMS levels as CSV…",
        file_name="rms-levels.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the RMS of all outputs, in m/s² and dB",
        write=export_levels,
        keywords="table excel matlab decibels",
    ),
    ExportSpec(
        name="map",
        title="map of levels as CSV…",
        file_name="map.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the map as numbers, in dB: a row for each y, a column for each x, in mm",
        write=export_map,
        keywords="table excel matlab decibels skin heatmap surface",
    ),
    ExportSpec(
        name="windows",
        title="windows as CSV…",
        file_name="windows.csv",
        kinds=(("CSV", ".csv"),),
        hint="Save the RMS of all outputs in consecutive windows, and how far each window reaches",
        write=export_windows,
        keywords="table excel matlab windowed rms extent distance strip contraction",
    ),
    ExportSpec(
        name="windows_picture",
        title="picture of the windows…",
        file_name="windows.png",
        kinds=(("PNG", ".png"), ("SVG", ".svg"), ("PDF", ".pdf")),
        hint="Save the strip of windows as PNG, SVG or PDF, with its colour scale and the extent",
        panel="windowed",
        size_px=(1600, 1100),
        keywords="image figure screenshot vector pdf svg png windowed rms strip",
    ),
    ExportSpec(
        name="field",
        title="whole field as NPZ…",
        file_name="field.npz",
        kinds=(("NumPy archive", ".npz"),),
        hint="Save the acceleration of all outputs on three axes, for NumPy",
        write=export_field,
        keywords="python numpy matlab data array",
    ),
    ExportSpec(
        name="pack",
        title="all of it as ZIP…",
        file_name="design.zip",
        kinds=(("ZIP", ".zip"),),
        hint="Save design, stimulus, rig, figure, tables, versions and what to cite as one file",
        write=_pack,
        wants=frozenset({WIRED}),
        keywords="zip archive pack share publish supplement reproduce citation",
    ),
)
