"""Ten thousand texts that mean harm, or nothing: refused in one way, or played, and soon."""

import random

import numpy as np
import pytest

from skinsource.base.errors import InvalidInputError
from skinsource.design.waveforms.samples import Formula
from skinsource.signals.formula import reading
from skinsource.signals.formula.reading import FUNCTIONS

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
