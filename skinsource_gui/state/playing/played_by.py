"""What can be told of a player."""

from skinsource.actuators import rigs
from skinsource.design.design import Design
from skinsource.lab.playing.devices import outputs_by_place
from skinsource_gui.played import Played
from skinsource_gui.state.playing.player import Player
from skinsource_gui.state.playing.sound_settings import SoundSettings


def _calibration(settings: SoundSettings, design: Design) -> str:
    """Whether m/s² follow from what is played, in words."""
    if settings.rig_problem:
        return settings.rig_problem
    if settings.rig is None:
        return ""
    places = tuple(dict.fromkeys(one.location for one in design.inputs))
    return rigs.calibration_words(settings.rig, places)


def played_by(player: Player, design: Design) -> Played:
    """What is played now, on what, and how loud."""
    settings, stream = player.settings, player.now.stream if player.now else None
    mix = None if stream is None else stream.deck.mix
    render_s = player.edits.render_s
    return Played(
        playing=player.playing,
        looked=settings.looked,
        devices=settings.devices,
        missing=settings.missing,
        output=settings.output,
        rates_hz=settings.rates_hz,
        wired=tuple(outputs_by_place(design, settings.output, settings.rig).items()),
        rig_title=settings.rig_title,
        calibration=_calibration(settings, design),
        names=() if mix is None else mix.names,
        levels=None if stream is None else stream.deck.levels(),
        delay=None if stream is None or not render_s else stream.delay(render_s),
        underruns=0 if stream is None else stream.underruns,
        gain_db=player.gain.gain_db,
        loops=player.loops,
    )
