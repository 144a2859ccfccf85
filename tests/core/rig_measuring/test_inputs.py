"""Which device is recorded from."""

import pytest

from skinsource.lab.playing.devices import Device
from skinsource.lab.rig_measuring.duplex import InputDevice, input_device_of

PLAYED_ON = Device(
    index=2, name="Card", host_api="ALSA", n_outputs=4, sample_rate_hz=48_000, is_default=False
)


def device(index, name="Card", host_api="ALSA"):
    return InputDevice(index=index, name=name, host_api=host_api, n_inputs=2, sample_rate_hz=48_000)


@pytest.mark.parametrize(
    ("name", "there", "index"),
    [
        # The same device, then one of its host, then any.
        ("", (device(0, "Jack", "JACK"), device(1, "Other"), device(2)), 2),
        ("", (device(0, "Jack", "JACK"), device(1, "Other")), 1),
        ("", (device(0, "Jack", "JACK"),), 0),
        # So also of those that have the name.
        ("Card", (device(0, host_api="JACK"), device(1), device(2)), 2),
        ("Card", (device(0, host_api="JACK"), device(3), device(2, "Other")), 3),
        ("Jack", (device(0, "Jack", "JACK"), device(2)), 0),
    ],
)
def test_the_nearest_to_the_device_that_is_played_on_is_recorded_from(name, there, index):
    assert input_device_of(name, PLAYED_ON, there).index == index
