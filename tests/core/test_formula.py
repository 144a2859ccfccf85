"""What a formula means, against 40 digits and itself; texts that mean harm, or nothing."""

import json
import random
from pathlib import Path

import numpy as np
import pytest
import scipy

import skinsource as ss
from skinsource.base.errors import FormulaError, InvalidInputError
from skinsource.design.waveforms.samples import Formula
from skinsource.signals.formula import reading
from skinsource.signals.formula.reading import FUNCTIONS
from skinsource.signals.formula.values import Grid, band_noise

REFERENCES = Path(__file__).parents[1] / "references" / "formulas.json"
ROWS = json.loads(REFERENCES.read_text(encoding="utf-8"))


def played(text, count=1, duration_s=1.0, rate_hz=1300.0):
    return reading.played(reading.read(text), count, rate_hz, 0.0, duration_s)


def value_of(text):
    return float(played(text)[0])


def grid(first, count, rate_hz, shift_s=0.0):
    return Grid(first=first, count=count, rate_hz=rate_hz, shift_s=shift_s, duration_s=1e4)


@pytest.mark.parametrize("row", ROWS, ids=[row["text"] for row in ROWS])
def test_formulas_are_what_40_digits_say_up_to_an_hour(row):
    program, numbers = reading.read(row["text"]), row["numbers"]
    expected = np.array([float.fromhex(digits) for digits in row["values"]])
    at = (row["sample_rate_hz"], row["shift_s"], row["duration_s"])
    samples = reading.played(program, numbers[-1] + 1, *at)[numbers]
    assert np.abs(samples - expected).max() <= 1e-12 * max(1.0, np.abs(expected).max())
    assert len(numbers) >= 60
    assert np.ptp(expected) > 0.1


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        *[("1+2*3", 7), ("(1+2)*3", 9), ("10-4-3", 3), ("24/4/3", 2), ("2*3/4*2", 3)],
        *[("2^3^2", 512), ("-2^2", -4), ("2^-1", 0.5), ("2^-1^2", 0.5), ("(-2)^2", 4)],
        *[("--3", 3), ("-+-3", 3), ("2--3", 5), ("2*-3+1", -5), ("-2*-3", 6), ("-3-2", -5)],
        *[("1 < 2", 1), ("2 <= 2", 1), ("2 > 2", 0), ("1 >= 2", 0), ("1 == 1", 1), ("1 != 1", 0)],
        *[("1 + 1 < 3 - 2", 0), ("-1 < 0", 1), ("(1 < 2) + (2 < 3)", 2), ("2*(1<2)", 2)],
        *[(".5 + 1. + 1e-1 + 2E+1", 21.6), ("  7\t", 7), ("mod(-1, 3)", 2), ("mod(7, -3)", -2)],
        *[("min(3, 1, 2)", 1), ("max(3, 1, 2)", 3), ("clip(5, 0, 2)", 2), ("clip(-5, 0, 2)", 0)],
        *[("sign(-3) + sign(0)", -1), ("floor(-1.5)", -2), ("ceil(-1.5)", -1), ("round(2.6)", 3)],
        *[("2·3 × 4 − 1", 23), ("cos(π)", -1), ("1 ≤ 2", 1), ("duration", 1), ("sqrt(9)", 3)],
    ],
)
def test_operators_bind_as_in_mathematics(text, expected):
    assert value_of(text) == pytest.approx(expected, rel=1e-15)


def test_a_formula_plays_as_written_from_its_start_to_its_end():
    recipe = Formula(text="3*(t >= 0)", duration_s=0.01)
    assert recipe.samples(1300.0).tolist() == [3.0] * 13
    shifted = recipe.samples(1300.0, 0.5 / 1300.0)
    assert shifted.tolist() == [0.0, *[3.0] * 13]
    # The last of its samples may lie behind its end.
    odd = Formula(text="1", duration_s=9.6 / 1300.0)
    assert odd.samples(1300.0, 0.2 / 1300.0).tolist() == [0.0, *[1.0] * 9, 0.0]
    assert Formula(text="1", duration_s=0.001).samples(48000.0).tolist() == [1.0] * 48
    assert ss.waveforms.Formula().duration_s == 0.2


def test_noise_is_one_function_of_time_at_every_rate_and_shift():
    at_1300, at_48k = band_noise(3, grid(0, 3900, 1300.0)), band_noise(3, grid(0, 144000, 48000.0))
    assert np.abs(at_1300[::13] - at_48k[::480]).max() < 1e-10
    shifted = band_noise(3, grid(0, 3901, 1300.0, 0.5 / 1300))
    assert np.abs(shifted[1:] - band_noise(3, grid(0, 7800, 2600.0))[1::2]).max() < 1e-10
    assert np.abs(band_noise(3, grid(2000, 50, 1300.0)) - at_1300[2000:2050]).max() < 1e-12
    odd, ten_times = (band_noise(3, grid(0, 400 * k, 1333.25 * k)) for k in (1, 10))
    assert np.abs(odd - ten_times[::10]).max() < 1e-10


