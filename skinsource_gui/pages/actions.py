"""Actions that open pages on the open design, and files that are dropped on the window.

Each class of actions opens one page, and carries out what is chosen there.
"""

import importlib
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6 import QtGui, QtWidgets
from PySide6.QtCore import QEvent, QObject, QPoint, Qt, QTimer, Signal

from skinsource.base.errors import SkinSourceError, counted
from skinsource.design import edits
from skinsource.design.design import Design, View
from skinsource.design.design_file import SHOW_SUFFIX, SUFFIX
from skinsource.design.display_units import value_text
from skinsource.design.edits.clips import over_text
from skinsource.design.edits.edit import (
    Edit,
    Refusal,
    leading_clip,
    leading_input,
    location_text,
    refusing,
    with_inputs_added,
)
from skinsource.design.edits.inputs import free_location, usual_location
from skinsource.design.labels import limb_label
from skinsource.design.presets import presets
from skinsource.design.waveforms.samples import Recording
from skinsource.limbs.own_limbs import facts_of
from skinsource.studies import scenes
from skinsource_gui import pages
from skinsource_gui.fields.editor import new_gesture
from skinsource_gui.pages.files.file_actions import FileActions
from skinsource_gui.plots.small_map import with_colours_of
from skinsource_gui.qt.frames import DropPlace
from skinsource_gui.qt.windows import WindowEvents
from skinsource_gui.state.document import Document
from skinsource_gui.state.panel import Panel, PanelRegistry
from skinsource_gui.state.playing import Player
from skinsource_gui.state.preferences import Preferences
from skinsource_gui.state.services import Services

if TYPE_CHECKING:
    from skinsource.design.presets.presets import Preset
    from skinsource_gui.pages.library import SavePage
    from skinsource_gui.pages.scenes import ScenesPage


# The page stays open while its design is edited.
_CLIP_REMOVED = Refusal(sentence="That recording is no longer there; import it to another place.")


def options(design: Design, view: View, place: DropPlace | None) -> tuple[tuple[str, str], ...]:
    """Return name and text of each place that a recording can go to, the likeliest one first."""
    at, selected = place or DropPlace(), leading_input(design, view)
    ids = view.selected_inputs[-1:] if at.input_id is None else (at.input_id,)
    at_place, tracks = Counter(track.location for track in design.inputs), []
    # The selected one comes first.
    for track in sorted(design.inputs, key=lambda track: track.id not in ids):
        text = f"Track at {location_text(track.location, design.limb)}"
        row = f", row {design.index_of(track.id) + 1}" if at_place[track.location] > 1 else ""
        tracks.append((f"track {track.id}", text + row))
    first = at.location or (usual_location(design.limb) if selected is None else selected.location)
    locations = [first, *(k for k in range(1, facts_of(design.limb).n_inputs + 1) if k != first)]
    new = [(f"new {k}", f"New input at {location_text(k, design.limb)}") for k in locations]
    if not ids or (at.location is not None and at.input_id is None):
        return (new[0], *tracks, *new[1:])
    instead = None if place is not None else _instead(design, view)
    if instead is None:
        return (*tracks, *new)
    option, is_placeholder = instead
    return (option, *tracks, *new) if is_placeholder else (*tracks, option, *new)


def _instead(design: Design, view: View) -> tuple[tuple[str, str], bool] | None:
    """Return the option to replace the selected recording, and whether that is a placeholder."""
    clip = leading_clip(design, view)
    if clip is None or not isinstance(clip.waveform, Recording):
        return None
    where = location_text(design.track_of(clip.id).location, design.limb)
    # Samples without a name were taken over from another kind of waveform.
    return (f"clip {clip.id}", f"In place of the recording at {where}"), not clip.waveform.name


@refusing
def placed(
    design: Design,
    view: View,
    option: str,
    onset_s: float,
    recordings: Sequence[Recording],
) -> Edit | Refusal:
    """Return the edit that puts recordings where ``option`` says, and says where that is.

    Further ones go to the next free places, as strong beside the first one as in the file.
    """
    outcome = _placed_first(design, view, option, onset_s, recordings[0])
    if isinstance(outcome, Refusal) or (clip := leading_clip(outcome.design, outcome.view)) is None:
        return outcome
    after, ids = outcome.design, [clip.id]
    further = after.track_of(clip.id)
    for recording in recordings[1:]:
        location = free_location(after, further.location)
        beside = replace(clip, waveform=recording, label="")
        further = replace(further, location=location, clips=(beside,))
        after = with_inputs_added(after, [further])
        ids.append(after.clips[-1].id)
        shown = edits.select_clips(after, outcome.view, ids).view
        outcome = Edit(label=f"Import {len(recordings)} signals", design=after, view=shown)
    starts = f"Starts at {value_text(clip.onset_s, 's', digits=5)}"
    return replace(
        outcome, said=f"{starts} on {_where(outcome)}{over_text(outcome.design, design)}"
    )


