"""A monkey at the studio: thousands of deeds at random, and what must hold meanwhile."""

import gc
import threading
from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QObject, Qt
from PySide6.QtWidgets import QApplication

import skinsource as ss
from skinsource.design.design import View
from skinsource.design.panel_settings import settings_of, with_settings
from skinsource_gui.panels.skin.settings import LEVELS, SkinSettings
from skinsource_gui.state.document import MOST_STEPS
from skinsource_gui.state.preferences import start_design
from tests.gui.monkey import deeds_in_fields as fields
from tests.gui.monkey import deeds_on_canvases as canvases
from tests.gui.monkey.hands import Hands
from tests.gui.monkey.plain_levels import plain_levels
from tests.gui.monkey.watch import Watch

#: Deeds, and how often each is done.
DEEDS = (
    *(10 * [canvases.on_lanes] + 5 * [canvases.on_hand] + 5 * [canvases.in_editor]),
    *(3 * [canvases.on_heads]),
    *(2 * [canvases.on_plots] + 6 * [fields.of_menus] + 8 * [fields.press_keys]),
    *(8 * [fields.in_numbers] + 4 * [fields.in_lists] + 4 * [fields.on_buttons]),
    *(2 * [fields.in_rows] + [fields.on_docks, fields.on_window, fields.in_pages]),
)
COMPARED_EVERY = 100
_IMPORTED_EVERY = 150
#: Painting takes longest; what is done between two paintings is what a quick hand does.
_PAINTED_EVERY = 5
#: Each panel in sight takes its time.
_TIDIED_EVERY = 20
_STEPS_AT_ONCE = 100
#: Larger designs are taken back: what is tried is what can be done, not how long it may take.
_LONGEST_S, _MOST_INPUTS, _MOST_CLIPS = 8.0, 8, 60
_TOLERANCE_DB = 1e-6
#: What may be made late and kept, in objects: pages, menus, rows of a list, and two large panels,
#: as Output, which has 210, and Library; once all are made, more deeds add nothing.
KEPT_LATE = 400
#: Threads that may be made late and kept: what plays has one, what reads responses of a rig, and
#: jobs that are quick have one beside long ones.
THREADS_LATE = 3


@dataclass(slots=True)
class Tally:
    """What a monkey did and found.

    Attributes
    ----------
    deeds
        How often each was done.
    compared, silent, impossible
        How often levels were compared; how many of them were of designs without clips; and how
        often studio and `skinsource.predict` both refused.
    largest_difference_db
        Of a level shown from that of `plain_levels`.
    undone, saved
        Steps that were taken back and done again; designs that were saved and opened.
    objects, threads
        What lives half way and at the end, by its kind, once the design is empty and nothing is
        open.
    faults
        What was wrong, in words.
    """

    deeds: Counter[str] = field(default_factory=Counter)
    compared: int = 0
    silent: int = 0
    impossible: int = 0
    largest_difference_db: float = 0.0
    undone: int = 0
    saved: int = 0
    objects: list[Counter[str]] = field(default_factory=list)
    threads: list[int] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)