def test_noise_is_gaussian_of_its_band_and_the_seed_decides():
    first, other = (band_noise(seed, grid(0, 260_000, 2600.0)) for seed in (1, 2))
    assert first.std() == pytest.approx(1 / 3, rel=0.01)
    assert scipy.stats.kurtosis(first) == pytest.approx(0.0, abs=0.05)
    assert abs(np.corrcoef(first, other)[0, 1]) < 0.02
    window = np.sin(np.pi * np.arange(first.size) / first.size) ** 4
    energy = np.abs(np.fft.rfft(first * window)) ** 2
    frequency_hz = np.fft.rfftfreq(first.size, 1 / 2600.0)
    outside = (frequency_hz < 25) | (frequency_hz > 600)
    assert 0 < energy[outside].sum() < 1e-8 * energy.sum()
    halves = [energy[(frequency_hz > a) & (frequency_hz < a + 100)].sum() for a in (50, 250, 450)]
    assert max(halves) < 1.2 * min(halves)
    # A slow rate leaves out what it cannot carry.
    slow = np.abs(np.fft.rfft(band_noise(1, grid(0, 100_000, 1000.0)))) ** 2
    assert slow[np.fft.rfftfreq(100_000, 1 / 1000.0) > 499.9].sum() < 1e-3 * slow.sum()


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("", 1, "found nothing, expected a formula such as"),
        ("2t", 2, "found t, expected an operator, such as *"),
        ("sin(", 5, "found the end, expected a number"),
        ("1 + sin (t", 11, "expected ) for the bracket of column 9"),
        ("t)", 2, "no bracket is open"),
        ("0,5*t", 2, "numbers have a point"),
        ("*t", 1, "found *"),
        ("sin()", 1, "found sin of 0 values, expected 1, as in sin(x)"),
        ("3*sin(1, t)", 3, "found sin of more than 1"),
        ("clip(t, 1)", 1, "found clip of 2 values, expected 3, as in clip(x, low, high)"),
        ("min(1,,2)", 7, "found ,"),
        ("t + sine(3)", 5, "found sine, expected sin"),
        ("qqqq", 1, "expected one of t, pi, duration, sin"),
        ("2 + hann", 9, "found the end, expected ( as in hann()"),
        ("t < 1 < 2", 7, "write (a < b) * (b < c)"),
        ("t = 1", 3, "found =, expected == for a comparison"),
        ("t**2", 2, "found **, expected ^ for a power"),
        ("t.real", 2, "found ."),
        ("1e999", 1, "a number below 1.8e308"),
        ("noise(t)", 7, "found t, expected a whole number from 0"),
        ("noise(2147483648)", 7, "found 2147483648"),
        ("(" * 900, 61, "at most 60 brackets"),
        ("t" + "+t" * 300, 500, "expected at most 500 numbers"),
        ("9^9^9^9", 4, "^ is infinite at 0 s"),
        ("1/t", 2, "/ is infinite at 0 s"),
        ("sqrt(0.05 - t)", 1, "sqrt is no number at 0.0507692 s"),
        ("__import__('os')", 1, "found __import__"),
    ],
)
def test_a_mistake_is_refused_with_its_column(text, column, message):
    with pytest.raises(FormulaError) as raised:
        Formula(text=text)
    assert raised.value.column == column
    assert message in str(raised.value)
    assert f", column {column}: " in str(raised.value) or text == ""
    assert reading.column_of(str(raised.value)) == column
    assert len(str(raised.value)) < 400


def test_what_is_not_finite_late_is_refused_when_it_is_played():
    recipe = Formula(text="sqrt(15 - t)", duration_s=20.0)
    with pytest.raises(FormulaError, match=r"sqrt is no number at 15\.0008 s"):
        recipe.samples(1300.0)


def test_the_page_about_formulas_names_every_function_and_limit():
    page = (Path(__file__).parents[2] / "docs" / "formulas.md").read_text(encoding="utf-8")
    for name, function in reading.FUNCTIONS.items():
        assert f"`{function.usage}`" in page, name
    for limit in (reading.LONGEST, reading.MAX_STEPS, reading.MAX_DEPTH):
        assert f" {limit} " in page


