"use strict";
// Shows the design that stands in the page as JSON. Arrays are deflated and written in base64.

const byId = (id) => document.getElementById(id);
const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70",
  "7ad151", "bddf26", "fde725"];
// Blue is negative, red positive.
const DIVERGING = ["053061", "2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7", "fddbc7", "f4a582",
  "d6604d", "b2182b", "67001f"];
const CURVES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b07d00", "#56b4e9"];
const FRAMES_PER_S = 60;
// Samples on each side of an instant that its value is made of, and the shape of their window.
const REACH = 64, BETA = 12.3;
const MEANINGS = {
  signed: "Red and blue: accelerated in opposite directions. White: at rest.",
  magnitude: "Bright: strongly accelerated, in any direction. Dark: at rest.",
  levels: "Bright: strong. Dark: weak.",
};
const NEAREST_MM = 15, BELOW_PX = 22;

// ---- what is embedded ----

async function unpacked(text, kind) {
  const letters = atob(text), bytes = new Uint8Array(letters.length);
  // From an iterator the first picture would come 0.1 s later.
  for (let k = 0; k < bytes.length; k++) bytes[k] = letters.charCodeAt(k);
  const stream = new Response(bytes).body.pipeThrough(new DecompressionStream("deflate"));
  return new kind(await new Response(stream).arrayBuffer());
}

async function readMap(map) {
  const [inside, counts, outputs, weights] = await Promise.all([
    unpacked(map.inside, Uint8Array), unpacked(map.counts, Uint8Array),
    unpacked(map.outputs, Uint16Array), unpacked(map.weights, Uint8Array)]);
  const pixels = [];
  inside.forEach((is, pixel) => { if (is) pixels.push(pixel); });
  // Weights of a pixel are rounded; together they are 1.
  const shares = new Float64Array(weights.length);
  for (let k = 0, entry = 0; k < counts.length; entry += counts[k], k++) {
    let sum = 0;
    for (let j = entry; j < entry + counts[k]; j++) sum += weights[j];
    for (let j = entry; j < entry + counts[k]; j++) shares[j] = weights[j] / sum;
  }
  return { ...map, pixels, counts, outputs, shares };
}

async function readRow(row) {
  const { curve } = row;
  return { ...row, curve: curve && { ...curve, low: await unpacked(curve.low, Int8Array),
    high: await unpacked(curve.high, Int8Array) } };
}

// What the first picture needs.
async function readFirst(data) {
  const { field } = data;
  const [values, map] = await Promise.all([
    unpacked(field.values, field.signed ? Int16Array : Uint8Array), readMap(data.maps[0])]);
  return { ...data, field: { ...field, values }, maps: [map], otherMaps: data.maps.slice(1) };
}

async function readRest(first) {
  const all = (items, read) => Promise.all(items.map(read));
  const { sound } = first;
  const [others, traces, tracks, plain, up] = await Promise.all([
    all(first.otherMaps, readMap), all(first.traces, readRow), all(first.tracks, readRow),
    sound && unpacked(sound.plain, Int16Array), sound && unpacked(sound.up, Int16Array)]);
  return { ...first, maps: [...first.maps, ...others], traces, tracks,
    sound: sound && { ...sound, plain, up } };
}

// ---- values ----

function bessel(x) {
  let sum = 1, term = 1;
  for (let k = 1; term > 1e-12 * sum; k++) {
    term *= (x / (2 * k)) ** 2;
    sum += term;
  }
  return sum;
}

function weightOf(distance) {
  const window = Math.abs(distance) < REACH
    ? bessel(BETA * Math.sqrt(1 - (distance / REACH) ** 2)) / bessel(BETA) : 0;
  return distance === 0 ? 1 : window * Math.sin(Math.PI * distance) / (Math.PI * distance);
}

// The field at an instant, in m/s², between samples as a band-limited signal. Where lengths of
// vectors are embedded, it is their squares that are band-limited.
function fieldAt(page, timeS) {
  const { values, signed, count, rate_hz, first_s, largest } = page.field;
  const position = (timeS - first_s) * rate_hz;
  const first = Math.max(Math.floor(position) + 1 - REACH, 0);
  const end = Math.min(Math.floor(position) + 1 + REACH, count);
  const weights = [];
  for (let k = first; k < end; k++) weights.push(weightOf(k - position));
  const result = new Float64Array(page.levels.length);
  for (let output = 0; output < result.length; output++) {
    let sum = 0;
    for (let k = first; k < end; k++) {
      const value = values[output * count + k];
      sum += weights[k - first] * (signed ? value / 32767 : (value / 255) ** 4);
    }
    result[output] = largest * (signed ? sum : Math.sqrt(Math.max(sum, 0)));
  }
  return result;
}

