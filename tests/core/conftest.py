"""What many tests share: running commands, and the process that reads files.

What the tests of stability share: the table of promises, made-up limbs, both ways to predict.
``docs/stability.md`` states by case what is measured, and the largest number that keeps the
promise.  The tests hand their numbers to ``noted``.

    python -m pytest tests/core -k stability --stability-table docs/stability.md
"""

import platform
import re
from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from pathlib import Path

import mpmath
import numpy as np
import pytest
import scipy

from skinsource import Design, Limb, View, load_limb, predict, track
from skinsource.base.errors import InvalidInputError
from skinsource.cli.command_line import main
from skinsource.design.waveforms.pulses import Impulse
from skinsource.engine.quantities import new_graph, sources
from skinsource.readers.reading_process import ReadingProcess

DOCUMENT = Path(__file__).parents[2] / "docs" / "stability.md"
NUMBERS = pytest.StashKey[dict[str, float]]()
#: Case, what is measured, promise, what was measured, margin.
ROW = re.compile(r"^\| (\w+ [^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \| ([^|]+) \|$", re.MULTILINE)
MACHINE = re.compile(r"^\w+ \w+, Python .*$", re.MULTILINE)
#: Other machines and other versions of numpy round elsewhere.
MOST_TIMES_THE_TABLE = 8.0


def pytest_addoption(parser) -> None:
    """Add the option that names the table."""
    parser.addoption("--stability-table", metavar="FILE", help="write the table of promises there")


def pytest_configure(config) -> None:
    """Start without any number."""
    config.stash[NUMBERS] = {}


def pytest_sessionfinish(session) -> None:
    """Write the document with what was measured, if it is wanted."""
    path = session.config.getoption("--stability-table", default=None)
    if path is None:
        return
    numbers, text = session.config.stash[NUMBERS], DOCUMENT.read_text(encoding="utf-8")
    missing = [row[1] for row in ROW.finditer(text) if row[1] not in numbers]
    if missing:
        message = f"\nno table was written: not measured were {', '.join(missing)}"
        session.config.get_terminal_writer().line(message)
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
        return
    machine = (
        f"{platform.system()} {platform.machine()}, Python {platform.python_version()}, "
        f"numpy {np.__version__}, scipy {scipy.__version__}."
    )
    text = ROW.sub(lambda row: measured_row(*row.groups()[:3], numbers[row[1]]), text)
    Path(path).write_text(MACHINE.sub(machine, text), encoding="utf-8")


def measured_row(key: str, what: str, promise: str, value: float) -> str:
    """One line of the table."""
    if value > float(promise):
        margin = "BROKEN"
    elif value == 0:
        margin = "exact"
    else:
        times = float(promise) / value
        margin = f"{times:.3g} ×" if times < 10 else f"{times:,.0f} ×".replace(",", " ")
    return f"| {key} | {what} | {promise} | {value:.2g} | {margin} |"


@pytest.fixture
def run(capsys):
    """Run a command; give the exit code and what it wrote to stdout and stderr."""

    def run(*arguments):
        code = main([str(word) for word in arguments])
        return code, *capsys.readouterr()

    return run


@pytest.fixture(scope="session")
def process():
    """One process for all, as the studio has it."""
    with ReadingProcess() as reading:
        yield reading


@pytest.fixture(scope="session")
def documented() -> dict[str, tuple[str, ...]]:
    """Give the cells of the table in ``docs``, by case."""
    return {row[0]: row for row in ROW.findall(DOCUMENT.read_text(encoding="utf-8"))}


@pytest.fixture
def noted(request, documented) -> Callable[[str, float], None]:
    """Give a function that notes a number for the table, and sees that its promise is kept.

    What the table says was measured is measured here too, on whatever machine this is.
    """
    numbers = request.config.stash[NUMBERS]
    making = request.config.getoption("--stability-table", default=None) is not None

    def note(key: str, value: float) -> None:
        _, what, promise, stated, _ = documented[key]
        known = float(value) if value == value else inf
        numbers[key] = max(known, numbers.get(key, 0.0))
        assert known <= float(promise), f"{key}, {what}: {known:.3g} is more than {promise}"
        if not making:
            assert known <= MOST_TIMES_THE_TABLE * float(stated), (
                f"{key}, {what}: {known:.3g}, but docs/stability.md says {stated}; make it again"
            )

    return note


@pytest.fixture(scope="session")
def references() -> Path:
    """Give the folder of vectors made with high precision."""
    return Path(__file__).parents[1] / "references"


