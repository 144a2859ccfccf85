"""Play stimuli on all channels of a sound card, with a coded trigger, and log when each began.

    python play.py --list                      devices and their outputs
    python play.py                             every row of conditions.csv, in random order
    python play.py --trigger 5                 the code of the row on output 5
    python play.py --mask 7 8 --mask-db -30    noise for headphones on outputs 7 and 8
    python play.py --loopback 1 1              output 1 into input 1: delay and jitter

It needs numpy, sounddevice and soundfile, and nothing else: PsychoPy's own player takes two
channels, so this one is called beside it ("import play; play.session(...)"), or runs alone.
Levels start at -20 dB: full scale of a file is full scale of the device at 0 dB.
"""

import argparse
import csv
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import sounddevice
import soundfile

HERE = Path(__file__).resolve().parent
#: Length of each bit of a trigger: seen by any recorder at 1 kHz.
BIT_S = 0.005
BITS = 8
CLICK_S = 0.001
LOG_COLUMNS = ("trial", "stimulus", "trigger_code", "begin_dac_s", "latency_s", "underflows")


def trigger(code, rate_hz):
    """Samples that tell ``code``, 0 to 255: a high bit, 8 bits from the lowest on, a low one."""
    if not 0 <= code < 2**BITS:
        raise SystemExit(f"trigger_code is {code}, expected 0 to {2**BITS - 1}")
    bits = [1, *(code >> k & 1 for k in range(BITS)), 0]
    return np.repeat(np.array(bits, np.float32), round(BIT_S * rate_hz))


def code_in(samples, rate_hz):
    """The code that recorded ``samples`` hold, and the sample at which it begins; None: no code."""
    high = samples > 0.5 * np.max(np.abs(samples), initial=0.0)
    if not high.any():
        return None
    begin, step = int(np.argmax(high)), BIT_S * rate_hz
    middles = [begin + round((k + 0.5) * step) for k in range(1, BITS + 1)]
    if middles[-1] >= high.size:
        return None
    return sum(int(high[at]) << k for k, at in enumerate(middles)), begin


def noise(n_times, rate_hz, seed, low_hz=50.0, high_hz=2000.0):
    """Noise that hides what actuators sound like, a peak of 1."""
    spectrum = np.fft.rfft(np.random.default_rng(seed).standard_normal(n_times))
    at_hz = np.fft.rfftfreq(n_times, 1.0 / rate_hz)
    found = np.fft.irfft(np.where((at_hz >= low_hz) & (at_hz <= high_hz), spectrum, 0.0), n_times)
    return (found / max(np.max(np.abs(found), initial=0.0), 1e-9)).astype(np.float32)


def outputs_of(stimulus, code, rate_hz, options):
    """What every output plays, (n_times, n_outputs)."""
    masked = [number - 1 for number in options.mask]
    triggers = [] if options.trigger is None else [options.trigger - 1]
    taken = [number for number in (*masked, *triggers) if number < stimulus.shape[1]]
    if taken:
        raise SystemExit(
            f"output {taken[0] + 1} plays channel {taken[0] + 1} of the stimulus: choose outputs "
            f"from {stimulus.shape[1] + 1} on for trigger and noise"
        )
    marks = trigger(code, rate_hz)
    n_times = max(stimulus.shape[0], marks.size if triggers else 0)
    n_outputs = max([stimulus.shape[1], *(number + 1 for number in (*masked, *triggers))])
    found = np.zeros((n_times, n_outputs), np.float32)
    found[: stimulus.shape[0], : stimulus.shape[1]] = stimulus * 10.0 ** (options.gain_db / 20.0)
    for number in triggers:
        found[: marks.size, number] = marks
    for number in masked:
        level = 10.0 ** (options.mask_db / 20.0)
        found[:, number] = noise(n_times, rate_hz, code) * level
    if np.max(np.abs(found), initial=0.0) > 1.0:
        raise SystemExit("samples pass full scale: lower --gain-db or --mask-db")
    return found