const levelsOf = (page) => page.levels.map((hundredths) => hundredths / 100);
const minus = (text) => text.replace("-", "\u2212");
const SILENT_DB = -199, DB = " dB re 1 m/s²";
const levelText = (db, unit = "") => (db <= SILENT_DB ? "silent" : minus(db.toFixed(1)) + unit);
const numberText = (value) => minus(String(Number(value.toPrecision(3))));
const endTexts = ([low, high], [least, most]) => [
  `${least < low ? "\u2264 " : ""}${numberText(low)}`,
  `${most > high ? "\u2265 " : ""}${numberText(high)}`];
const reachOf = (levels) => [Math.min(...levels), Math.max(...levels)];
const strongest = (values) => values.reduce((best, value, k) =>
  (Math.abs(value) > Math.abs(values[best]) ? k : best), 0);
const loudest = (levels) => levels.reduce((best, db, k) => (db > levels[best] ? k : best), 0);

// ---- drawing ----

function tableOf(anchors) {
  const table = new Uint8ClampedArray(4 * 256);
  for (let k = 0; k < 256; k++) {
    const at = k / 255 * (anchors.length - 1), left = Math.min(Math.floor(at), anchors.length - 2);
    for (let c = 0; c < 3; c++) {
      const [a, b] = [left, left + 1].map((n) => parseInt(anchors[n].slice(2 * c, 2 * c + 2), 16));
      table[4 * k + c] = a + (b - a) * (at - left);
    }
    table[4 * k + 3] = 255;
  }
  return table;
}

const TABLES = { levels: tableOf(VIRIDIS), magnitude: tableOf(VIRIDIS), signed: tableOf(DIVERGING) };
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Returns the context of a canvas in the pixels of the style sheet, cleared, with its size.
function cleared(canvas, height) {
  if (height) canvas.style.height = `${height}px`;
  const ratio = window.devicePixelRatio || 1;
  const size = [canvas.clientWidth, canvas.clientHeight];
  [canvas.width, canvas.height] = size.map((side) => Math.max(Math.round(side * ratio), 1));
  const pen = canvas.getContext("2d");
  pen.scale(ratio, ratio);
  pen.font = "12px system-ui, sans-serif";
  return [pen, ...size];
}

function pictureOf(map, values, [low, high], table) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [map.columns, map.rows];
  const pen = canvas.getContext("2d"), image = pen.createImageData(map.columns, map.rows);
  for (let k = 0, entry = 0; k < map.pixels.length; entry += map.counts[k], k++) {
    let value = 0;
    for (let j = entry; j < entry + map.counts[k]; j++) {
      value += map.shares[j] * values[map.outputs[j]];
    }
    const share = Math.min(Math.max((value - low) / (high - low), 0), 1);
    // Rows rise with y, those of a picture fall.
    const line = map.rows - 1 - Math.floor(map.pixels[k] / map.columns);
    const row = 4 * Math.round(255 * share);
    const target = 4 * (line * map.columns + map.pixels[k] % map.columns);
    for (let c = 0; c < 4; c++) image.data[target + c] = table[row + c];
  }
  pen.putImageData(image, 0, 0);
  return canvas;
}

// Returns a function from mm to pixels of a canvas that holds all of a map, and pixels per mm.
function placing(map, width, height, below) {
  const [x0, y0, x1, y1] = map.bounds_mm;
  const room = Math.min((width - 8) / (x1 - x0), (height - 8 - below) / (y1 - y0));
  const scale = Math.max(room, 0);
  const left = (width - scale * (x1 - x0)) / 2;
  return [(x, y) => [left + scale * (x - x0), 4 + scale * (y1 - y)], scale];
}

