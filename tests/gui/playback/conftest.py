"""A window on made-up devices, whose blocks are kept."""

import pytest

from skinsource.design.design import Design, track
from skinsource.design.waveforms.tones import Tone
from skinsource.lab.playing.devices import Output
from tests.core.playing.synthetic_sound import SyntheticSoundLibrary, use

TONE = Tone(frequency_hz=100.0, duration_s=0.5)
DESIGN = Design(
    limb="synthetic-1",
    inputs=(track(7, TONE, amplitude=0.9), track(12, TONE, amplitude=0.5, colour=1)),
)


@pytest.fixture
def sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary(Two=2, Eight=8))


@pytest.fixture
def no_sound(monkeypatch):
    return use(monkeypatch, SyntheticSoundLibrary())


@pytest.fixture
def studio(open_window, qtbot):
    window = open_window(DESIGN)
    window.activateWindow()
    yield window
    player, settings = window.playback.player, window.playback.player.settings
    player.stop_at_once()
    qtbot.waitUntil(lambda: not player.playing, timeout=20_000)
    if player.loops:
        player.toggle_loop()
    settings.choose_rig(None)
    settings.choose(Output())
    settings.searched, settings._rig_was_read = False, False
    settings.devices, settings.rates_hz = (), ()
    settings.missing = settings._search_error = ""


@pytest.fixture
def player(studio):
    return studio.playback.player


@pytest.fixture
def panel(studio, player, qtbot):
    """The panel of playback, with what there is to choose from."""
    studio.do("show_output")
    qtbot.waitUntil(lambda: player.settings.searched, timeout=20_000)
    panel = studio.panel("output")
    if not panel._settings.more:
        panel.more.click()
    return panel


@pytest.fixture
def arm(qtbot, player):
    """Arm the actuators."""

    def begin():
        player.arm(True)
        qtbot.waitUntil(lambda: player.peak is not None, timeout=20_000)

    return begin


@pytest.fixture
def animate(qtbot, studio, player):
    """Press Space, and wait until the wave runs."""

    def begin():
        studio.do("play")
        qtbot.waitUntil(lambda: player.now is not None, timeout=20_000)
        return player.now

    return begin


@pytest.fixture
def listen(qtbot, studio, player, arm):
    """Play on actuators, and wait until something is heard."""

    def begin(**changes):
        if changes.get("loops"):
            studio.do("repeat")
        arm()
        studio.do("play_on_actuators")
        qtbot.waitUntil(lambda: player.now is not None, timeout=20_000)
        return player.now

    return begin
