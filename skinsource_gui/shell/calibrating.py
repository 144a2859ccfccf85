"""Calibrating a person in the window: sweeps, focus and verification, as jobs."""

import re
import tomllib
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from PySide6 import QtWidgets
from PySide6.QtCore import QObject, Qt, Signal

from skinsource import lab, people
from skinsource.base.errors import SkinSourceError, counted, printable, sentence
from skinsource.base.files import path_text
from skinsource.base.job import Job, Progress, Stop, stop_if
from skinsource.design.comparing import related_limbs
from skinsource.design.design import Design
from skinsource.design.edits.edit import Edit
from skinsource.design.edits.setup import choose_rig
from skinsource.design.labels import limb_label
from skinsource.design.waveforms.tones import Tone
from skinsource.limbs.locations import output_name
from skinsource.limbs.own_limbs import facts_of
from skinsource_gui import pages
from skinsource_gui.panels.calibration.steps import FOCUS, SWEEPS, CalibrationState
from skinsource_gui.qt.questions import ask_open, ask_save, ask_to_save
from skinsource_gui.qt.resources import read_text
from skinsource_gui.state.job_runner import JobProgress
from skinsource_gui.state.panel import Panel
from skinsource_gui.state.playing import Player
from skinsource_gui.state.services import Services
from skinsource_gui.state.worker import fault_text

if TYPE_CHECKING:
    from skinsource.lab.calibrating import Calibration, Measured, StandIn, Verification
    from skinsource.people import PartialLimb
    from skinsource_gui.panels.calibration.panel import CalibrationPanel

_PANEL = "calibration"
#: What a focus plays, and its level at the sensor, m/s².
WAVEFORM, LEVEL = Tone(frequency_hz=100.0, duration_s=0.2), 0.3
_FILES = "Partial limbs (*.h5);;All files (*)"
_STOPPED = "Stopped. Nothing new was stored."


def _focus_of(
    opened: "PartialLimb", output: int, progress: Progress, stop: Stop
) -> "tuple[Design, None]":
    """Return the design of a focus on somebody who was opened; synthetic people have their kind."""
    like, others = opened.like, None
    if facts_of(like).synthetic:
        others = [name for name in related_limbs(like) if name != like]
    return people.focus(opened, output, others=others).design(WAVEFORM, level=LEVEL), None