class Playing:
    """One playback: hands out blocks, and notes when the first of them is heard."""

    def __init__(self, samples):
        self.samples, self.at = samples, 0
        self.begin_s, self.latency_s, self.underflows = None, None, 0

    def fill(self, block, n_times, about, status):
        """Give the next block to the sound card."""
        self.underflows += bool(status.output_underflow)
        if self.begin_s is None:
            self.begin_s = about.outputBufferDacTime
            self.latency_s = about.outputBufferDacTime - about.currentTime
        part = self.samples[self.at : self.at + n_times]
        block[: len(part)] = part
        block[len(part) :] = 0.0
        self.at += n_times
        if self.at >= len(self.samples):
            raise sounddevice.CallbackStop


def play(samples, rate_hz, device):
    """Play ``samples`` (n_times, n_outputs), wait until that is done, and give the `Playing`."""
    playing = Playing(samples)
    with explained():
        stream = sounddevice.OutputStream(
            samplerate=rate_hz,
            device=device,
            channels=samples.shape[1],
            dtype="float32",
            latency="low",
            callback=playing.fill,
        )
    with stream:
        while stream.active:
            time.sleep(0.005)
    if playing.at < len(samples):
        raise SystemExit(f"the device stopped after {playing.at / rate_hz:.3f} s: is it connected?")
    return playing


@contextmanager
def explained():
    """End with one sentence where the sound card does not do what it is asked for."""
    try:
        yield
    except (ValueError, sounddevice.PortAudioError) as error:
        raise SystemExit(f"{error}: see python play.py --list for devices and outputs") from error


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
    for trial, row in enumerate(rows, start=1):
        stimulus, rate_hz = soundfile.read(HERE / row["stimulus"], dtype="float32", always_2d=True)
        code = int(row["trigger_code"])
        done = play(outputs_of(stimulus, code, rate_hz, options), rate_hz, options.device)
        line = (trial, row["stimulus"], code, done.begin_s, done.latency_s, done.underflows)
        writer.writerow(line)
        log.flush()
        if trial < len(rows):
            time.sleep(options.pause_s)


def delays(recorded, clicks, rate_hz):
    """How long after each click, in s, it is seen in ``recorded``; NaN where it is not."""
    level = 0.5 * np.max(np.abs(recorded), initial=0.0)
    found = []
    for number, at in enumerate(clicks):
        end = clicks[number + 1] if number + 1 < len(clicks) else recorded.size
        seen = np.abs(recorded[at:end]) >= max(level, 1e-3)
        found.append(float(np.argmax(seen)) / rate_hz if seen.any() else float("nan"))
    return np.array(found)


def loopback(output, source, options, rate_hz=48000):
    """Play clicks on ``output``, record ``source``, and say how late and how steady they come."""
    step = round(0.2 * rate_hz)
    clicks = np.arange(1, options.repeats + 1) * step
    samples = np.zeros((int(clicks[-1]) + 2 * step, output), np.float32)
    for at in clicks:
        samples[at : at + round(CLICK_S * rate_hz), output - 1] = 0.5
    with explained():
        recorded = sounddevice.playrec(
            samples, rate_hz, channels=source, device=options.device, dtype="float32", blocking=True
        )[:, source - 1]
    found = delays(recorded, clicks, rate_hz)
    seen = found[np.isfinite(found)]
    if not seen.size:
        raise SystemExit(f"input {source} heard nothing of output {output}: check the cable")
    sys.stdout.write(
        f"{seen.size} of {found.size} clicks seen; delay {np.median(seen) * 1e3:.3f} ms, jitter "
        f"{np.std(seen) * 1e3:.4f} ms (largest difference {np.ptp(seen) * 1e3:.4f} ms)\n"
    )
    return found


def parsed(arguments=None):
    """The options of the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--list", action="store_true", help="show devices, and end")
    parser.add_argument("--device", type=lambda text: int(text) if text.isdigit() else text)
    parser.add_argument("--conditions", type=Path, default=HERE / "conditions.csv")
    parser.add_argument("--order", choices=("random", "listed"), default="random")
    parser.add_argument("--seed", type=int, default=1, help="of the random order")
    parser.add_argument("--gain-db", type=float, default=-20.0, help="of the stimulus")
    parser.add_argument("--pause-s", type=float, default=0.5, help="between trials")
    parser.add_argument("--trigger", type=int, metavar="OUTPUT", help="output for trigger codes")
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