def _where(edit: Edit) -> str:
    tracks = map(edit.design.input, edit.view.selected_inputs)
    return ", ".join(location_text(track.location, edit.design.limb) for track in tracks)


def _placed_first(
    design: Design, view: View, option: str, onset_s: float, recording: Recording
) -> Edit | Refusal:
    what, _, number = option.partition(" ")
    if what == "clip":
        if int(number) not in {clip.id for clip in design.clips}:
            return _CLIP_REMOVED
        track = design.track_of(int(number))
        chosen = replace(view, selected_inputs=(track.id,), selected_clips=(int(number),))
        return edits.change_waveform(design, chosen, (track.id,), recording)
    if what == "track":
        return edits.add_clip(design, view, int(number), onset_s, recording)
    return edits.place_waveform(design, view, int(number), recording, onset_s)


_HIDDEN_MS = 1000
# Dropped anywhere, the first are opened; no kind but recordings is taken with others.
_OPENED = (SUFFIX, SHOW_SUFFIX)
_ALONE = (*_OPENED, presets.SUFFIX)


class FileDrops(QObject):
    """Accepts designs, presets and recordings that are dropped on ``window``.

    The panels show where a file would go, and return the place where it was dropped.
    """

    #: A design or a show, `Path`.
    design_dropped = Signal(object)
    #: Recordings, list of `Path`, and their `DropPlace` or None.
    recordings_dropped = Signal(object, object)
    #: A preset, also one that is dragged from the library, `Path`, and its `DropPlace` or None.
    preset_dropped = Signal(object, object)
    #: Which files were left out, a sentence.
    failed = Signal(str)

    def __init__(self, window: QtWidgets.QWidget, panels: PanelRegistry) -> None:
        super().__init__(window)
        self._window, self._panels = window, panels
        window.setAcceptDrops(True)
        WindowEvents.follow(window, self._drag, QEvent.Type.DragEnter, QEvent.Type.DragMove)
        WindowEvents.follow(window, self._leave, QEvent.Type.DragLeave)
        WindowEvents.follow(window, self._drop, QEvent.Type.Drop)

    def _drag(self, event: QtGui.QDragMoveEvent) -> bool:
        paths, at = _taken(event), event.position().toPoint()
        # A preset asks for no place; a window that refuses what enters would see no moves.
        is_move = event.type() == QEvent.Type.DragMove and paths
        if is_move and paths[0].suffix == presets.SUFFIX and self._place(at) == DropPlace():
            event.ignore()
        for panel in self._panels if paths else ():
            placed = paths[0].suffix not in _OPENED and self._inside(panel, at)
            panel.show_drop(panel.mapFrom(self._window, at) if placed else None)
        return True

    def _leave(self, event: QEvent) -> bool:
        for panel in self._panels:
            panel.show_drop(None)
        return True

    def _drop(self, event: QtGui.QDropEvent) -> bool:
        paths = _taken(event)
        self._leave(event)
        if not paths:
            return True
        place, left = self._place(event.position().toPoint()), paths[1:]
        if paths[0].suffix in _OPENED:
            self.design_dropped.emit(paths[0])
        elif paths[0].suffix in _ALONE:
            self.preset_dropped.emit(paths[0], place)
        else:
            left = [path for path in paths if path.suffix in _ALONE]
            self.recordings_dropped.emit([path for path in paths if path not in left], place)
        if names := ", ".join(path.name for path in left):
            self.failed.emit(f"Not opened: {names}. Drop each file alone.")
        return True

    def _place(self, at: QPoint) -> DropPlace | None:
        for panel in self._panels:
            if self._inside(panel, at):
                return panel.drop_place(panel.mapFrom(self._window, at))
        return None

    def _inside(self, panel: Panel, at: QPoint) -> bool:
        # Panels in tabs cover each other; a floating panel is a window of its own.
        visible = panel.isVisible() and panel.window() is self._window
        return visible and panel.rect().contains(panel.mapFrom(self._window, at))


