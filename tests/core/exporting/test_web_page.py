"""The web page of a design: what is embedded, and what a browser shows of it."""

import base64
import hashlib
import json
import re
import shutil
import subprocess
import zlib
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest

import skinsource as ss
from skinsource.base.errors import InvalidInputError, StorageError
from skinsource.cli.command_line import main
from skinsource.design.design import Snapshot
from skinsource.export.exported_design import ExportedDesign
from skinsource.export.web_page import content_of, page_content, page_of

#: Ends scripts, begins markup, is no text of JSON, and looks like a field of the template.
HOSTILE = (
    "</script><img src=x onerror='hit=1'><script>hit = 1</script><!-- \u2028{{script}}\\u003c\""
)
TONE = ss.waveforms.Tone(frequency_hz=100.0, duration_s=0.2)
N_DRAWN = 50


def tone(place=7, **changes):
    return ss.track(place, TONE, **changes)


def design_of(*inputs, limb="synthetic-1", **changes):
    return ss.Design(limb=limb, inputs=inputs or (tone(),), **changes)


def content(design, **view):
    return page_content(ExportedDesign(design, ss.View(**view)))


def unpacked(text, kind):
    return np.frombuffer(zlib.decompress(base64.b64decode(text)), kind)


def samples_of(field):
    """The field that is embedded, (n_outputs, n_times), in m/s²."""
    values = unpacked(field["values"], "<i2" if field["signed"] else np.uint8)
    share = values / 32767 if field["signed"] else (values / 255) ** 2
    return field["largest"] * share.reshape(-1, field["count"])


def drawn_design(seed):
    """A design and a view that are drawn at random."""
    rng = np.random.default_rng(seed)
    draw = rng.choice
    hz, duration_s = float(rng.uniform(30.0, 500.0)), float(rng.uniform(0.05, 0.3))
    waveforms = (
        ss.waveforms.Tone(frequency_hz=hz, duration_s=duration_s),
        ss.waveforms.Chirp(duration_s=duration_s),
        ss.waveforms.Noise(seed=seed, duration_s=duration_s),
        ss.waveforms.Square(frequency_hz=hz, duration_s=duration_s),
        ss.waveforms.Tap(),
        ss.waveforms.WaveletTrain(),
    )
    tracks = tuple(
        ss.track(
            int(rng.integers(1, 21)),
            waveforms[rng.integers(len(waveforms))],
            onset_s=float(rng.uniform(0.0, 0.2)),
            amplitude=float(10 ** rng.uniform(-2.0, 1.0)),
            muted=bool(rng.random() < 0.2),
        )
        for _ in range(rng.integers(1, 4))
    )
    limb = f"synthetic-{rng.integers(1, 5)}"
    view = ss.View(
        axes=str(draw(["xyz", "xy", "z"])),
        method=str(draw(["pca", "mag", "rms", "soc"])),
        span=str(draw(["record", "loudest"])),
    )
    scaling = str(draw(["probe", "upstream", "relative"]))
    return design_of(*tracks, limb=limb, scaling=scaling), view


