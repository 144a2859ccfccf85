"""What others rely on stays: public names, commands, numbers, and bytes of exports."""

import json
import sys

import numpy as np
import pytest

from skinsource.engine.quantities import new_graph
from tests.core.frozen import read_frozen

#: Other processors round otherwise, and principal axes amplify that where two are nearly equal.
TOLERANCE = 1e-10


def stored(name):
    return json.loads((read_frozen.HERE / f"{name}.json").read_text(encoding="utf-8"))


def test_public_names_keep_their_parameters_and_fields():
    names = read_frozen.public_names()
    for name, description in stored("public").items():
        # JSON knows no tuples.
        assert json.loads(json.dumps(names.get(name))) == description, name


def test_fields_of_models_keep_their_limits():
    limits = read_frozen.limits()
    for name, expected in stored("limits").items():
        assert limits.get(name) == expected, name


def test_commands_keep_their_options_and_choices():
    commands = read_frozen.commands()
    for name, options in stored("commands").items():
        assert set(options) <= set(commands[name]), name


def test_quantities_keep_their_names():
    assert set(stored("quantities")) <= set(new_graph().rules)


@pytest.mark.skipif(sys.platform != "linux", reason="Digests were taken on Linux")
def test_each_format_writes_the_same_bytes(tmp_path):
    digests = read_frozen.export_digests(tmp_path)
    changed = [name for name, digest in stored("exports").items() if digests.get(name) != digest]
    assert changed == []


def test_two_hundred_drawn_designs_give_the_same_levels_traces_and_spectra():
    with read_frozen.designs() as folder:
        numbers = read_frozen.numbers(folder)
    with np.load(read_frozen.HERE / "numbers.npz") as expected:
        assert set(numbers) == set(expected.files)
        for name in expected.files:
            peak = np.nanmax(np.abs(expected[name]), initial=0.0)
            np.testing.assert_allclose(
                numbers[name], expected[name], rtol=0, atol=TOLERANCE * peak, err_msg=name
            )
