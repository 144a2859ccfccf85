"""Table and plot of what `growth.py` measured."""

import csv
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import matplotlib
from growth_limit import Machine
from matplotlib.axes import Axes
from matplotlib.figure import Figure

#: Edits, how a legend says them, and how they are drawn.
EDITS = {
    "everything": ("everything new", "#0072B2", "o"),
    "one waveform": ("one waveform changed", "#D55E00", "s"),
    "one amplitude": ("one amplitude changed", "#009E73", "^"),
}
FRAME_MS = 1000 / 60


@dataclass(frozen=True, slots=True, kw_only=True)
class Point:
    """One measured point: what grows, the edit, the scene, times, and the least work."""

    grows: str
    edit: str
    length_s: float
    inputs: int
    outputs: int
    fastest_ms: float
    median_ms: float
    runs: int
    streamed: bool
    read_bytes: float
    operations: float

    def limit_ms(self, machine: Machine) -> float:
        """Least time for the least work."""
        return machine.least_ms(self.read_bytes, self.operations)

    def times_limit(self, machine: Machine) -> float:
        """How many times the limit the fastest run took."""
        return self.fastest_ms / self.limit_ms(machine)


def draw(points: Sequence[Point], machine: Machine, limb: str) -> Figure:
    """Draw three panels: what was measured, and the limit of each edit."""
    figure = Figure(figsize=(13.5, 5.4), dpi=120, layout="constrained")
    panels = figure.subplots(1, 3, sharey=True)
    for panel, grows, label, held in (
        (panels[0], "length", "length, s", "{0.inputs} inputs, {0.outputs} outputs shown"),
        (panels[1], "inputs", "inputs", "{0.length_s:g} s, {0.outputs} outputs shown"),
        (panels[2], "outputs", "outputs shown", "{0.inputs} inputs, {0.length_s:g} s"),
    ):
        mine = [point for point in points if point.grows == grows]
        draw_panel(panel, mine, grows, machine)
        panel.set_xlabel(label)
        panel.set_title(held.format(mine[0]), loc="left", fontsize=10)
    panels[1].annotate(
        f"a frame, {FRAME_MS:.1f} ms",
        (0.01, FRAME_MS),
        xycoords=("axes fraction", "data"),
        xytext=(0, 3),
        textcoords="offset points",
        fontsize=7.5,
        color="#666666",
    )
    draw_streaming(panels[0], [point for point in points if point.grows == "length"])
    panels[0].set_ylabel("time of an edit (fastest run), ms")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3, frameon=False)
    gigabytes, gigaflops = machine.read_rate / 1e9, machine.transform_rate / 1e9
    figure.suptitle(
        "How the cost of an edit grows: levels of all 72 outputs, traces and spectra of those "
        f"shown in three axes, float64, {limb}\n"
        f"Limit: bytes that must be read at {gigabytes:.0f} GB/s + transforms that must be done at "
        f"{gigaflops:.1f} GFLOP/s, the best this machine showed",
        fontsize=11,
    )
    return figure


def draw_panel(panel: Axes, points: Sequence[Point], grows: str, machine: Machine) -> None:
    """Draw one panel."""
    for edit, (label, colour, marker) in EDITS.items():
        mine = [point for point in points if point.edit == edit]
        x = [{"length": p.length_s, "inputs": p.inputs, "outputs": p.outputs}[grows] for p in mine]
        panel.plot(
            x,
            [point.fastest_ms for point in mine],
            color=colour,
            marker=marker,
            markersize=5,
            label=label,
        )
        panel.plot(
            x,
            [point.limit_ms(machine) for point in mine],
            color=colour,
            linestyle="--",
            linewidth=1.1,
            alpha=0.75,
            label="its limit",
        )
    panel.set(xscale="log", yscale="log")
    ticks = (0.1, 1, 10, 100, 600) if grows == "length" else x
    panel.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    panel.minorticks_off()
    panel.yaxis.set_major_formatter("{x:g}")
    panel.grid(color="#E6E6E6", linewidth=0.7)
    panel.set_axisbelow(True)
    panel.axhline(FRAME_MS, color="#888888", linewidth=0.8, linestyle=":")


def draw_streaming(panel: Axes, points: Sequence[Point]) -> None:
    """Mark from which length on a scene is taken block by block."""
    longer = [point.length_s for point in points if point.streamed]
    if not longer:
        return
    between = (min(longer) * max(p.length_s for p in points if not p.streamed)) ** 0.5
    panel.axvline(between, color="#888888", linewidth=0.8, linestyle=":")
    panel.annotate(
        "block by block",
        (between, 0.0),
        xycoords=("data", "axes fraction"),
        xytext=(3, 4),
        textcoords="offset points",
        fontsize=7.5,
        color="#666666",
    )


def write(points: Sequence[Point], machine: Machine, limb: str, folder: Path) -> None:
    """Write table and pictures."""
    figure = draw(points, machine, limb)
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "growth.csv").open("w", newline="", encoding="utf-8") as file:
        rows = [
            {
                **asdict(point),
                "limit_ms": point.limit_ms(machine),
                "times_limit": point.times_limit(machine),
            }
            for point in points
        ]
        table = csv.DictWriter(file, list(rows[0]))
        table.writeheader()
        table.writerows(
            {
                name: f"{value:.6g}" if isinstance(value, float) else value
                for name, value in row.items()
            }
            for row in rows
        )
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": "skinsource"}):
        figure.savefig(folder / "growth.svg", metadata={"Creator": None, "Date": None})
        figure.savefig(folder / "growth.png")
