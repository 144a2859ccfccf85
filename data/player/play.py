"""Play stimuli on all channels of a sound card, with a coded trigger, and log when each began.

    python play.py --list                      devices and their outputs
    python play.py                             every row of conditions.csv, in random order
    python play.py --trigger 5                 the code of the row on output 5
    python play.py --lsl                       a marker for each onset (Lab Streaming Layer)
    python play.py --mask 7 8 --mask-db -30    noise for headphones on outputs 7 and 8
    python play.py --loopback 1 1              output 1 into input 1: delay and jitter

It needs skinsource with its extra "audio".  PsychoPy's own player takes two channels, so this one
is called beside it ("import play; play.session(...)"), or runs alone.  Levels start at -20 dB: full
scale of a file is full scale of the device at 0 dB.
"""

import argparse
import csv
import sys
import time
from pathlib import Path

import numpy as np
import sounddevice
import soundfile

import skinsource as ss
from skinsource.engine.stimulus import stimulus_of_outputs

HERE = Path(__file__).resolve().parent
LOG_COLUMNS = (
    "trial",
    "stimulus",
    "trigger_code",
    "begin_dac_s",
    "onset_monotonic_s",
    "latency_s",
    "loopback_s",
    "onset",
    "underflows",
)


def noise(n_times, rate_hz, seed, low_hz=50.0, high_hz=2000.0):
    """Noise that hides what actuators sound like, a peak of 1."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(n_times))
    at_hz = np.fft.rfftfreq(n_times, 1.0 / rate_hz)
    found = np.fft.irfft(np.where((at_hz >= low_hz) & (at_hz <= high_hz), spectrum, 0.0), n_times)
    return found / max(np.max(np.abs(found), initial=0.0), 1e-9)


def player_of(row, options, began=None):
    """The player of a row of conditions, with noise for the ears."""
    samples, rate_hz = soundfile.read(HERE / row["stimulus"], always_2d=True)
    samples = samples.T * 10.0 ** (options.gain_db / 20.0)
    taken = [number for number in options.mask if number <= len(samples)]
    if taken:
        raise SystemExit(
            f"output {taken[0]} plays channel {taken[0]} of the stimulus: choose outputs from "
            f"{len(samples) + 1} on for noise"
        )
    played = dict(enumerate(samples, start=1))
    level = 10.0 ** (options.mask_db / 20.0)
    for number in options.mask:
        played[number] = level * noise(samples.shape[1], rate_hz, int(row["trigger_code"]))
    wired = tuple((number, number) for number in played)
    return ss.Player(
        stimulus_of_outputs(played, rate_hz),
        device=ss.Output(device=options.device, sample_rate_hz=rate_hz, outputs=wired),
        gain_db=0.0,
        trigger_output=options.trigger,
        loopback_s=options.loopback_s,
        began=began,
    )


def unused(path):
    """``path``, or with a number behind its name: no log of an earlier session is lost."""
    number = 1
    found = path
    while found.exists():
        number += 1
        found = path.with_name(f"{path.stem}-{number}{path.suffix}")
    return found


def session(rows, options, log):
    """Play ``rows`` of conditions in their order; write a line of the log for each at once."""
    writer = csv.writer(log)
    writer.writerow(LOG_COLUMNS)
    markers = ss.Markers() if options.lsl else None
    for trial, row in enumerate(rows, start=1):
        code = int(row["trigger_code"])
        with player_of(row, options, markers) as player:
            done = player.play(code=code)
            done.wait()
        line = (done.first_sample_s, done.onset_monotonic_s, done.latency_s, done.loopback_s)
        writer.writerow((trial, row["stimulus"], code, *line, done.onset_is, done.underruns))
        log.flush()
        if trial < len(rows):
            time.sleep(options.pause_s)


def loopback(output, source, options):
    """Play clicks on ``output``, record ``source``, and say how late and how steady they come."""
    found = ss.rig_measuring.loopback(output, source, options.device, repeats=options.repeats)
    told = "unknown" if found.behind_s is None else f"{found.behind_s:.6f}"
    sys.stdout.write(
        f"{found.n_seen} of {options.repeats} clicks seen; round trip "
        f"{found.round_trip_s * 1e3:.3f} ms, jitter {found.jitter_s * 1e3:.4f} ms; behind the "
        f"times of the device: {told} s (--loopback-s)\n"
    )


def parsed(arguments=None):
    """The options of the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="show devices, and end")
    parser.add_argument("--device", default="", help="its name; without, that of the system")
    parser.add_argument("--conditions", type=Path, default=HERE / "conditions.csv")
    parser.add_argument("--order", choices=("random", "listed"), default="random")
    parser.add_argument("--seed", type=int, default=1, help="of the random order")
    parser.add_argument("--gain-db", type=float, default=-20.0, help="of the stimulus")
    parser.add_argument("--pause-s", type=float, default=0.5, help="between trials")
    parser.add_argument("--trigger", type=int, metavar="OUTPUT", help="output for trigger codes")
    parser.add_argument("--lsl", action="store_true", help="send markers; extra lsl")
    parser.add_argument("--loopback-s", type=float, help="delay that --loopback measured, s")
    parser.add_argument("--mask", type=int, nargs="+", default=[], metavar="OUTPUT")
    parser.add_argument("--mask-db", type=float, default=-30.0, help="level of the noise")
    parser.add_argument("--log", type=Path, default=HERE / "log.csv")
    parser.add_argument("--loopback", type=int, nargs=2, metavar=("OUTPUT", "INPUT"))
    parser.add_argument("--repeats", type=int, default=20, help="clicks of the loopback test")
    return parser.parse_args(arguments)


def main(arguments=None):
    """Do what the command line says."""
    options = parsed(arguments)
    if options.list:
        sys.stdout.write(f"{sounddevice.query_devices()}\n")
        return
    try:
        run(options)
    except ss.SkinSourceError as error:
        raise SystemExit(f"{error} (python play.py --list shows devices)") from error


def run(options):
    """Measure a loopback, or play a session."""
    if options.loopback:
        loopback(*options.loopback, options)
        return
    with options.conditions.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if options.order == "random":
        rows = [rows[k] for k in np.random.default_rng(options.seed).permutation(len(rows))]
    path = unused(options.log)
    with path.open("x", newline="", encoding="utf-8") as log:
        session(rows, options, log)
    sys.stdout.write(f"{path}\n")


if __name__ == "__main__":
    main()