// A map with a bar of length has outputs that are ringed.
function drawMap(canvas, map, values, range, kind, { noisy, inputs, outputs }) {
  const [pen, width, height] = cleared(canvas);
  const [place, scale] = placing(map, width, height, outputs ? BELOW_PX : 0);
  const outline = new Path2D();
  map.outline_mm.forEach(([x, y], k) => outline[k ? "lineTo" : "moveTo"](...place(x, y)));
  outline.closePath();
  pen.save();
  pen.clip(outline);
  const [left, top] = place(map.x_mm - map.step_mm / 2, map.y_mm + (map.rows - 0.5) * map.step_mm);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(pictureOf(map, values, range, TABLES[kind]), left, top,
    scale * map.step_mm * map.columns, scale * map.step_mm * map.rows);
  hatch(pen, map, noisy, place, scale);
  pen.restore();
  pen.strokeStyle = colour("--dim");
  pen.stroke(outline);
  const ring = (at, radius, style) => {
    if (at === null) return;
    pen.strokeStyle = style;
    pen.beginPath();
    pen.arc(...place(...at), radius, 0, 2 * Math.PI);
    pen.stroke();
  };
  for (const [points, numbers, radius] of [[map.outputs_mm, outputs || [], 4],
    [map.inputs_mm, inputs, outputs ? 7 : 4]]) {
    for (const number of numbers) {
      pen.lineWidth = 3.5;
      ring(points[number - 1], radius, "#ffffff");
      pen.lineWidth = 1.5;
      ring(points[number - 1], radius, "#1c1f23");
    }
  }
  if (!outputs) return;
  pen.fillStyle = colour("--ink");
  pen.fillRect(width - 4 - 50 * scale, height - 6, 50 * scale, 2);
  pen.textAlign = "right";
  pen.fillText("50 mm", width - 4, height - 10);
}

// Where an output is mostly noise, as in the pictures of the studio.
function hatch(pen, map, noisy, place, scale) {
  const area = new Path2D(), placed = noisy.filter((number) => map.outputs_mm[number - 1]);
  if (!placed.length) return;
  for (const number of placed) {
    const [x, y] = place(...map.outputs_mm[number - 1]);
    area.moveTo(x, y);
    area.arc(x, y, map.noise_reach_mm * scale, 0, 2 * Math.PI);
  }
  pen.clip(area);
  pen.strokeStyle = "#b0b0b0";
  pen.beginPath();
  const size = pen.canvas.height + pen.canvas.width;
  for (let x = -size; x < size; x += 6) {
    pen.moveTo(x, size);
    pen.lineTo(x + size, 0);
  }
  pen.stroke();
}

function drawBar(canvas, kind) {
  const [pen, width, height] = cleared(canvas);
  for (let k = 0; k < 256; k++) {
    pen.fillStyle = `rgb(${TABLES[kind].slice(4 * k, 4 * k + 3).join(",")})`;
    pen.fillRect(k * width / 256, 0, width / 256 + 1, height);
  }
}

function drawCurve(pen, curve, page, width, middle, half, style) {
  const area = new Path2D(), span = page.last_s - page.first_s;
  const add = (k, value) => area.lineTo(
    (curve.first_s + k * curve.step_s - page.first_s) / span * width, middle - value / 127 * half);
  curve.high.forEach((value, k) => add(k, value));
  for (let k = curve.low.length - 1; k >= 0; k--) add(k, curve.low[k]);
  [pen.fillStyle, pen.strokeStyle, pen.lineJoin] = [style, style, "round"];
  pen.fill(area);
  pen.stroke(area);
}

const STEPS_S = [0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5];

// Lines at round times; a text below each where there is room for texts alone.
function drawTimes(pen, page, width, height, texts) {
  const span = page.last_s - page.first_s;
  const step = STEPS_S.find((s) => span / s <= Math.max(width / 70, 2)) || 10;
  pen.fillStyle = colour("--dim");
  pen.strokeStyle = colour("--line");
  pen.lineWidth = 1;
  for (let k = Math.ceil(page.first_s / step - 1e-9); k * step <= page.last_s + 1e-9; k++) {
    const x = (k * step - page.first_s) / span * width;
    pen.beginPath();
    pen.moveTo(x, 0);
    pen.lineTo(x, texts ? 4 : height);
    pen.stroke();
    if (!texts) continue;
    const text = step < 1 ? `${Math.round(1e3 * k * step)} ms` : `${k * step} s`;
    pen.textAlign = x < 24 ? "left" : x > width - 24 ? "right" : "center";
    pen.fillText(text, Math.min(Math.max(x, 0), width), height - 5);
  }
}

