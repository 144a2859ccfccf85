"""What the Play menu does."""

from skinsource_gui.shell.action_spec import ActionSpec, action

PLAY: tuple[ActionSpec, ...] = (
    action(
        "play",
        "Play",
        "Play or stop",
        "Play from the playhead on; without a device the playhead runs in silence",
        "Space",
        command="player.play_or_stop",
        keywords="audition listen feel start pause transport sound device",
    ),
    action(
        "stop_at_once",
        "Play",
        "Stop at once",
        "Silence within a millisecond, and the gain back at where it starts (Esc Esc)",
        command="player.stop_at_once",
        keywords="panic emergency silence halt mute",
    ),
    action(
        "repeat",
        "Play",
        "Repeat or not",
        "Play the whole design again and again; a loop on the ruler is repeated in any case",
        "Ctrl+L",
        command="player.toggle_loop",
        keywords="loop cycle again",
        separated=True,
    ),
    action(
        "play_louder",
        "Play",
        "Louder",
        "Turn the gain up by 1 dB",
        "Ctrl+Shift+Up",
        command="gain.turn_up",
        keywords="gain volume level",
    ),
    action(
        "play_softer",
        "Play",
        "Softer",
        "Turn the gain down by 1 dB",
        "Ctrl+Shift+Down",
        command="gain.turn_down",
        keywords="gain volume level quieter",
    ),
    action(
        "show_playback",
        "Play",
        "Playback",
        "Device, channel map, test tones, levels and delay",
        "F5",
        command="panel_focus.show",
        argument="playback",
        keywords="audio sound card output channel map sonify headphones latency meter device",
        separated=True,
    ),
)