COUNT, SEED = 10_000, 20261122
OPERATORS = ["+", "-", "*", "/", "^", "<", "<=", ">", ">=", "==", "!="]
#: What Python would do something with.
PYTHON = [
    *["__import__('os').system('true')", "().__class__.__bases__[0]", "t.__class__", "exec('1')"],
    *["eval('1')", "open('/etc/passwd').read()", "lambda: 0", "[t for t in t]", "{1:2}", "t if t"],
    *["9**9**9**9", "9^9^9^9", "(" * 5000, ")" * 5000, "-" * 5000, "sin(" * 900, "1" * 5000],
    *[
        "1e" + "9" * 90,
        "0x10",
        "1_000",
        "1j",
        "\0",
        "\u202et",
        "t;t",
        "t\nt",
        "#",
        '"',
        "%s",
        "`id`",
    ],
    *["²", "١", "𝑡", "ｔ", "", " ", "NaN", "inf", "None", "True", "self", "globals()", "\ud800"],
    *["1<t<2", "min(" + "t," * 400 + "t)", "+".join(["t"] * 500), "^".join(["2"] * 400)],
    *["sin(1e308*t)", "(" * 59 + "t" + ")" * 59, "exp(exp(exp(t+9)))", "noise(99999999999999)"],
]


ODD = [*"(),.e_=t-", "", "**", "..", "\0", "é", "9" * 40, "sin"]


def expression(rng, depth):
    """Something that can nearly always be read."""
    kind = rng.random()
    if depth <= 0 or kind < 0.25:
        return rng.choice(["t", "pi", "duration", "0", "1", "0.5", "2e3", "1e-9", "1e300"])
    if kind < 0.6:
        left, right = expression(rng, depth - 1), expression(rng, depth - 1)
        return f"{left}{rng.choice(OPERATORS[:5])}{right}"
    if kind < 0.7:
        return f"({expression(rng, depth - 1)}{rng.choice(OPERATORS)}1)"
    if kind < 0.8:
        return f"-({expression(rng, depth - 1)})"
    name = rng.choice(sorted(FUNCTIONS))
    function = FUNCTIONS[name]
    if function.seeded:
        return f"{name}({rng.randrange(9)})"
    count = rng.randint(function.fewest, min(function.most, 4))
    return f"{name}({', '.join(expression(rng, depth - 1) for _ in range(count))})"


def spoilt(rng, text):
    """The text with some letters lost, doubled, moved or strange."""
    letters = list(text)
    for _ in range(rng.randint(1, 4)):
        place = rng.randrange(len(letters) + 1)
        letters[place:place] = rng.choice(ODD)
        if letters and rng.random() < 0.6:
            del letters[rng.randrange(len(letters))]
    return "".join(letters)


def texts(rng):
    """Hostile ones first, then made ones, spoilt ones, and noise."""
    yield from PYTHON
    alphabet = "t()+-*/^<>=,.0123456789e sincoxpab_\"'[]{}:;%$#@!?\\\n\té²π"
    for number in range(COUNT - len(PYTHON)):
        if number % 10 == 0:
            yield "".join(rng.choices(alphabet, k=rng.randint(0, 40)))
        else:
            whole = expression(rng, rng.randint(1, 5))
            yield whole if number % 2 else spoilt(rng, whole)


def test_ten_thousand_texts_are_played_or_refused_with_a_column(capsys):
    rng = random.Random(SEED)  # noqa: S311
    n_played = n_refused = 0
    longest = 0
    for text in texts(rng):
        try:
            # A hundred samples say as much as a second.
            samples = reading.played(reading.read(text), 100, 1300.0, 0.0002, 0.1)
        except InvalidInputError as error:
            n_refused += 1
            column = getattr(error, "column", None)
            assert column is not None, (SEED, text)
            assert 1 <= column <= len(text) + 1 or column == 1, (SEED, text)
            longest = max(longest, len(str(error)))
        else:
            n_played += 1
            assert samples.shape == (100,), (SEED, text)
            assert np.isfinite(samples).all(), (SEED, text)
    with capsys.disabled():
        print(f"\nseed {SEED}: {n_played} texts played, {n_refused} refused")  # noqa: T201
    assert n_played + n_refused == COUNT
    assert min(n_played, n_refused) > COUNT // 5
    assert longest < 400


def test_the_deepest_formula_that_is_allowed_is_played_however_long_it_is():
    """What is held at once grows with the depth, and not with the length."""
    deepest = "(t+" * 29 + "t" + ")" * 29
    assert Formula(text=deepest).samples(1300.0)[130] == pytest.approx(30 * 130 / 1300)
    many = "+".join(["t"] * 250)
    assert Formula(text=many).samples(1300.0)[130] == pytest.approx(250 * 130 / 1300)