class Calibrating(QObject):
    """Calibrates a person, as the panel asks for it, and makes the design of a focus.

    Parameters
    ----------
    services
        What the window has.
    player
        Ends before anything else is played; knows rig and device.
    arrange
        Shows the workspace of the panel.

    Attributes
    ----------
    make_stand_in
        Returns a stand-in person whose sensor lies on an output.
    """

    #: Another station was chosen.
    changed = Signal()
    _heard = Signal(object)  # from the thread

    def __init__(
        self,
        services: Services,
        player: Player,
        arrange: Callable[[], None],
    ) -> None:
        super().__init__(services.window)
        self._window, self._document = services.window, services.document
        self._runner, self._preferences = services.runner, services.preferences
        self._player, self._arrange = player, arrange
        self._panel: CalibrationPanel | None = None
        # A `Station`, once something is measured; only that of a stand-in person can be moved.
        self._station: Any = None
        self._job: Job[Any] | None = None
        # What is said while the tracks play a focus, and its design.
        self._focused: tuple[str, Design | None] = "", None
        # Whether what a rig measured is in no file; the stand-in person can always be asked again.
        self._unsaved = False
        self.make_stand_in: Callable[[int], StandIn] = lambda output: lab.calibrating.StandIn(
            output=output
        )
        self._heard.connect(self._note_heard, Qt.ConnectionType.QueuedConnection)
        self._runner.progressed.connect(self._show_progress)
        player.settings.changed.connect(self._follow_rig)
        self._document.changed.connect(self._follow_outputs)
        self._document.changed.connect(self._follow_focus)
        services.panels.each(self._meet)

    @cached_property
    def state(self) -> CalibrationState:
        """What is known."""
        setup = pages.setup_of(self._preferences.sensor_text)
        return CalibrationState(sitting=lab.calibrating.Sitting(), setup=setup)

    def show(self) -> None:
        """Show the panel in its workspace."""
        self._arrange()

    def may_lose(self) -> bool:
        """Return whether what was measured of a person is saved, or the user gives it up."""
        question = "What was measured is in no file. Save it?"
        return not self._unsaved or ask_to_save(self._window, "Calibration", question, self._save)

    def _meet(self, panel: Panel) -> None:
        if panel.name == _PANEL:
            self._panel = panel = cast("CalibrationPanel", panel)
            panel.field_edited.connect(self._edit)
            panel.asked.connect(self._do)
            self._player.settings.look_for_rig()
            self._follow_rig()
            self._follow_outputs()

    def _follow_outputs(self) -> None:
        """Take over the output that was selected last, until something is played."""
        outputs, opened = self._document.view.outputs, self.state.opened
        free = not self.state.places
        if opened is not None:
            free = bool(outputs) and outputs[-1] in opened.outputs
        if self._panel is not None and outputs and free:
            # The limb of the design may have more.
            output = min(outputs[-1], facts_of(self.state.sitting.like).n_outputs)
            self._put(sitting=replace(self.state.sitting, output=output))

    def _follow_rig(self) -> None:
        """Take over the rig of this machine; without one the stand-in person is chosen."""
        if self._panel is not None:
            title = self._player.settings.rig_title
            stands_in = not title or self._preferences.stand_in
            is_new = (title, stands_in) != (self.state.rig_title, self.state.stand_in)
            if is_new and self.may_lose():
                self.state = replace(self.state, rig_title=title)
                self._choose_station(stands_in)

    def _choose_station(self, stands_in: bool) -> None:
        """Begin anew with the stand-in person, or with the rig."""
        self._preferences.stand_in, self._unsaved = stands_in, False
        known = tomllib.loads(read_text("calibration.toml"))["STAND_IN"]
        texts = known if stands_in else dict.fromkeys(known, "")
        self._put(
            stand_in=stands_in,
            sitting=replace(self.state.sitting, **texts),
            places=(),
            rows=(),
            found=None,
            verification=None,
            opened=None,
            said=CalibrationState.said,
            warns=False,
        )
        self.changed.emit()

    def _put(self, **changes: Any) -> None:
        """Change what is known, and show it."""
        self.state = replace(self.state, **changes)
        if self._panel is not None:
            self._panel.show_calibration(self.state)

    def _edit(self, name: str, value: Any) -> None:
        state = self.state
        if name == "station":
            if self.may_lose():
                self._choose_station(value == "stand_in")
            self._put()
        elif name == "step":
            self._put(step=value)
        elif name == "output":
            self._document.look(replace(self._document.view, outputs=(int(value),)))
            self._put(sitting=replace(state.sitting, output=int(value)))
        elif hasattr(state.sitting, name):
            self._put(sitting=replace(state.sitting, **{name: value}))
        else:
            self._put(setup=replace(state.setup, **{name: value}))
            self._preferences.sensor_text = pages.setup_text(self.state.setup)

    def _do(self, name: str) -> None:
        """Do what a button asks for."""
        if name == "stop":
            if self._job is not None:
                self._runner.cancel(self._job)
                self._put(said="Stopping…")
            return
        try:
            getattr(self, f"_{name}")()
        except SkinSourceError as error:
            self._put(said=sentence(str(error)), warns=True)

    def _run(self, title: str, work: Callable[..., Any], take: Callable[[Any], object]) -> None:
        """Run a job; the panel shows it until it ends."""
        self._player.stop()

        def end(how: Callable[..., object], *what: object) -> None:
            self._job = None
            found = self.state.found
            self._put(running=False, rows=() if found is None else found.rows)
            how(*what)

        self._job = Job(title, work)
        self._put(running=True, said=f"{title}…", warns=False)
        self._runner.add(
            self._job,
            done=partial(end, take),
            failed=partial(end, lambda error: self._put(said=fault_text(error), warns=True)),
            cancelled=partial(end, partial(self._put, said=_STOPPED, warns=True)),
        )

    def _show_progress(self, job: Job[Any], progress: JobProgress) -> None:
        if job is self._job and self._panel is not None:
            self._panel.show_progress(progress.done, progress.total, progress.text)

    def _note_heard(self, measured: "Measured") -> None:
        if self._job is not None:
            others = (row for row in self.state.rows if row.place != measured.place)
            self._put(rows=(*others, measured))

    def _start(self) -> None:
        """Measure all inputs; what was measured before stays until that is done."""
        if not self.may_lose():
            return
        state, settings = self.state, self._player.settings
        if state.stand_in:
            station: Any = self.make_stand_in(state.sitting.output)
            like = station.like
        elif settings.rig_is_read() and settings.rig is not None:
            setup = replace(state.setup, input_device="", loopback_input=0)
            station = lab.calibrating.CardStation(
                rig=settings.rig, setup=setup, output=settings.output
            )
            like = lab.calibrating.Sitting().like
        else:
            return
        places = tuple(channel.place for channel in station.rig.channels)
        sitting = replace(state.sitting, like=like)
        self._put(sitting=sitting, places=places, step=SWEEPS, rows=(), opened=None)
        self._measure(station, None)

    def _repeat(self) -> None:
        """Measure again what was not accepted."""
        found = self.state.found
        kept = () if found is None or found.moved else found.rows
        self._put(rows=tuple(row for row in kept if not row.failures))
        self._measure(self._station, found)

    def _measure(self, station: Any, before: "Calibration | None") -> None:
        # Limbs of the other people; None: all measured ones.
        sitting, others = self.state.sitting, getattr(station, "others", None)

        def work(progress: Progress, stop: Stop) -> "tuple[Calibration, int]":
            found = lab.calibrating.calibrate(
                sitting,
                station,
                before=before,
                heard=self._heard.emit,
                progress=progress,
                stop=stop,
            )
            output = sitting.output
            # How unlike people are is known of the measured ones.
            if others is None and found.accepted:
                output = people.likeliest_place(found.partial, output)
            return found, output

        self._run("Calibrating a person", work, partial(self._take_measured, station))

    def _take_measured(self, station: Any, measured: "tuple[Calibration, int]") -> None:
        self._station, (found, likeliest) = station, measured
        said = f"All {len(found.rows)} inputs are accepted. Focus here makes a design of them."
        if found.moved:
            said = f"{found.moved} Check the sensor, then press Repeat failed."
        elif found.failures:
            (place, (reason, *_)), *_ = found.failures.items()
            said = (
                f"{counted(len(found.failures), 'input')} not accepted. Place {place}: {reason} "
                "Press Repeat failed, or go on without."
            )
        elif likeliest != found.sitting.output:
            name = output_name(likeliest, found.sitting.like).name
            said = f"It looks more like output {likeliest}, {name}. Check where the sensor lies."
        warns = not found.accepted or likeliest != found.sitting.output
        # Mounted anew, nothing is verified.
        self._put(found=found, rows=found.rows, verification=None, said=said, warns=warns)
        self._unsaved = self.state.has_partial and not self.state.stand_in

    def _open(self) -> None:
        """Ask for a partial limb file, and take the person in it in place of a measured one."""
        if not self.may_lose():
            return
        path = ask_open(self._window, "Open a measured person", _FILES, self._preferences.folder)
        if path is not None:
            self._preferences.folder = path.parent
            take = partial(self._take_opened, path)
            self._run("Opening a measured person", lambda **_: people.open_partial(path), take)

    def _take_opened(self, path: Path, opened: "PartialLimb") -> None:
        self._unsaved = False
        person, output = printable(opened.person), opened.outputs[0]
        sitting = replace(self.state.sitting, person=person, like=opened.like, output=output)
        self._put(
            sitting=sitting,
            step=SWEEPS,
            places=opened.inputs,
            rows=(),
            found=None,
            verification=None,
            opened=opened,
            said=f"Opened {path.name}. Focus here makes a design, which is not verified.",
            warns=False,
        )
        self._document.look(replace(self._document.view, outputs=(output,)))

    def _save(self) -> bool:
        """Ask for a file and write the partial limb; return whether that was done."""
        start = self._preferences.folder / f"{self._file_name}.h5"
        path = ask_save(self._window, "Save the partial limb", start, _FILES)
        if path is not None:
            people.save_partial(path, self._found.partial)
            self._preferences.folder, self._unsaved = path.parent, False
            self._put(said=f"Saved {path.name}.", warns=False)
        return path is not None

    @property
    def _found(self) -> "Calibration":
        """What was measured; buttons that need it are off until then."""
        return cast("Calibration", self.state.found)

    @property
    def _file_name(self) -> str:
        """Names person and output in letters that any file system takes."""
        sitting = self._found.sitting
        person = re.sub(r"[^\w.-]", "_", sitting.person)
        return f"{person}-{sitting.output}"

    @property
    def _begun(self) -> "Verification":
        """What is verified of a focus, as of `_found`."""
        return cast("Verification", self.state.verification)

    def _focus(self) -> None:
        """Make the design that is strong at the sensor and quiet elsewhere."""
        opened, output = self.state.opened, self.state.sitting.output
        if opened is not None:
            self._run("Focusing", partial(_focus_of, opened, output), self._take_focus)
            return
        found, others = self._found, getattr(self._station, "others", None)

        def work(progress: Progress, stop: Stop) -> "tuple[Design, Verification]":
            focus = people.focus(found.partial, found.sitting.output, others=others)
            begun = lab.calibrating.begin_verifying(
                found,
                focus,
                WAVEFORM,
                level=LEVEL,
                others=others,
                progress=progress,
                stop=stop,
            )
            stop_if(stop)
            return focus.design(WAVEFORM, level=LEVEL), begun

        self._run("Focusing", work, self._take_focus)

    def _take_focus(self, focused: "tuple[Design, Verification | None]") -> None:
        (design, begun), state, rig = focused, self.state, self._player.settings.rig
        sitting, ahead = state.sitting, ""
        if begun is not None:
            sitting, rig, ahead = begun.found.sitting, begun.found.rig, " Press Verify."
        title = f"Focus of {sitting.person}: {output_name(sitting.output, sitting.like).name}"
        seen = self._document.view
        view = replace(seen, outputs=(sitting.output,), selected_inputs=(), selected_clips=())
        edit: Any = Edit(label="Focus here", design=replace(design, title=title), view=view)
        if not state.stand_in:
            rigged = choose_rig(edit.design, view, rig)
            edit = replace(rigged, label=edit.label) if isinstance(rigged, Edit) else rigged
        self._document.apply(edit)
        said = (
            f"The tracks now play the focus. The skin map shows what they do on "
            f"{limb_label(sitting.like).title}, not on {sitting.person}.{ahead}"
        )
        self._focused = said, self._document.design
        self._put(verification=begun, step=FOCUS, said=said, warns=False)

    def _follow_focus(self) -> None:
        """Say that the tracks play the focus only as long as they do."""
        said, design = self._focused
        if said and self.state.said == said and self._document.design != design:
            verifies = self.state.verification is not None
            self._put(said="Verify plays the focus." if verifies else "")

    def _verify(self) -> None:
        """Play the focus, and compare the sensor with the prediction, at one place or all."""
        station, stands_in, begun = self._station, self.state.stand_in, self._begun
        if begun.next_output is None:
            begun = replace(begun, checks=())

        def work(progress: Progress, stop: Stop) -> "Verification":
            verified = begun
            while verified.next_output is not None:
                if stands_in:
                    station.output = verified.next_output
                verified = lab.calibrating.verify_next(
                    verified, station, progress=progress, stop=stop
                )
                if not stands_in:
                    break
            return verified

        self._run("Verifying the focus", work, self._take_verified)

    def _take_verified(self, verified: "Verification") -> None:
        said, ahead = "Report… writes all that was measured and played.", verified.next_output
        if ahead is not None:
            name = output_name(ahead, self.state.sitting.like).name
            said = f"Move the sensor to output {ahead}, {name}, then press Verify."
        self._put(verification=verified, said=said, warns=False)

    def _report(self) -> None:
        """Ask for a folder, and write the report into a new one there."""
        name = QtWidgets.QFileDialog.getExistingDirectory(
            self._window, "Folder of the report", str(self._preferences.folder)
        )
        if name:
            folder = Path(name) / f"{self._file_name}-{datetime.now():%Y-%m-%d-%H%M%S}"
            lab.calibrating.save_report(folder, self._begun)
            self._preferences.folder, self._unsaved = Path(name), False
            self._put(said=f"Wrote the report into {path_text(folder)}.", warns=False)