def _taken(event: QtGui.QDropEvent) -> list[Path]:
    """Return the files of an event, which is accepted where there are some."""
    paths = [Path(url.toLocalFile()) for url in event.mimeData().urls() if url.isLocalFile()]
    if paths:
        # After a move, the program that offered the file would delete it.
        event.setDropAction(Qt.DropAction.CopyAction)
    event.setAccepted(bool(paths))
    return paths


class ImportActions(QObject):
    """Imports recordings into the open design: asks for a file, opens the page, places a recording.

    Pages open in front of ``window``, which is also the parent.
    """

    #: What went well, as a short text.
    done = Signal(str)
    #: The next step might end the studio, so unsaved work is to be saved now.
    risk_ahead = Signal()

    def __init__(self, services: Services) -> None:
        super().__init__(services.window)
        self._document, self._preferences = services.document, services.preferences
        self._window = services.window
        self._pages: list[Any] = []
        # Files whose pages open when the page before is closed.
        self._waiting: list[tuple[Path, DropPlace | None, int, int]] = []
        # What was chosen for files before, by their shapes where it is the same for others like
        # them; by None for the last one.
        self._made: dict[Any, Any] = {}
        # Files and their places.
        self._imported: list[str] = []
        # All files that come together are one step of the history.
        self._gesture = 0

    @property
    def pages(self) -> tuple[Any, ...]:
        """The pages that are open."""
        return tuple(self._pages)

    def ask_and_import(self) -> None:
        """Ask for files, and open the page on one after the other."""
        readers = importlib.import_module("skinsource.readers.readers")
        kinds = " ".join(f"*{ending}" for ending in readers.endings())
        known = f"Recordings ({kinds});;All files (*)"
        title, folder = "Import recordings", str(self._preferences.folder)
        names, _ = QtWidgets.QFileDialog.getOpenFileNames(self._window, title, folder, known)
        self.open_pages([Path(name) for name in names])

    def open_pages(self, paths: list[Path], place: DropPlace | None = None) -> None:
        """Open the page on one file after the other."""
        self._waiting += [(path, place, k, len(paths)) for k, path in enumerate(paths, 1)]
        self._open_next()

    def open_page(
        self, path: Path, place: DropPlace | None = None, number: int = 1, count: int = 1
    ) -> None:
        """Open the page on a file that is to go to ``place``, or where the user says.

        It is one of ``count``; those after the first go beside the one before, and begin with the
        same choices.
        """
        self.risk_ahead.emit()
        design, view, at = self._document.design, self._document.view, place or DropPlace()
        if number > 1:
            before = leading_input(design, view)
            location = free_location(design, before.location if before else 0)
            place = replace(at, location=location, input_id=None)
        else:
            self._made, self._imported, self._gesture = {}, [], new_gesture()
        places = options(design, view, place)
        limb = facts_of(design.limb)
        onset_s = view.playhead_s if at.onset_s is None else at.onset_s

        def put_at(recordings: tuple[Recording, ...], option: str) -> Edit | Refusal:
            return placed(self._document.design, self._document.view, option, onset_s, recordings)

        def put_all(recordings: tuple[Recording, ...], option: str) -> Edit | Refusal:
            return put_at(recordings * (count - number + 1), option)

        page: Any = pages.ImportPage(path, limb, places, put_all, self._window, self._made)
        if count > 1:
            page.setWindowTitle(f"{page.windowTitle()}, file {number} of {count}")
            page.same.setText(f"Same for {counted(count - number, 'more file')}")
            page.same.setVisible(number < count)

        def put(recordings: tuple[Recording, ...], option: str) -> None:
            self._made[None] = page.form.made
            if page.same.isChecked():
                self._made[page.form.shape] = page.form.made
            outcome = put_at(recordings, option)
            self._preferences.folder = path.absolute().parent
            if isinstance(outcome, Edit):
                self._imported.append(f"{path.name} on {_where(outcome)}")
                several = len(self._imported) > 1
                what = f"{len(self._imported)} files" if several else path.name
                outcome = replace(outcome, label=f"Import {what}")
            self._document.apply(outcome, self._gesture)
            if isinstance(outcome, Edit):
                self.done.emit(f"Imported {', '.join(self._imported)}")

        page.chosen.connect(put)
        page.finished.connect(lambda: self._pages.remove(page))
        # What is chosen there is told after it has closed.
        page.finished.connect(self._open_next, Qt.ConnectionType.QueuedConnection)
        self._pages.append(page)
        # One that has nothing to ask is seen where it takes long, so that it can be cancelled.
        if page.asks:
            page.show()
        else:
            QTimer.singleShot(_HIDDEN_MS, page, page.show)

    def _open_next(self) -> None:
        if self._waiting and not self._pages:
            self.open_page(*self._waiting.pop(0))

    def end(self) -> None:
        """Close all pages."""
        self._waiting = []
        for page in self.pages:
            page.reject()


