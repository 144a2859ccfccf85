"""The page of rigs."""

from functools import partial
from pathlib import Path

from PySide6.QtCore import QSignalBlocker, Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QDialog,
    QFileDialog,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QListWidget,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)

from skinsource.actuators.equalising import RegularisedInverse
from skinsource.actuators.measured_response import MeasuredResponse
from skinsource.actuators.measuring import open_response
from skinsource.actuators.rigs import SUFFIX
from skinsource.base.errors import InvalidInputError, SkinSourceError
from skinsource.base.files import named
from skinsource.base.quoting import sentence
from skinsource.design import edits
from skinsource.design.edits import Refusal
from skinsource.design.signal_path import actuation_of_rig
from skinsource_gui.rig_page.channel_fields import ChannelFields, title_of
from skinsource_gui.rig_page.draft import RigDraft
from skinsource_gui.rig_page.measure_page import MeasurePage
from skinsource_gui.state.document import Document
from skinsource_gui.state.playing.sound_settings import SoundSettings
from skinsource_gui.state.playing.sound_thread import SoundThread
from skinsource_gui.theme import UNIT_PX
from skinsource_gui.widgets.asking import saved_or_given_up
from skinsource_gui.widgets.page_button import page_button
from skinsource_gui.widgets.rig_field import RESPONSE_FILES

_KINDS = f"Rigs (*{SUFFIX});;All files (*)"
_ENDS = (("open", "Open…"), ("save", "Save…"), ("close", "Close"))
_NOTHING = "No channel yet: add one for each actuator."