// Curves above each other, each below its text.
function drawRows(box, page, rows, rowPx) {
  box.replaceChildren();
  rows.forEach((row, k) => {
    added(box, "p", row.text);
    const canvas = added(box, "canvas", "");
    canvas.setAttribute("aria-hidden", "true");
    const [pen, width, height] = cleared(canvas, rowPx);
    const style = row.pale ? colour("--dim") : CURVES[k % CURVES.length];
    drawTimes(pen, page, width, height, false);
    for (const [begin, end] of row.spans || []) {
      const [a, b] = [begin, end].map((t) =>
        Math.min(Math.max((t - page.first_s) / (page.last_s - page.first_s), 0), 1) * width);
      pen.globalAlpha = 0.16;
      pen.fillStyle = style;
      pen.fillRect(a, 0, Math.max(b - a, 2), height);
      pen.globalAlpha = 1;
    }
    if (row.curve) drawCurve(pen, row.curve, page, width, height / 2, height / 2 - 2, style);
  });
  if (!rows.length) added(box, "p", "No inputs.");
  const times = added(box, "canvas", "");
  times.setAttribute("aria-hidden", "true");
  const [pen, width, height] = cleared(times, 20);
  drawTimes(pen, page, width, height, true);
}

// ---- the page ----

let page = null, whole = false, timeS = 0, slower = 1, playing = false, shownAt = 0, voice = null;
// Whether the pointer was used last, and the output that it reads.
let pointed = false, read = -1;
const mode = () => document.querySelector("input[name=mode]:checked").value;

function shown() {
  if (mode() === "levels") return [levelsOf(page), page.range_db, "levels"];
  const { signed, limit } = page.field;
  return [fieldAt(page, timeS), [signed ? -limit : 0, limit], signed ? "signed" : "magnitude"];
}

// What the colours mean: numbers at both ends, unit, and a sentence.
function writeScale() {
  const [values, range, kind] = shown(), { exceeded, quantity } = page.field;
  const beyond = exceeded ? Infinity : 0;
  const reached = kind === "levels" ? reachOf(values) : [kind === "signed" ? -beyond : 0, beyond];
  const [low, high] = endTexts(range, reached);
  const unit = kind === "levels" ? "dB re 1 m/s²" : quantity;
  byId("low").textContent = low;
  byId("high").textContent = high;
  byId("unit").textContent = unit;
  byId("meaning").textContent = kind === "levels"
    ? `${page.levels_label}. ${MEANINGS.levels}` : MEANINGS[kind];
  byId("colours").setAttribute("aria-label", `Colours from ${low} to ${high} ${unit}`);
  drawBar(byId("colours"), kind);
}

const clockText = () => minus(`${(1e3 * timeS).toFixed(1)} ms`);
const outputText = (k) => `output ${k + 1}, ${page.names[k]}`;

function writeReadout(field) {
  const text = outputText(read), level = levelText(page.levels[read] / 100, DB);
  byId("readout").textContent = `${text[0].toUpperCase()}${text.slice(1)}: level ${level}, `
    + `at ${clockText()} ${numberText(field[read])} m/s²`;
}

function drawSkin() {
  const [values, range, kind] = shown();
  drawMap(byId("map"), page.maps[0], values, range, kind, page);
  const best = kind === "levels" ? loudest(values) : strongest(values);
  const at = kind === "levels" ? "Levels" : clockText();
  const rests = kind === "levels" ? values[best] <= SILENT_DB : values[best] === 0;
  const value = kind === "levels" ? levelText(values[best], DB)
    : `${numberText(values[best])} m/s²`;
  const text = `${at}: ${rests ? "nothing moves" : `strongest is ${outputText(best)}, ${value}`}`;
  byId("time").value = 1e3 * timeS;
  byId("clock").textContent = clockText();
  for (const cursor of document.querySelectorAll(".cursor:not(#heard)")) move(cursor, timeS);
  if (read >= 0) writeReadout(kind === "levels" ? fieldAt(page, timeS) : values);
  if (playing) return;
  byId("map").setAttribute("aria-label", `Skin map. ${text}`);
  byId("time").setAttribute("aria-valuetext", text);
}

function move(cursor, seconds) {
  const share = (seconds - page.first_s) / (page.last_s - page.first_s);
  cursor.style.transform = `translateX(${share * (cursor.parentElement.clientWidth - 2)}px)`;
}

function goTo(seconds) {
  timeS = Math.min(Math.max(seconds, page.first_s), page.last_s);
  drawSkin();
}

function setPlaying(on) {
  playing = on;
  if (on) byId("modes").querySelector("[value=motion]").checked = true;
  // The first picture is of the loudest instant.
  if (on && timeS === page.loop.loudest_s) timeS = page.loop.begin_s;
  byId("play").textContent = on ? "Pause" : "Play";
  writeScale();
  shownAt = performance.now();
  if (on) requestAnimationFrame(step);
  else drawSkin();
}