class LibraryActions(QObject):
    """Saves clips of the open design as presets, and places presets whose files are dropped."""

    failed = Signal(str)
    #: What went well, as a short text.
    done = Signal(str)

    def __init__(self, document: Document, window: QtWidgets.QWidget) -> None:
        super().__init__(window)
        self._document, self._window = document, window

    def ask_and_save(self) -> "SavePage | None":
        """Open the page that asks for a name; None where there is no clip to save."""
        choices = pages.fragments_to_save(self._document.design, self._document.view)
        if not choices:
            self.failed.emit("There is no clip to save; add one first.")
            return None
        page = pages.SavePage(choices, self._window)

        def save(preset: "Preset") -> None:
            try:
                presets.save_preset(presets.users_folder(), preset)
            except SkinSourceError as error:
                page.show_problem(str(error))
                return
            self.done.emit(f"Saved “{preset.name}” to the library")
            page.close()

        page.chosen.connect(save)
        page.open()
        return page

    def place_file(self, path: Path, place: DropPlace | None) -> None:
        """Place the preset of a file where it was dropped, or at the playhead."""
        try:
            preset = presets.read_preset(path)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        design, view = self._document.design, self._document.view
        where = place or DropPlace()
        named = where.input_id is not None or where.location is not None
        outcome = edits.place_fragment(
            design,
            view,
            preset.fragment,
            preset.name,
            (where.onset_s or 0.0) if named else None,
            where.input_id,
            None if where.input_id is not None else where.location,
        )
        self._document.apply(outcome, None)


class MatchingActions(QObject):
    """Opens the matching page; ``page`` is that page while it is open."""

    def __init__(
        self,
        document: Document,
        preferences: Preferences,
        player: Player,
        window: QtWidgets.QWidget,
    ) -> None:
        super().__init__(window)
        self._document, self._preferences = document, preferences
        self._player, self._window = player, window
        self.page: Any = None

    def show(self) -> None:
        """Open the page; playback of the window ends."""
        settings = self._player.settings
        if not settings.rig_is_read():
            return
        gain_db = self._player.gain.gain_db
        self._player.stop()
        page = pages.MatchingPage(
            self._document.design.limb,
            self._preferences.folder,
            settings.output,
            settings.rig,
            gain_db,
            self._window,
        )
        page.finished.connect(self._forget)
        self.page = page
        page.open()

    def end(self) -> None:
        """Close the page, and release the device."""
        if self.page is not None:
            self.page.done(0)

    def _forget(self) -> None:
        self.page = None


class SceneActions(QObject):
    """Shows the gallery of scenes, and opens the scene that is chosen there.

    ``arrange`` shows the stage.
    """

    failed = Signal(str)
    #: The name of a scene that was opened.
    opened = Signal(str)
    #: What went well, as a short text.
    done = Signal(str)

    def __init__(self, services: Services, files: FileActions, arrange: Callable[[], None]) -> None:
        super().__init__(services.window)
        self._document, self._files, self._limbs = services.document, files, services.limbs
        self._window, self._arrange = services.window, arrange
        self._last = self._last_limb = ""

    def show(self) -> "ScenesPage":
        """Open the gallery; the scene that was opened last is selected."""
        page = pages.ScenesPage(self._limbs.names, self._last, self._window, limb=self._last_limb)
        page.chosen.connect(self.open)
        page.open()
        return page

    def open(self, name: str, limb: str = "") -> None:
        """Open a scene in place of the open design, after a question where that is not saved.

        Levels keep the chosen colours.  The scene is played on ``limb``; empty: on the limbs of the
        paper.
        """
        try:
            opened = scenes.open_scene(name, available=self._limbs.names, limb=limb)
        except SkinSourceError as error:
            self.failed.emit(str(error))
            return
        if not self._files.may_lose_changes():
            return
        view = with_colours_of(replace(opened.view, slow_motion=0.0), self._document.view)
        self._document.start_over(opened.design, view, None, scene=opened.scene.title)
        self._files.leave_file()
        self._last, self._last_limb = opened.scene.name, limb
        self._arrange()
        self.opened.emit(name)
        text = f"Opened {opened.scene.heading}"
        if opened.synthetic:
            text += ", on a SYNTHETIC limb"
        elif limb:
            text += f", on {limb_label(limb).title}"
        self.done.emit(text)