@pytest.fixture(autouse=True, scope="module")
def _maps_are_built_once(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SKINSOURCE_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture(scope="module")
def drawn():
    """Designs, their views, and the contents of their pages."""
    pairs = [drawn_design(seed) for seed in range(N_DRAWN)]
    return [(*pair, page_content(ExportedDesign(*pair))) for pair in pairs]


# ---- what is embedded ----


def test_levels_of_drawn_designs_are_those_of_the_library(drawn):
    for design, view, shown in drawn:
        expected = ss.evaluate(design, "output_levels_db", view=view)["output_levels_db"]
        np.testing.assert_allclose(np.array(shown["levels"]) / 100, expected, atol=0.0051)


def test_the_field_of_drawn_designs_is_that_of_the_library(drawn):
    for design, _, shown in drawn[::10]:
        moving = ss.evaluate(design, "moving_z")["moving_z"]
        field = shown["field"]
        first = round((field["first_s"] + moving.delay_s) * 1300)
        expected = moving.signals[:, 0, first : first + field["count"]]
        assert field["signed"]
        step = field["largest"] / 32767
        np.testing.assert_allclose(samples_of(field), expected, atol=0.51 * step)


def test_three_inputs_of_a_second_take_less_than_two_megabytes(tmp_path):
    noises = (ss.waveforms.Noise(seed=seed, duration_s=1.0) for seed in (1, 2, 3))
    tracks = (ss.track(place, noise) for place, noise in zip((3, 7, 12), noises, strict=True))
    page = ss.export_page(design_of(*tracks), tmp_path / "a.html")
    assert 200_000 < page.stat().st_size < 1_000_000


def test_of_a_measured_limb_neither_responses_nor_map_are_passed_on(synthetic_installed):
    # Called measured, made of a synthetic limb with a map of its own.  The response to an impulse
    # is the field itself.
    design = design_of(ss.track(7, ss.waveforms.Impulse()), limb="measured-1")
    shown = content(design, axes="z", outputs=(30,))
    moving = ss.evaluate(design, "moving_vector")["moving_vector"]
    field = shown["field"]
    assert not field["signed"]
    # Lengths of vectors in 256 steps: neither signs nor axes.
    lengths = samples_of(field)[:, ::2]
    first = round((field["first_s"] + moving.delay_s) * 1300)
    expected = np.linalg.norm(moving.signals, axis=1)[:, first:][:, : lengths.shape[1]]
    assert np.abs(lengths - expected).max() < field["largest"] / 250
    (trace,) = shown["traces"]
    low, high = (unpacked(trace["curve"][name], np.int8) for name in ("low", "high"))
    np.testing.assert_array_equal(low, -high)
    assert trace["curve"]["step_s"] >= 0.01
    # It is drawn on a hand of this project.
    assert shown["maps"] == content(design_of())["maps"]
    own = ss.load_limb("measured-1").map.outline
    assert not np.array_equal(own, ss.load_limb("synthetic-1").map.outline)


def test_the_map_of_the_page_is_that_of_the_library():
    shown = content(design_of())
    (embedded,) = shown["maps"]
    counts = unpacked(embedded["counts"], np.uint8)
    outputs = unpacked(embedded["outputs"], "<u2")
    weights = unpacked(embedded["weights"], np.uint8).astype(float)
    rows = np.repeat(np.arange(counts.size), counts)
    sums = np.bincount(rows, weights)
    levels = np.array(shown["levels"]) / 100
    of_pixels = np.bincount(rows, weights * levels[outputs]) / sums
    inside = unpacked(embedded["inside"], np.uint8).reshape(embedded["rows"], -1).astype(bool)
    step = round(embedded["step_mm"])
    expected = ss.evaluate(design_of(), "surface_levels_db")["surface_levels_db"][::step, ::step]
    drawn, known = np.full(expected.shape, np.nan), np.isfinite(expected)
    drawn[inside] = of_pixels
    np.testing.assert_allclose(drawn[known], expected[known], atol=0.3)
    # Others are drawn up to the outline.
    assert 5_000 < known.sum() < inside.sum() < 15_000


def test_traces_and_field_have_the_times_of_the_design_through_an_actuator():
    # What an equaliser rings before the stimulus moves neither.
    at = ss.ActuatorAt(actuator="a coil", model=ss.actuators.load("example-voice-coil"))
    through = ss.Actuation(actuators=(at,), equaliser=ss.equalising.RegularisedInverse())
    shown = content(design_of(actuation=through), axes="z", outputs=(30,))
    (trace,), field = shown["traces"], shown["field"]
    high = unpacked(trace["curve"]["high"], np.int8)
    peak_s = trace["curve"]["first_s"] + trace["curve"]["step_s"] * np.argmax(high)
    at_peak = round((peak_s - field["first_s"]) * field["rate_hz"])
    around = samples_of(field)[29, at_peak - 3 : at_peak + 4]
    # All periods of the tone are nearly as strong.
    assert around.max() == pytest.approx(trace["curve"]["peak"], rel=0.05)


def test_one_speed_is_the_clearest_and_none_is_offered_twice():
    shown = content(design_of())
    # A tone of 100 Hz is followed at 2 Hz.
    assert shown["clearest"] == 50
    assert shown["speeds"] == [20, 50, 100, 200, 500, 1000]
    odd = content(design_of(ss.track(7, ss.waveforms.Tone(frequency_hz=90.0, duration_s=0.2))))
    assert odd["speeds"][:3] == [20, odd["clearest"], 50]


def test_the_drive_is_embedded_also_two_octaves_higher():
    sound = content(design_of(tone(), tone(9, muted=True)))["sound"]
    plain, up = (unpacked(sound[name], "<i2").astype(float) for name in ("plain", "up"))
    frequency_hz = np.fft.rfftfreq(plain.size, 1 / sound["rate_hz"])
    loudest = [frequency_hz[np.argmax(np.abs(np.fft.rfft(each)))] for each in (plain, up)]
    np.testing.assert_allclose(loudest, (100.0, 400.0), atol=3.0)
    assert plain.size == up.size
    assert np.abs(plain).max() == np.abs(up).max() == 32767
    assert content(design_of(tone(muted=True)))["sound"] is None


def test_snapshots_stand_beside_the_design_in_one_scale():
    louder = replace(tone(), amplitude=10.0)
    snapshots = (
        Snapshot(number=2, design=design_of(louder, limb="synthetic-3"), title="Louder"),
        Snapshot(number=1, design=design_of(limb="nobody")),
    )
    shown = content(design_of(), snapshots=snapshots)
    own, missing, other = shown["snapshots"]
    assert (own["title"], missing["title"], other["title"]) == (
        "Working design, shown above",
        "Snapshot 1",
        "Snapshot 2 · Louder",
    )
    assert own["levels"] == shown["levels"]
    assert "levels" not in missing
    assert "nobody" in missing["about"]
    assert (own["map"], other["map"], len(shown["maps"])) == (0, 1, 2)
    assert shown["range_db"][1] * 100 >= max(other["levels"]) > max(own["levels"])
    assert content(design_of())["snapshots"] == []


def test_snapshots_are_told_by_their_titles_else_by_their_frequencies():
    def names(titles):
        hz = (50.0, 100.0, 200.0)
        waveforms = [ss.waveforms.Tone(frequency_hz=each, duration_s=0.2) for each in hz]
        designs = [
            design_of(ss.track(7, waveform), title=title)
            for waveform, title in zip(waveforms, titles, strict=True)
        ]
        stored = tuple(Snapshot(number=k, design=each) for k, each in enumerate(designs, 1))
        return [each["title"] for each in content(designs[1], snapshots=stored)["snapshots"]]

    told = names(("Reach · low", "Reach · middle", "Reach · high"))
    assert told == ["Snapshot 1 · low", "Snapshot 2, shown above · middle", "Snapshot 3 · high"]
    called = ("Snapshot 1", "Snapshot 2, shown above", "Snapshot 3")
    by_hz = [
        f"{each} · {hz}\N{NO-BREAK SPACE}Hz"
        for each, hz in zip(called, (50, 100, 200), strict=True)
    ]
    assert names(("", "", "")) == names(("A tone", "A tone", "A tone")) == by_hz


def test_snapshots_that_neither_title_nor_frequency_tells_have_the_numbers_of_the_window():
    def both(amplitude):
        other = ss.waveforms.Tone(frequency_hz=200.0, duration_s=0.2)
        return design_of(tone(), ss.track(9, other, amplitude=amplitude), title="Two tones")

    stored = tuple(Snapshot(number=k, design=both(float(k))) for k in (1, 2))

    def names(shown):
        return [each["title"] for each in content(shown, snapshots=stored)["snapshots"]]

    assert names(both(2.0)) == ["Snapshot 1", "Snapshot 2, shown above"]
    assert names(both(3.0)) == ["Working design, shown above", "Snapshot 1", "Snapshot 2"]


def test_maps_of_snapshots_know_their_inputs_and_what_is_mostly_noise(synthetic_installed):
    soft = Snapshot(number=1, design=design_of(tone(amplitude=1e-5), limb="measured-1"))
    shown = content(design_of(tone(amplitude=0.0, place=3), tone(9)), snapshots=(soft,))
    own, other = shown["snapshots"]
    assert (own["inputs"], own["noisy"]) == ((3, 9), ())
    findings = ss.evaluate(soft.design, "validity")["validity"]
    (noise,) = [found for found in findings if found.name == "noise"]
    assert len(noise.outputs) > 10
    assert (other["inputs"], other["noisy"]) == ((7,), noise.outputs)


def test_errors_have_two_digits_and_are_not_below_what_is_known():
    design = design_of()
    rms = ss.evaluate(design, "output_rms")["output_rms"]
    known = ExportedDesign(design, ss.View()).value(
        "trace_error", outputs=(int(np.argmax(rms)) + 1,)
    )
    (line,) = [line for line in content(design)["details"] if line.startswith("error of")]
    told = re.search(r"about ([\d.e-]+) .* at most ([\d.e-]+) ", line).groups()
    for text, error in zip(told, (known.estimate, known.bound), strict=True):
        assert re.fullmatch(r"\d(\.\d)?e-\d+", text)
        assert error <= float(text) <= 1.1 * error


def test_a_zoomed_view_gives_its_part():
    whole, part = content(design_of()), content(design_of(), time_range_s=(0.1, 0.2))
    delay_s = ss.load_limb("synthetic-1").pre_trigger_delay_s
    assert (part["first_s"], part["last_s"]) == pytest.approx((0.1 - delay_s, 0.2 - delay_s))
    skipped = round((part["field"]["first_s"] - whole["field"]["first_s"]) * 1300)
    same = samples_of(whole["field"])[:, skipped:][:, : part["field"]["count"]]
    np.testing.assert_allclose(
        samples_of(part["field"]), same, atol=whole["field"]["largest"] / 32767
    )


def test_too_long_designs_and_other_endings_are_refused(tmp_path):
    long = design_of(tone(), ss.track(7, TONE, onset_s=20.0))
    with pytest.raises(InvalidInputError, match="expected up to 12 s"):
        ss.export_page(long, tmp_path / "a.html")
    part = ss.View(time_range_s=(19.9, 20.5))
    assert ss.export_page(long, tmp_path / "a.html", view=part).stat().st_size > 50_000
    with pytest.raises(InvalidInputError, match=r"Call it \*\.html"):
        ss.export_page(design_of(), tmp_path / "a.htm")
    with pytest.raises(StorageError):
        ss.export_page(design_of(), tmp_path / "none" / "a.html")


def test_the_command_shares_a_design(tmp_path, capsys):
    path, out = tmp_path / "a.skinsource", tmp_path / "new" / "a.html"
    ss.save_design(path, design_of(title="Shared"))
    assert main(["share", str(path), "--out", str(out)]) == 0
    assert capsys.readouterr().out == f"{out}\n"
    assert content_of(out.read_text("utf-8"))["title"] == "Shared"


class Read(HTMLParser):
    """Tags and attributes of a page, and the text in each kind of element."""

    def __init__(self, page):
        super().__init__()
        self.found, self.within, self.tag = [], {}, ""
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.found.append((tag, dict(attrs)))
        self.tag = tag

    def handle_endtag(self, tag):
        self.tag = ""

    def handle_data(self, data):
        self.within[self.tag] = data


def test_texts_are_never_markup():
    plain = page_of(content(design_of()))
    clip = replace(tone().clips[0], label=HOSTILE[:60])
    track = replace(tone(), clips=(clip,))
    design = design_of(track, title=HOSTILE[:60], notes=HOSTILE, author=HOSTILE[:60])
    snapshot = Snapshot(number=1, design=design_of(), title=HOSTILE[:50])
    shown = content(design, snapshots=(snapshot,))
    page = page_of(shown)
    assert [tag for tag, _ in Read(page).found] == [tag for tag, _ in Read(plain).found]
    assert page.count("<script") == plain.count("<script") == 2
    read_back = content_of(page)
    assert read_back["notes"] == HOSTILE
    assert read_back == json.loads(json.dumps(shown))


def test_the_policy_allows_what_is_in_the_page_and_no_request():
    read = Read(page_of(content(design_of())))
    attributes = [given for _, given in read.found]
    (policy,) = [given["content"] for given in attributes if "http-equiv" in given]
    rules = dict(rule.split(" ", 1) for rule in policy.split("; "))
    assert set(rules) == {"default-src", "script-src", "style-src", "img-src", "base-uri"}
    assert rules["default-src"] == rules["base-uri"] == "'none'"
    assert rules["img-src"] == "data:"
    for tag in ("script", "style"):
        digest = hashlib.sha256(read.within[tag].encode()).digest()
        assert rules[f"{tag}-src"] == f"'sha256-{base64.b64encode(digest).decode()}'"
    # Nothing is named that lies elsewhere; no element has code or style of its own.
    named = [given[key] for given in attributes for key in ("src", "href") if key in given]
    assert named == ["data:,"]
    assert not any(key.startswith("on") or key == "style" for given in attributes for key in given)


# ---- what a browser shows ----


@pytest.fixture(scope="module")
def browser():
    """Start Chromium without a window; give its driver."""
    selenium = pytest.importorskip("selenium.webdriver", reason="selenium is not installed")
    program, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if program is None or driver is None:
        pytest.skip("Chromium is not here with its driver: install chromium and chromium-driver")
    options = selenium.ChromeOptions()
    options.binary_location = program
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    running = selenium.Chrome(options, selenium.ChromeService(driver))
    running.set_script_timeout(120)
    yield running
    running.quit()


@pytest.fixture
def open_page(browser, tmp_path):
    """Give a function that opens the page of a design, and returns the driver."""
    support = pytest.importorskip("selenium.webdriver.support.ui")

    def opened(design, width_px=1200, colours="light", height_px=800, **view):
        path = ss.export_page(design, tmp_path / "a.html", view=ss.View(**view))
        features = [{"name": "prefers-color-scheme", "value": colours}]
        size = {"width": width_px, "height": height_px, "deviceScaleFactor": 1}
        size["mobile"] = width_px < 500
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
        browser.get(path.as_uri())
        wait(browser, "return document.documentElement.dataset.ready")
        return browser

    def wait(browser, script):
        return support.WebDriverWait(browser, 60).until(lambda _: browser.execute_script(script))

    opened.wait = wait
    return opened


class Firefox:
    """Firefox without a window, asked over WebDriver BiDi, for which it needs no driver."""

    def __init__(self, program, profile, websocket):
        options = (
            "--headless",
            "--no-remote",
            "--remote-debugging-port",
            "0",
            "--profile",
            profile,
        )
        self._process = subprocess.Popen((program, *options), stderr=subprocess.PIPE, text=True)
        address = next(line.split()[-1] for line in self._process.stderr if "BiDi" in line)
        self._socket = websocket.create_connection(
            f"{address}/session", timeout=120, suppress_origin=True
        )
        self._asked = 0
        self.ask("session.new", capabilities={})
        self._tab = self.ask("browsingContext.getTree")["contexts"][0]["context"]

    def ask(self, method, **params):
        self._asked += 1
        self._socket.send(json.dumps({"id": self._asked, "method": method, "params": params}))
        return json.loads(self._socket.recv())["result"]

    def open(self, path):
        self.ask("browsingContext.navigate", context=self._tab, url=path.as_uri(), wait="complete")
        self.wait("document.documentElement.dataset.ready")

    def wait(self, condition):
        frame = "await new Promise(requestAnimationFrame)"
        self.run(f"async () => {{ while (!({condition})) {frame}; return null; }}")

    def run(self, function, *arguments):
        """Return what an asynchronous function of the page returns."""
        call = f"({function})(...{json.dumps(arguments)}).then(JSON.stringify)"
        target = {"context": self._tab}
        ran = self.ask("script.evaluate", expression=call, target=target, awaitPromise=True)
        return json.loads(ran["result"]["value"])

    def press(self, *keys):
        presses = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        source = {"type": "key", "id": "keyboard", "actions": presses}
        self.ask("input.performActions", context=self._tab, actions=[source])

    def quit(self):
        self.ask("browser.close")
        self._socket.close()
        self._process.communicate(timeout=60)


@pytest.fixture(scope="module")
def firefox(tmp_path_factory):
    """Start Firefox without a window."""
    websocket = pytest.importorskip("websocket", reason="websocket-client is not installed")
    program = shutil.which("firefox")
    if program is None:
        pytest.skip("Firefox is not here: install it, or firefox-esr")
    running = Firefox(program, str(tmp_path_factory.mktemp("profile")), websocket)
    yield running
    running.quit()


# Instants between samples.
TIMES_S = (0.0203, 0.0911, 0.1507)
SHOWN = """
async (contents, timesS) => {
  const shown = [];
  for (const content of contents) {
    await showPage(content);
    shown.push({
      levels: [...byId("levels").tBodies[0].rows].map((row) => row.cells[2].textContent),
      fields: timesS.map((timeS) => [...fieldAt(page, timeS)]),
    });
  }
  return shown;
}
"""


def assert_as_in_the_library(drawn, shown):
    for (design, view, content_), each in zip(drawn, shown, strict=True):
        values = ss.evaluate(design, "output_levels_db", "moving_z", view=view)
        texts = [
            text.replace("silent", "-200").replace("\N{MINUS SIGN}", "-") for text in each["levels"]
        ]
        np.testing.assert_allclose(np.array(texts, float), values["output_levels_db"], atol=0.1)
        moving, largest = values["moving_z"], content_["field"]["largest"]
        for time_s, field in zip(TIMES_S, each["fields"], strict=True):
            expected = moving.acceleration(time_s + moving.delay_s)[:, 0]
            np.testing.assert_allclose(field, expected, atol=1e-4 * largest)


def test_a_browser_shows_levels_and_motion_of_drawn_designs(open_page, drawn):
    contents = [shown for _, _, shown in drawn]
    script = f"""const [contents, timesS, done] = arguments;
    ({SHOWN.strip()})(contents, timesS).then(done, (error) => done(String(error)))"""
    shown = open_page(design_of()).execute_async_script(script, contents, TIMES_S)
    assert_as_in_the_library(drawn, shown)


def test_firefox_shows_the_same(firefox, tmp_path, drawn):
    firefox.open(ss.export_page(design_of(), tmp_path / "a.html"))
    shown = firefox.run(SHOWN.strip(), [content_ for _, _, content_ in drawn], TIMES_S)
    assert_as_in_the_library(drawn, shown)


def test_firefox_plays_by_keys_and_asks_for_nothing(firefox, tmp_path):
    firefox.open(ss.export_page(design_of(), tmp_path / "a.html"))
    begin_ms = firefox.run("async () => byId('time').valueAsNumber")
    firefox.press("\ue014")
    assert firefox.run("async () => byId('time').valueAsNumber") == pytest.approx(begin_ms + 1.0)
    firefox.press(" ")
    firefox.wait(f"byId('time').valueAsNumber > {begin_ms + 1.5}")
    firefox.press(" ")
    assert firefox.run("async () => byId('play').textContent") == "Play"
    refused = "fetch('data:,a').then(() => 'got it', () => 'refused')"
    assert firefox.run(f"() => {refused}") == "refused"


def test_a_browser_shows_the_lengths_of_vectors_of_a_measured_limb(open_page, synthetic_installed):
    design = design_of(limb="measured-1")
    moving = ss.evaluate(design, "moving_vector")["moving_vector"]
    field = open_page(design).execute_script("return [...fieldAt(page, 0.0903)]")
    expected = moving.magnitude(0.0903 + moving.delay_s)
    np.testing.assert_allclose(field, expected, atol=0.02 * moving.largest)


def test_the_page_asks_for_nothing(open_page):
    browser = open_page(design_of(title="A"), snapshots=(Snapshot(number=1, design=design_of()),))
    browser.find_element("id", "sound").click()
    refused = "fetch('data:,a').then(() => done('got it'), () => done('refused'))"
    script = f"const done = arguments[0]; {refused}"
    assert browser.execute_async_script(script) == "refused"
    messages = [json.loads(entry["message"])["message"] for entry in browser.get_log("performance")]
    urls = {
        each["params"]["request"]["url"]
        for each in messages
        if each["method"] == "Network.requestWillBeSent"
    }
    assert {url.partition(":")[0] for url in urls} <= {"file", "data"}
    assert sum(url.startswith("file:") for url in urls) >= 1
    complaints = [entry["message"] for entry in browser.get_log("browser")]
    # Only what the test asked for.
    assert all("data:,a" in message for message in complaints), complaints


def test_hostile_texts_are_shown_as_they_are(open_page):
    snapshot = Snapshot(number=1, design=design_of(), title=HOSTILE[:60])
    browser = open_page(design_of(title=HOSTILE[:60], notes=HOSTILE), snapshots=(snapshot,))
    assert browser.find_element("id", "notes").get_attribute("textContent") == HOSTILE
    assert browser.find_element("id", "title").text == HOSTILE[:60]
    captions = browser.find_elements("css selector", "figcaption")
    assert any(HOSTILE[:60] in caption.text for caption in captions)
    assert browser.execute_script("return [window.hit, document.images.length]") == [None, 0]


def test_the_map_is_drawn_before_all_else_is_read(open_page):
    # Of damaged curves it is told when they are read.
    shown = content(design_of())
    shown["tracks"][0]["curve"]["low"] = "AAAA"
    browser = open_page(design_of())
    drawn = browser.execute_script("return byId('map').toDataURL()")
    blank = "byId('map').getContext('2d').reset(); return byId('map').toDataURL()"
    assert browser.execute_script(blank) != drawn
    script = """const [content, done] = arguments;
    showPage(content).then(() => done("read"), () => done(byId("map").toDataURL()))"""
    assert browser.execute_async_script(script, shown) == drawn


def test_maps_hatch_what_is_mostly_noise_and_say_so(open_page, synthetic_installed):
    soft = Snapshot(number=1, design=design_of(tone(amplitude=1e-5), limb="measured-1"))
    browser = open_page(design_of(), snapshots=(soft,))
    script = """
    const canvas = document.querySelector("#snapshots canvas");
    return page.snapshots.map((snapshot) => {
      const drawn = (noisy) => {
        drawMap(canvas, page.maps[snapshot.map], levelsOf(snapshot), page.range_db, "levels",
          { ...snapshot, noisy });
        return canvas.toDataURL();
      };
      return drawn(snapshot.noisy) === drawn([]);
    });
    """
    assert browser.execute_script(script) == [True, False]
    texts = [browser.find_element("id", name).text for name in ("hatched", "snapshots-hatched")]
    assert texts == ["", "Hatched: less than 6 dB above the noise of the measurement."]


def test_ends_of_scales_say_where_values_lie_beyond(open_page):
    browser = open_page(design_of())
    ends = [browser.find_element("id", name).text for name in ("low", "high")]
    # Under the input the skin moves more than the last colour tells.
    assert [text[:2] for text in ends] == ["≤ ", "≥ "]
    browser.find_element("css selector", "[value=levels]").click()
    assert browser.find_element("id", "high").text[0] not in "≤≥"
    browser.find_element("id", "play").click()
    # While it plays, too, the numbers are those of the colours.
    assert [browser.find_element("id", name).text for name in ("low", "high")] == ends
    assert "normal to the skin" in browser.find_element("id", "unit").text


def test_keys_play_and_step(open_page):
    keys = pytest.importorskip("selenium.webdriver.common.keys").Keys
    browser = open_page(design_of())
    body, play, time = (
        browser.find_element("css selector", css) for css in ("body", "#play", "#time")
    )
    begin_ms = float(time.get_attribute("value"))
    body.send_keys(keys.ARROW_RIGHT)
    body.send_keys(keys.SHIFT, keys.ARROW_RIGHT)
    assert float(time.get_attribute("value")) == pytest.approx(begin_ms + 11.0, abs=0.11)
    assert "strongest is output" in time.get_attribute("aria-valuetext")
    body.send_keys(" ")
    assert play.text == "Pause"
    moved = f"return byId('time').valueAsNumber > {begin_ms + 11.5}"
    open_page.wait(browser, moved)
    body.send_keys(" ")
    assert play.text == "Play"
    # What opens has its own use of the key.
    summary = browser.find_element("css selector", "#levels-summary")
    summary.send_keys(" ")
    assert browser.find_element("id", "levels").is_displayed()
    assert play.text == "Play"


@pytest.mark.parametrize("clicked", ["#play", "[value=levels]", "#modes label", "#up", "summary"])
def test_what_was_clicked_leaves_the_keys_to_the_time(open_page, clicked):
    chains = pytest.importorskip("selenium.webdriver.common.action_chains")
    browser = open_page(design_of())
    browser.find_element("css selector", clicked).click()
    browser.execute_script("setPlaying(false); goTo(0.05)")
    mode = browser.execute_script("return mode()")
    chains.ActionChains(browser).send_keys("\ue014").perform()
    assert browser.execute_script("return [timeS, mode()]") == [pytest.approx(0.051), mode]
    chains.ActionChains(browser).send_keys(" ").perform()
    assert browser.find_element("id", "play").text == "Pause"


def test_what_is_reached_by_keys_has_its_own_use_of_them(open_page):
    chains = pytest.importorskip("selenium.webdriver.common.action_chains")
    browser = open_page(design_of())
    # Motion and Levels are reached first.
    chains.ActionChains(browser).send_keys("\ue004", "\ue014").perform()
    assert browser.execute_script("return mode()") == "levels"
    chains.ActionChains(browser).send_keys("\ue004", " ").perform()
    assert browser.execute_script("return [playing, document.activeElement.id]") == [True, "play"]


def test_play_begins_where_the_motion_begins(open_page):
    browser = open_page(design_of(ss.track(7, TONE, onset_s=0.3)), time_range_s=(0.2, 0.5))
    begin_s = browser.execute_script("return page.loop.begin_s")
    assert browser.execute_script("return timeS") > begin_s
    started = "byId('play').click(); return timeS"
    assert browser.execute_script(started) == begin_s
    # From another instant it goes on.
    going_on = "setPlaying(false); goTo(0.35); byId('play').click(); return timeS"
    assert browser.execute_script(going_on) == 0.35


def test_what_the_pointer_reads_follows_time(open_page):
    chains = pytest.importorskip("selenium.webdriver.common.action_chains")
    browser = open_page(design_of())
    canvas = browser.find_element("id", "map")
    # Output 30, from the middle.
    away = browser.execute_script("""
    const map = page.maps[0], { clientWidth, clientHeight } = byId("map");
    const [place] = placing(map, clientWidth, clientHeight, BELOW_PX);
    const [x, y] = place(...map.outputs_mm[29]);
    return [x - clientWidth / 2, y - clientHeight / 2].map(Math.round);
    """)
    chains.ActionChains(browser).move_to_element_with_offset(canvas, *away).perform()
    for mode in ("motion", "levels"):
        browser.find_element("css selector", f"[value={mode}]").click()
        chains.ActionChains(browser).send_keys("\ue014").perform()
        expected = browser.execute_script(
            "return `at ${clockText()} ${numberText(fieldAt(page, timeS)[29])} m/s²`"
        )
        read = browser.find_element("id", "readout").text
        assert read.startswith("Output 30, ")
        assert read.endswith(expected)
        assert " dB re 1 m/s², " in read


def test_snapshots_say_where_they_are_loudest(open_page):
    stored = (
        Snapshot(number=1, design=design_of()),
        Snapshot(number=2, design=design_of(tone(muted=True))),
    )
    browser = open_page(design_of(), snapshots=stored)
    levels_db = ss.evaluate(design_of(), "output_levels_db")["output_levels_db"]
    loudest = np.argmax(levels_db)
    own, silent = browser.find_elements("css selector", "figcaption span:last-child")
    level = f"{levels_db[loudest]:.1f}".replace("-", "\N{MINUS SIGN}")
    assert own.text == f"loudest {level} dB re 1 m/s² at output {loudest + 1}"
    assert silent.text == "nothing moves"


def test_the_drive_plays_and_stops(open_page):
    browser = open_page(design_of(ss.track(7, ss.waveforms.Tone(duration_s=5.0))))
    sound = browser.find_element("id", "sound")
    sound.click()
    assert sound.text == "Stop the drive"
    sound.click()
    open_page.wait(browser, "return byId('sound').textContent === 'Play the drive'")
    assert not open_page(design_of(tone(muted=True))).find_element("id", "sound").is_enabled()


@pytest.mark.parametrize(("width_px", "height_px"), [(375, 553), (360, 740), (1366, 768)])
def test_play_is_on_the_first_screen(open_page, width_px, height_px):
    bottom = "return byId('play').getBoundingClientRect().bottom"
    browser = open_page(design_of(title="A tone"), width_px, height_px=height_px)
    assert browser.execute_script(bottom) < height_px


@pytest.mark.parametrize("colours", ["light", "dark"])
def test_it_fits_a_phone_in_light_and_dark(open_page, colours):
    snapshots = tuple(Snapshot(number=k, design=design_of()) for k in (1, 2, 3))
    long = "A title of one long word: " + "w" * 100
    browser = open_page(design_of(title=long), 360, colours, snapshots=snapshots, outputs=(1, 2))
    widths = "return [document.documentElement.scrollWidth, innerWidth]"
    assert browser.execute_script(widths) == [360, 360]
    ground = browser.execute_script("return getComputedStyle(document.body).backgroundColor")
    assert (ground == "rgb(255, 255, 255)") == (colours == "light")


def test_the_map_shows_levels_or_motion(open_page):
    browser = open_page(design_of())
    pixels = "return byId('map').toDataURL()"
    motion = browser.execute_script(pixels)
    assert "Skin map. " in browser.find_element("id", "map").get_attribute("aria-label")
    browser.find_element("css selector", "[value=levels]").click()
    assert browser.find_element("id", "unit").text == "dB re 1 m/s²"
    assert browser.execute_script(pixels) != motion


def test_all_that_can_be_used_has_a_name(open_page):
    browser = open_page(design_of(), snapshots=(Snapshot(number=1, design=design_of()),))
    browser.execute_cdp_cmd("Accessibility.enable", {})
    nodes = browser.execute_cdp_cmd("Accessibility.getFullAXTree", {})["nodes"]
    used = {"button", "slider", "radio", "checkbox", "combobox", "image", "table"}
    named = [
        (node["role"]["value"], node["name"]["value"])
        for node in nodes
        if not node["ignored"] and node["role"]["value"] in used
    ]
    assert len(named) > 8
    assert [role for role, name in named if not name] == []
