"""Rules from vibrations to traces and spectra of the selected outputs."""

from skinsource.base.conventions import Complexes, Floats
from skinsource.base.errors import InvalidInputError, quoted
from skinsource.base.job import Stop
from skinsource.engine.gains import (
    ExactVoice,
    Placed,
    Responses,
    TraceError,
    trace_error_of,
)
from skinsource.engine.moments import Moments, Projection, without_main_axis
from skinsource.engine.streaming import Vibration, exact_transforms
from skinsource.engine.transforms import forward
from skinsource.limbs.limb import Limb
from skinsource.signals.projection import Method
from skinsource.signals.resampling import Extremes, extremes_between
from skinsource.signals.spectra import one_sided_magnitude, peak_hold_spectrum


def shown_outputs(outputs: tuple[int, ...], limb_data: Limb) -> tuple[int, ...]:
    """The selected outputs, refused where the limb does not have them."""
    missing = [output for output in outputs if not 1 <= output <= limb_data.n_outputs]
    if missing:
        raise InvalidInputError(
            f"{limb_data.name} has the outputs 1 to {limb_data.n_outputs}; selected are also "
            f"{quoted(missing)}. Select others, or choose another limb."
        )
    return outputs


def axis_traces(
    vibration: Vibration, shown_outputs: tuple[int, ...], axis_numbers: tuple[int, ...], stop: Stop
) -> Floats:
    """Acceleration of the selected outputs, (n_selected, n_axes, n_times), in m/s²."""
    return vibration.traces(shown_outputs, axis_numbers, stop)


def selected_projection(projection: Projection, shown_outputs: tuple[int, ...]) -> Projection:
    """How the axes of each selected output become one signal."""
    return projection.at([output - 1 for output in shown_outputs])


def selected_without_main_axis(
    moments: Moments,
    shown_outputs: tuple[int, ...],
    axis_numbers: tuple[int, ...],
    method: Method,
    response_samples: int,
) -> tuple[int, ...]:
    """Selected outputs that are projected on a main axis they do not have."""
    rows = [output - 1 for output in shown_outputs]
    of_selected = Moments(moments.second[rows], moments.first[rows])
    without = without_main_axis(of_selected, axis_numbers, method, response_samples).tolist()
    return tuple(output for output, missing in zip(shown_outputs, without, strict=True) if missing)


def selected_traces(axis_traces: Floats, selected_projection: Projection) -> Floats:
    """Projected acceleration of the selected outputs, (n_selected, n_times), in m/s²."""
    return selected_projection.signals(axis_traces)


def selected_extremes(
    axis_traces: Floats, selected_traces: Floats, selected_projection: Projection, stop: Stop
) -> Extremes:
    """Lowest and highest value of the waves of the selected outputs between samples, in m/s²."""
    return extremes_between(selected_projection.waves(axis_traces, selected_traces), stop=stop)


def axis_spectra(
    vibration: Vibration, shown_outputs: tuple[int, ...], axis_numbers: tuple[int, ...], stop: Stop
) -> Complexes:
    """Transforms of `axis_traces` over exactly their samples, (n_selected, n_axes, n_bins)."""
    return vibration.transforms(shown_outputs, axis_numbers, stop)


def selected_spectra(
    vibration: Vibration,
    shown_outputs: tuple[int, ...],
    selected_projection: Projection,
    selected_traces: Floats,
    sample_rate_hz: float,
    record_samples: int,
    stop: Stop,
) -> tuple[Floats, Floats]:
    """Frequencies, (n_bins,), in Hz, and magnitudes, (n_selected, n_bins), in m/s².

    They are over the record of levels: what actuators ring beyond it counts, its length does not.
    A projection is linear, so that it follows from the transforms of the axes.  A magnitude is not;
    it and the traces of a long response are transformed themselves.
    """
    if vibration.streamed is not None:
        transforms = exact_transforms(selected_traces, stop)
    elif selected_projection.directions is None:
        transforms = forward(selected_traces, vibration.n_times)
    else:
        transforms = vibration.projected_transforms(shown_outputs, selected_projection)
    return _over_record(transforms, vibration, sample_rate_hz, record_samples)


def selected_peak_spectra(
    selected_traces: Floats, sample_rate_hz: float, stop: Stop
) -> tuple[Floats, Floats]:
    """Like `selected_spectra`, of the loudest 250 ms for each frequency: `peak_hold_spectrum`."""
    return peak_hold_spectrum(selected_traces, sample_rate_hz, stop)


def selected_axis_spectra(
    vibration: Vibration,
    shown_outputs: tuple[int, ...],
    limb_data: Limb,
    sample_rate_hz: float,
    record_samples: int,
    stop: Stop,
) -> tuple[Floats, Floats]:
    """Like `selected_spectra` along each axis of the limb, magnitudes (n_selected, n_axes, n_bins).

    They do not depend on the chosen axes.
    """
    transforms = vibration.transforms(shown_outputs, tuple(range(limb_data.n_axes)), stop)
    return _over_record(transforms, vibration, sample_rate_hz, record_samples)


def selected_axis_peak_spectra(
    vibration: Vibration,
    shown_outputs: tuple[int, ...],
    limb_data: Limb,
    sample_rate_hz: float,
    stop: Stop,
) -> tuple[Floats, Floats]:
    """Like `selected_axis_spectra`, of the loudest 250 ms for each frequency."""
    traces = vibration.traces(shown_outputs, tuple(range(limb_data.n_axes)), stop)
    return peak_hold_spectrum(traces, sample_rate_hz, stop)


def trace_error(
    responses: Responses,
    placed: tuple[Placed, ...],
    shown_outputs: tuple[int, ...],
    axis_numbers: tuple[int, ...],
    axis_traces: Floats,
    match_gain: float,
    stop: Stop,
) -> TraceError | None:
    """Error of the selected traces; None where there is nothing to check."""
    exact_voices = [
        ExactVoice(
            drive=player.drive,
            delay_samples=player.start,
            weight=player.voice.amplitude * match_gain * gain,
            response=response,
        )
        for player, response, gain in responses.moving(placed, stop)
    ]
    return trace_error_of(axis_traces, shown_outputs, axis_numbers, exact_voices)


def _over_record(
    transforms: Complexes, vibration: Vibration, sample_rate_hz: float, record_samples: int
) -> tuple[Floats, Floats]:
    frequency_hz, magnitude = one_sided_magnitude(transforms, vibration.n_times, sample_rate_hz)
    magnitude *= vibration.n_times / record_samples
    return frequency_hz, magnitude