function step(now) {
  if (!playing) return;
  const { begin_s, end_s } = page.loop;
  // A page that was hidden goes on where it was.
  const next = timeS + Math.min(Math.max(now - shownAt, 0), 100) / 1e3 / slower;
  shownAt = now;
  const over = timeS <= end_s ? next - end_s : next - page.last_s;
  goTo(over > 0 ? begin_s + over % (end_s - begin_s) : next);
  requestAnimationFrame(step);
}

function stopSound() {
  if (voice) voice.stop();
}

async function playSound() {
  if (voice) return stopSound();
  const { rate_hz, first_s } = page.sound;
  const samples = byId("up").checked ? page.sound.up : page.sound.plain;
  const context = new AudioContext(), buffer = context.createBuffer(1, samples.length, rate_hz);
  buffer.copyToChannel(Float32Array.from(samples, (value) => value / 32767), 0);
  voice = context.createBufferSource();
  voice.buffer = buffer;
  voice.connect(context.destination);
  voice.onended = () => {
    voice = null;
    context.close();
    byId("heard").hidden = true;
    byId("sound").textContent = "Play the drive";
  };
  byId("sound").textContent = "Stop the drive";
  byId("heard").hidden = false;
  const started = context.currentTime;
  voice.start();
  const follow = () => {
    if (!voice) return;
    move(byId("heard"), first_s + context.currentTime - started);
    requestAnimationFrame(follow);
  };
  follow();
}

function pointAt(event) {
  const map = page.maps[0], canvas = byId("map");
  const [place, scale] = placing(map, canvas.clientWidth, canvas.clientHeight, BELOW_PX);
  let best = -1, least = (scale * NEAREST_MM) ** 2;
  map.outputs_mm.forEach((at, k) => {
    if (at === null) return;
    const [x, y] = place(...at), far = (x - event.offsetX) ** 2 + (y - event.offsetY) ** 2;
    if (far < least) [best, least] = [k, far];
  });
  if (best < 0) return;
  read = best;
  writeReadout(fieldAt(page, timeS));
}

function added(parent, tag, text, before = null) {
  const element = document.createElement(tag);
  element.textContent = text;
  parent.insertBefore(element, before);
  return element;
}

function listed(id, texts) {
  byId(id).replaceChildren();
  for (const text of texts) added(byId(id), "li", text);
}

// What is read first.
function writeHead() {
  document.title = page.title || "SkinSource design";
  byId("title").textContent = page.title || "Vibration of the skin";
  byId("about").textContent = page.about;
  byId("synthetic").hidden = !page.synthetic;
  byId("hatched").textContent = hatchedText([page]);
}

const hatchedText = (maps) => (maps.some((map) => map.noisy?.length) ? page.hatched : "");

function writeTexts() {
  byId("notes").textContent = page.notes;
  byId("notes-part").hidden = !page.notes;
  listed("cautions", page.cautions);
  listed("details", page.details);
  listed("citation", page.citation);
  listed("clips", page.tracks.flatMap((track) => track.clips.length
    ? track.clips.map((clip) => `${track.name}: ${clip.text}`) : [`${track.name}: no clips`]));
  const levels = levelsOf(page), best = loudest(levels);
  byId("strongest").textContent = `${page.levels_label}. `
    + (levels[best] <= SILENT_DB ? "Nothing moves."
      : `Strongest: ${outputText(best)}, ${levelText(levels[best], DB)}.`);
  byId("levels-summary").textContent = `All ${levels.length} outputs`;
  const body = byId("levels").tBodies[0];
  body.replaceChildren();
  levels.forEach((db, k) => {
    const row = body.insertRow();
    const noisy = page.noisy.includes(k + 1) ? " (mostly noise)" : "";
    for (const text of [String(k + 1), page.names[k] + noisy, levelText(db)]) {
      added(row, "td", text);
    }
  });
  byId("traces-part").hidden = !page.traces.length;
  byId("traces-about").textContent = page.traces_about;
}