class RigPage(QDialog):
    """Opens, edits and saves a rig file, channel by channel.

    Parameters
    ----------
    document
        What can be predicted through it.
    settings
        Of playing: what this machine plays for.

    Attributes
    ----------
    draft
        What is edited.
    """

    def __init__(
        self,
        document: Document,
        settings: SoundSettings,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setObjectName("rig_page")
        self.setWindowTitle("Rig")
        self.resize(860, 640)
        self._document, self._settings, self._thread = document, settings, SoundThread(self)
        settings.look_for_rig()
        path = settings.rig_path if settings.rig is not None else None
        self.draft = RigDraft(settings.rig, path, document.design, self)
        self._title = QLineEdit()
        self._title.setObjectName("rig_title")
        self._title.setAccessibleName("Title")
        self._title.setPlaceholderText("Title of the rig")
        self.channels = QListWidget()
        self.channels.setObjectName("rig_channels")
        self.channels.setAccessibleName("Channels")
        self.fields = ChannelFields(self)
        self.words = QLabel()
        self.words.setObjectName("rig_words")
        self.words.setWordWrap(True)
        self._use = QCheckBox("Play for it on this machine")
        self._use.setObjectName("rig_use")
        self._use.setChecked(True)
        self._lay_out()
        self._connect()
        self._show(0)

    def done(self, result: int) -> None:
        """Close it; what was not saved is asked about."""
        if self.draft.unsaved and not self._agreed():
            return
        self._thread.end(_nothing)
        super().done(result)

    def button(self, name: str) -> QPushButton:
        """One of its buttons."""
        return self.findChildren(QPushButton, f"rig_{name}")[0]

    def _lay_out(self) -> None:
        left = QVBoxLayout()
        left.addWidget(self._title)
        left.addWidget(self.channels, 1)
        left.addLayout(_row(("add", "Add channel"), ("remove", "Remove channel")))
        scroll = QScrollArea()
        scroll.setObjectName("rig_fields")
        scroll.setFrameShape(QFrame.Shape.NoFrame)
        scroll.setWidgetResizable(True)
        scroll.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scroll.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        scroll.setWidget(self.fields.widget)
        both = QHBoxLayout()
        both.setSpacing(2 * UNIT_PX)
        both.addLayout(left, 2)
        both.addWidget(scroll, 3)
        whole = QVBoxLayout(self)
        whole.addLayout(both, 1)
        whole.addWidget(self.words)
        ends = _row(("predict", "Predict through it"), *_ENDS)
        ends.insertWidget(0, self._use)
        ends.insertStretch(1, 1)
        whole.addLayout(ends)

    def _connect(self) -> None:
        self.draft.changed.connect(self._show)
        self.draft.said.connect(self._say)
        self._title.textEdited.connect(self.draft.entitle)
        self.channels.currentRowChanged.connect(self._show_channel)
        self.fields.edited.connect(
            lambda channel: self.draft.take_channel(self.channels.currentRow(), channel)
        )
        self.fields.refused.connect(self._say)
        self.fields.from_file.clicked.connect(self._ask_response)
        self.fields.measure.clicked.connect(self._measure)
        self.fields.forget.clicked.connect(partial(self._take_response, None))
        for name, method in (
            ("add", self._add),
            ("remove", self._remove),
            ("open", self._open),
            ("save", self._save),
            ("predict", self._predict),
            ("close", self.reject),
        ):
            self.button(name).clicked.connect(method)

    def _show(self, row: int) -> None:
        """Show the rig, and one of its channels."""
        draft, channels = self.draft, self.draft.rig.channels
        if self._title.text() != draft.rig.title:
            self._title.setText(draft.rig.title)
        with QSignalBlocker(self.channels):
            self.channels.clear()
            limb = self._document.design.limb
            self.channels.addItems([title_of(one, limb) for one in channels])
            self.channels.setCurrentRow(min(row, len(channels) - 1))
        self._show_channel(self.channels.currentRow())
        self.button("remove").setEnabled(bool(channels))
        changed = " (changed)" if draft.unsaved else ""
        where = named(Path(draft.path.name)) if draft.path is not None else "not saved yet"
        self._say(f"The rig is {where}{changed}" if channels else _NOTHING)

    def _show_channel(self, row: int) -> None:
        self.fields.show_channel(self.draft.rig.channels[row] if row >= 0 else None)

    def _say(self, words: str) -> None:
        self.words.setText(sentence(words))

    def _add(self) -> None:
        self.draft.add(self.channels.currentRow())

    def _remove(self) -> None:
        self.draft.remove(self.channels.currentRow())

    def _ask_response(self) -> None:
        name, _ = QFileDialog.getOpenFileName(self, "Response of the actuator", "", RESPONSE_FILES)
        if name:
            self._say("Reading…")
            self._thread.do(partial(open_response, Path(name)), self._take_response)

    def _measure(self) -> None:
        """Open the page that measures this channel."""
        row = self.channels.currentRow()
        channel = self.draft.rig.channels[row]
        page = MeasurePage(channel, self._settings, self)
        page.kept.connect(lambda found: self._take_response(found.response))
        page.open()

    def _take_response(
        self, found: MeasuredResponse | None, error: SkinSourceError | None = None
    ) -> None:
        if error is not None:
            self._say(str(error))
        else:
            self.draft.take_response(self.channels.currentRow(), found)

    def _open(self) -> None:
        if self.draft.unsaved and not self._agreed():
            return
        name, _ = QFileDialog.getOpenFileName(self, "Open a rig", "", _KINDS)
        if name:
            self.draft.open(Path(name))

    def _save(self) -> None:
        draft = self.draft
        start = str(draft.path or f"{draft.rig.title or 'rig'}{SUFFIX}")
        name, _ = QFileDialog.getSaveFileName(self, "Save the rig", start, _KINDS)
        path = Path(name if Path(name).suffix else f"{name}{SUFFIX}")
        if name and draft.save(path):
            if self._use.isChecked():
                self._settings.choose_rig(path)
            self._show(self.channels.currentRow())
            self._say(f"Saved {named(Path(path.name))}")

    def _predict(self) -> None:
        """Let the design be predicted through these actuators, equalised as it was."""
        design, view = self._document.design, self._document.view
        known = design.actuation
        equaliser = RegularisedInverse() if known is None else known.equaliser
        try:
            through = actuation_of_rig(self.draft.rig, equaliser)
        except InvalidInputError as error:
            self._say(str(error))
            return
        outcome = edits.predict_through(design, view, through)
        if isinstance(outcome, Refusal):
            self._say(outcome.sentence)
        else:
            self._document.apply(outcome)
            self._say(f"Predicted through {through.words}")

    def _agreed(self) -> bool:
        """Whether changes may go: they are saved now, or the user gives them up."""

        def save() -> bool:
            self._save()
            return not self.draft.unsaved

        question = "The changes of the rig are not saved. Save them?"
        return saved_or_given_up(self, "Changes of the rig", question, save)


def _row(*buttons: tuple[str, str]) -> QHBoxLayout:
    found = QHBoxLayout()
    for name, words in buttons:
        found.addWidget(page_button(f"rig_{name}", words))
    return found


def _nothing() -> None:
    """Nothing is left to do."""