@pytest.fixture(scope="session")
def limb_of() -> Callable[..., Limb]:
    """Give a function that makes a limb of any responses, by place."""
    given = {"name": "made-up", "hand_length_mm": 175.0, "synthetic": True}
    given["map"] = load_limb("synthetic-1").map

    def make(read_response: Callable[[int], np.ndarray], **changes) -> Limb:
        return Limb(read_response=read_response, **{**given, **changes})

    return make


@pytest.fixture(scope="module")
def limb() -> Limb:
    """Give the first synthetic limb."""
    return load_limb("synthetic-1")


def refused(action: Callable[[], object], *texts: str) -> int:
    """0 if ``action`` is refused with all ``texts``, else 1."""
    try:
        action()
    except InvalidInputError as error:
        return int(not all(text in str(error) for text in texts))
    return 1


@dataclass(frozen=True, slots=True, eq=False)
class Sampled(Impulse):
    """A waveform that plays given samples."""

    given: np.ndarray

    # Two of them differ, though what an impulse compares is the same.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    @property
    def duration_s(self) -> float:
        """Length."""
        return self.given.size / 1300

    def samples(self, sample_rate_hz: float, shift_s: float = 0.0) -> np.ndarray:
        """Return what was given."""
        return self.given


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Drives on a limb, to be predicted both ways.

    Attributes
    ----------
    drives, places, amplitudes, onsets
        By input; onsets in samples.
    """

    limb: Limb
    drives: tuple[np.ndarray, ...]
    places: tuple[int, ...]
    amplitudes: tuple[float, ...] = ()
    onsets: tuple[int, ...] = ()
    scaling: str = "relative"

    def starts(self) -> tuple[int, ...]:
        """Onset of each input."""
        return self.onsets or (0,) * len(self.drives)

    def factors(self) -> tuple[float, ...]:
        """Amplitude of each input."""
        return self.amplitudes or (1.0,) * len(self.drives)

    def padded(self) -> np.ndarray:
        """Drives with silence before and after them, (n_inputs, n_times)."""
        starts = self.starts()
        n_times = max(k + drive.size for k, drive in zip(starts, self.drives, strict=True))
        padded = np.zeros((len(self.drives), n_times))
        for row, start, drive in zip(padded, starts, self.drives, strict=True):
            row[start : start + drive.size] = drive
        return padded

    def predicted(self) -> np.ndarray:
        """Field by `predict`, (72, 3, n_times)."""
        return predict(self.limb, self.padded(), self.places, self.factors(), scaling=self.scaling)

    def by_engine(
        self,
        outputs: tuple[int, ...] = tuple(range(1, 73)),
        selected: int | None = 0,
        axes: str = "xyz",
        method: str = "pca",
    ) -> dict:
        """`axis_traces`, (n_outputs, n_axes, n_times), and `output_rms`, (72,), of the engine."""
        inputs = tuple(
            track(location=place, waveform=Sampled(drive), amplitude=a, onset_s=k / 1300)
            for drive, place, a, k in zip(
                self.drives, self.places, self.factors(), self.starts(), strict=True
            )
        )
        design = Design(limb="synthetic-1", inputs=inputs, scaling=self.scaling)
        chosen = () if selected is None else (selected + 1,)
        looked = View(outputs=outputs, selected_inputs=chosen, axes=axes, method=method)
        given = {**sources(design, looked), "limb_data": self.limb}
        return new_graph().evaluate(("axis_traces", "output_rms"), given)

    def both_ways(self) -> list[np.ndarray]:
        """Field by `predict` and by the engine, the latter with and without a selected input."""
        engine = [self.by_engine(selected=selected)["axis_traces"] for selected in (0, None)]
        return [self.predicted(), *engine]

    def exact_sample(self, output: int, axis: int, time: int) -> mpmath.mpf:
        """One sample of the field (relative scaling); sums are exact, rounded to 200 bits."""
        with mpmath.workprec(200):
            total = mpmath.mpf(0)
            for drive, place, amplitude in zip(
                self.padded(), self.places, self.factors(), strict=True
            ):
                taps = self.limb.response_to(place)[output - 1, axis]
                first, last = max(0, time - drive.size + 1), min(time, taps.size - 1)
                played = drive[time - last : time - first + 1][::-1]
                total += amplitude * mpmath.fdot(taps[first : last + 1].tolist(), played.tolist())
            return total


@pytest.fixture(scope="session")
def scene() -> type[Scene]:
    """Give the class of scenes."""
    return Scene