class Monkey:
    """Plays with one window.

    Parameters
    ----------
    window
        The studio.
    seed
        What it does.
    folder
        Where it may write.
    recordings
        Files that it may import.
    """

    def __init__(self, window, seed: int, folder: Path, recordings: tuple[Path, ...] = ()) -> None:
        #: What gives the levels to compare with; another process may.
        self.levels = plain_levels
        #: Is told now and then how many deeds are done.
        self.tell = lambda count: None
        self.window, self.document = window, window.document
        self.hands = Hands(window, seed, folder, recordings)
        self.tally, self._watch = Tally(), Watch()
        self._file = folder / "round trip.skinsource"
        self._base = self.document.design
        self.document.jumped.connect(self._remember_start)

    def play(self, count: int) -> Tally:
        """Do ``count`` deeds; the tally tells what was wrong."""
        self.window.engine.finished.connect(self._watch.on_outcome)
        with self._watch.looking(), self.hands.answering():
            for k in range(1, count + 1):
                self._do_something(k)
                self._check_state()
                if k % COMPARED_EVERY == 0 or k == count:
                    self._compare_levels()
                    self._compare_muted()
                    self._check_history()
                    self._check_file()
                    self.tell(k)
                if k in (count // 2, count):
                    self._count_objects()
                if self._watch.faults or self.tally.faults:
                    break
        self.tally.faults += self._watch.faults
        return self.tally

    @property
    def last_deeds(self) -> str:
        """What was done last, to be repeated by hand."""
        return "\n".join(map(str, self.hands.done))

    def _do_something(self, k: int) -> None:
        hands = self.hands
        deed = fields.import_recording if k % _IMPORTED_EVERY == 0 else hands.one_of(DEEDS)
        hands.done.append((k, deed.__name__))
        deed(hands)
        self.tally.deeds[deed.__name__] += 1
        if k % _PAINTED_EVERY == 0:
            QApplication.processEvents()
        hands.close_what_opened()
        if k % _TIDIED_EVERY == 0:
            self.window.do("arrange_design")
        self._keep_small()

    def _remember_start(self) -> None:
        # One deed may open a file and edit it: where a history begins is told when it begins.
        if self.document.undo_stack.count() == 0:
            self._base = self.document.design

    def _keep_small(self) -> None:
        """Take back what makes the design long or large; begin anew where that is no edit."""
        for _ in range(40):
            if not self._large():
                return
            if not self.document.undo_stack.canUndo():
                break
            self.window.do("undo")
        if self._large():
            self._begin_anew()

    def _begin_anew(self) -> None:
        # Nobody is asked about what was saved.
        self.document.mark_saved(self.document.path)
        self.window.files.new()

    def _large(self) -> bool:
        design = self.document.design
        end_s = max((clip.end_s for clip in design.clips), default=0.0)
        return (
            end_s > _LONGEST_S
            or len(design.inputs) > _MOST_INPUTS
            or len(design.clips) > _MOST_CLIPS
        )

    def _check_state(self) -> None:
        design, view = self.document.design, self.document.view
        clips = [clip.id for clip in design.clips]
        self._expect(len(set(design.ids)) == len(design.ids), "two inputs have one id")
        self._expect(len(set(clips)) == len(clips), "two clips have one id")
        self._expect(set(view.selected_inputs) <= set(design.ids), "a ghost input is selected")
        self._expect(set(view.selected_clips) <= set(clips), "a ghost clip is selected")
        notice = self.window.notice.text
        self._expect("made a mistake" not in notice, f"the studio says: {notice}")
        gestures = self.window.panel("timeline").lanes.mouse.busy
        self._expect(not gestures, "no button is down, yet a gesture goes on in the timeline")

    def _settle(self) -> None:
        self.window.catch_up()
        QApplication.processEvents()
        self.window.catch_up()

    def _compare_muted(self) -> None:
        """The same once a clip, and then a track, is muted: what is silent is easily forgotten."""
        for mute in (self._mute_clip, self._mute_track):
            mute()
            self._compare_levels()
            mute()

    def _mute_clip(self) -> None:
        canvases.shown_panel(self.hands, "timeline").lanes.setFocus()
        self.hands.key(Qt.Key.Key_M)

    def _mute_track(self) -> None:
        self.window.do("mute_input")

    def _compare_levels(self) -> None:
        self.hands.close_what_opened()
        # An arrangement comes back as it was left, with something in front of the map perhaps.
        self.window.do("arrange_design")
        self.window.workspaces.bring("skin")
        self._show_levels()
        self._settle()
        design, view = self.document.design, self.document.view
        shown = self.window.panel("skin").map.content
        try:
            expected = self.levels(design, view)
        except ss.SkinSourceError as error:
            # Only what the studio refuses too.
            self.tally.impossible += 1
            message = self.window.notice.text
            self._expect(bool(message), f"predict refuses ({error}), the studio says nothing")
            return
        self._expect(not self.window.panel("skin").is_stale, "the map is outdated at rest")
        values = shown.values
        if values is None:
            self._expect(False, f"no levels are shown at rest; notice: {self.window.notice.text}")
            return
        difference = float(np.max(np.abs(np.asarray(values) - expected)))
        self.tally.compared += 1
        self.tally.silent += not any(track.clips for track in design.inputs)
        self.tally.largest_difference_db = max(self.tally.largest_difference_db, difference)
        self._expect(
            difference <= _TOLERANCE_DB,
            f"levels shown are {difference:.3g} dB off ss.predict, for {design} seen as {view}",
        )

    def _show_levels(self) -> None:
        """Have the map show levels again, where it is covered, in time or in motion."""
        if self.window.panel("skin").map.content.message == "Covered":
            self.window.do("cover_map")
        view = self.document.view
        settings = settings_of(view, "skin", SkinSettings)
        if settings.quantity != LEVELS:
            self.document.look(with_settings(view, "skin", replace(settings, quantity=LEVELS)))
        if self.window.playback.player.playing:
            self.window.do("play")

    def _check_history(self) -> None:
        """Undo all the way back gives what was there at first, and redo what was there at last."""
        stack, last = self.document.undo_stack, self.document.design
        index = stack.index()
        if stack.count() >= MOST_STEPS:
            return
        self._go_to(0)
        self._expect(self.document.design == self._base, "undoing all does not lead to the start")
        self._go_to(index)
        self._expect(self.document.design == last, "redoing all does not lead to the end")
        self.tally.undone += index

    def _go_to(self, index: int) -> None:
        """Show each step on the way, and let Qt delete now and then what they leave."""
        stack = self.document.undo_stack
        while stack.index() != index:
            by = index - stack.index()
            stack.setIndex(stack.index() + max(-_STEPS_AT_ONCE, min(by, _STEPS_AT_ONCE)))
            self.window.catch_up()

    def _check_file(self) -> None:
        design, view = self.document.design, self.document.view
        ss.save_design(self._file, design, view)
        content = ss.open_design(self._file)
        self._expect(content.design == design, "what was saved is not what is opened")
        self._expect(content.view == view, "the view that was saved is not the one opened")
        self.tally.saved += 1

    def _count_objects(self) -> None:
        """Count what lives, and see that it is no more than half way."""
        self._begin_anew()
        # The inspector keeps the fields of what it showed last: of a tone, each time.
        self.document.start_over(start_design(self._base.limb), View(), None)
        self._settle()
        for _ in range(3):
            QApplication.processEvents()
            QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        gc.collect()
        counts = Counter(type(item).__name__ for item in self.window.findChildren(QObject))
        counts["windows"] = len(QApplication.topLevelWidgets())
        self.tally.objects.append(counts)
        self.tally.threads.append(threading.active_count())
        more = counts - self.tally.objects[0]
        self._expect(
            more.total() <= KEPT_LATE, f"{more.total()} more than half way: {more.most_common(12)}"
        )
        late = self.tally.threads[-1] - self.tally.threads[0]
        self._expect(late <= THREADS_LATE, f"threads: {self.tally.threads}")

    def _expect(self, holds: bool, fault: str) -> None:
        if not holds:
            self.tally.faults.append(fault)