function writeSnapshots() {
  byId("snapshots-part").hidden = !page.snapshots.length;
  byId("snapshots").replaceChildren();
  const all = page.snapshots.flatMap((each) => (each.levels ? levelsOf(each) : []));
  [byId("least").textContent, byId("most").textContent] = endTexts(page.range_db, reachOf(all));
  byId("snapshots-hatched").textContent = hatchedText(page.snapshots);
  drawBar(byId("scale"), "levels");
  const drawings = [];
  for (const snapshot of page.snapshots) {
    const figure = added(byId("snapshots"), "figure", "");
    const caption = added(figure, "figcaption", snapshot.title);
    added(caption, "span", snapshot.about);
    if (!snapshot.levels) continue;
    const levels = levelsOf(snapshot), best = loudest(levels);
    const text = levels[best] <= SILENT_DB ? "nothing moves"
      : `loudest ${levelText(levels[best], DB)} at output ${best + 1}`;
    added(caption, "span", text);
    const canvas = added(figure, "canvas", "", caption);
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `Skin map of ${snapshot.title}, ${text}`);
    drawings.push([canvas, page.maps[snapshot.map], levels, page.range_db, "levels", snapshot]);
  }
  // Each is as wide as all of them leave room for.
  for (const drawing of drawings) drawMap(...drawing);
}

function drawFirst() {
  writeScale();
  drawSkin();
}

function drawRest() {
  drawRows(byId("timeline"), page, page.tracks.map((track) => ({ ...track, pale: !track.audible,
    spans: track.clips.map((clip) => clip.span_s) })), 34);
  drawRows(byId("traces"), page, page.traces, 62);
  writeSnapshots();
}

function drawAll() {
  if (!page) return;
  drawFirst();
  if (whole) drawRest();
}

function writeSpeeds() {
  const speeds = byId("speed");
  speeds.replaceChildren();
  for (const factor of page.speeds) {
    const clearest = factor === page.clearest ? " (clearest)" : "";
    added(speeds, "option", `1/${numberText(factor)} of real time${clearest}`).value = factor;
  }
  slower = speeds.value = page.clearest;
}

// Shows another design; returns when all of it is drawn.
async function showPage(data) {
  whole = false;
  page = await readFirst(data);
  [byId("time").min, byId("time").max] = [1e3 * page.first_s, 1e3 * page.last_s];
  timeS = page.loop.loudest_s;
  writeHead();
  writeSpeeds();
  drawFirst();
  // All else waits until that is on the screen.
  await new Promise((go) => { requestAnimationFrame(() => setTimeout(go)); });
  page = await readRest(page);
  whole = true;
  byId("sound").disabled = !page.sound;
  writeTexts();
  drawRest();
}

// What was clicked gives its keys back; what was reached by keys has its own use of them.
function giveBack() {
  if (pointed) document.activeElement.closest("button, summary, input:not(#time)")?.blur();
}

function keyPressed(event) {
  pointed = false;
  if (!page || event.ctrlKey || event.metaKey || event.altKey) return;
  const move = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  const own = move ? "select, [type=radio]" : "button, select, summary, input:not(#time)";
  if (event.target.closest(own) || !(event.key === " " || move)) return;
  event.preventDefault();
  if (move) goTo(timeS + move * (event.shiftKey ? 0.01 : 0.001));
  else setPlaying(!playing);
}

function connect() {
  byId("play").addEventListener("click", () => setPlaying(!playing));
  byId("time").addEventListener("input", (event) => goTo(event.target.valueAsNumber / 1e3));
  byId("speed").addEventListener("change", (event) => { slower = Number(event.target.value); });
  byId("sound").addEventListener("click", playSound);
  byId("up").addEventListener("change", stopSound);
  byId("modes").addEventListener("change", () => setPlaying(false));
  byId("map").addEventListener("pointermove", pointAt);
  byId("map").addEventListener("pointerdown", pointAt);
  document.addEventListener("keydown", keyPressed);
  document.addEventListener("pointerdown", () => { pointed = true; });
  document.addEventListener("click", giveBack);
  for (const plot of document.querySelectorAll(".plot")) {
    const follow = (event) => {
      if (!event.buttons) return;
      const { left, width } = plot.getBoundingClientRect();
      goTo(page.first_s + (event.clientX - left) / width * (page.last_s - page.first_s));
    };
    plot.addEventListener("pointerdown", follow);
    plot.addEventListener("pointermove", follow);
  }
  window.addEventListener("resize", drawAll);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
}

function complain(text) {
  byId("problem").textContent = text;
  byId("problem").hidden = false;
}

if (typeof DecompressionStream === "undefined") {
  complain("This browser is too old. Open the page with one of 2023 or later.");
} else {
  connect();
  showPage(JSON.parse(byId("data").textContent)).then(
    () => { document.documentElement.dataset.ready = Math.round(performance.now()); },
    (error) => complain(`The page is damaged (${error.message}). Ask for it again.`));
}
