// The report's live part: scene, timeline and plots around one clock.

import 'uplot/dist/uPlot.min.css';
import './style.css';

import {Clock, clockText, fixed, SPEEDS} from './clock.js';
import {element} from './element.js';
import {bindKeys} from './keys.js';
import {TENSION_COLOURS} from './lines.js';
import {Payload} from './payload.js';
import {enlivenFigures, LivePlot} from './plots.js';
import {ReplayScene, VIEWS} from './scene.js';
import {elevation} from './sea.js';
import {describe, Timeline} from './timeline.js';

const button = (text, label, onclick, more = {}) =>
  element("button", { type: "button", "aria-label": label, title: label, onclick, ...more }, text);

function legend(touches) {
  const last = TENSION_COLOURS[TENSION_COLOURS.length - 1][0];
  const stops = TENSION_COLOURS.map(([at, colour]) => `${colour} ${((100 * at) / last).toFixed(0)}%`).join(",");
  const mark = (at, text) => element("span", { style: `left:${((100 * at) / last).toFixed(1)}%` }, text);
  return element(
      'div',
      {class: 'legend'},
      element('div', {}, 'Wire tension ÷ static'),
      element('div', {class: 'scale', style: `background:linear-gradient(90deg,${stops})`}),
      element('div', {class: 'scale-marks'}, mark(0, '0'), mark(0.5, '0.5'), mark(1, '1'), mark(1.5, '1.5')),
      ...(touches ? [element('div', {class: 'ring'}, 'something touches')] : []),
  );
}

/** Everything about the picture: canvas, readings, views. Without WebGL the reason stands in its place. */
function buildStage(root, payload, clock) {
  const stage = root.querySelector("#stage");
  const canvas = element("canvas", { tabindex: "0", role: "img", "aria-label": "3-D replay of the lift. Space plays, arrow keys move in time, H lists all keys." });
  let scene;
  try {
    scene = new ReplayScene(canvas, payload);
  } catch (error) {
    stage.replaceChildren(element("p", { class: "muted" }, `There is no 3-D replay in this browser: ${error.message}`));
    return null;
  }
  const views = VIEWS.map(({ name }, i) =>
    button(name, `View: ${name} (key ${i + 1})`, () => look(i), { "aria-pressed": String(i === 0) }));
  const follow = button("Follow load", "Keep the camera with the load (key F)", () => setFollow(scene.followed === null), { "aria-pressed": "false" });
  const look = (index) => {
    scene.view(index);
    if (scene.followed) scene.follow(true);
    views.forEach((b, i) => b.setAttribute("aria-pressed", String(i === index)));
  };
  const setFollow = (on) => {
    scene.follow(on);
    if (!on) scene.view(scene.current);
    follow.setAttribute("aria-pressed", String(on));
  };
  const readings = element("dl", { class: "readings" });
  const event = element("div", { class: "event", role: "status" });
  stage.replaceChildren(
      canvas, readings, event, legend(scene.contacts.length > 0),
      element('div', {class: 'views', role: 'toolbar', 'aria-label': 'Views'}, ...views, follow));
  canvas.addEventListener("focus", () => (scene.controls.enableZoom = true));
  canvas.addEventListener("blur", () => (scene.controls.enableZoom = false));
  canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
  const resize = () => stage.clientWidth && scene.resize(stage.clientWidth, stage.clientHeight);
  new ResizeObserver(resize).observe(stage);
  resize();
  clock.listen(({ time }) => {
    scene.update(time);
    const place = payload.place(time);
    const rows = payload.header.readings.map(
        ({label,
          unit,
          decimals,
          series}) => [label, `${fixed(payload.value(series, place), decimals)}${unit === '°' ? '' : ' '}${unit}`]);
    readings.replaceChildren(...rows.flatMap(([k, v]) => [element("dt", {}, k), element("dd", {}, v)]));
    const near = scene.touching(time);
    const text = near ? describe(near) : "";
    if (event.textContent !== text) event.textContent = text;
  });
  // For paper: the picture as it stands.
  const print = element("img", { class: "printed", alt: "The scene at the time shown" });
  stage.append(print);
  window.addEventListener("beforeprint", () => {
    scene.dirty = true;
    scene.draw();
    print.src = canvas.toDataURL("image/png");
  });
  return { scene, look, setFollow };
}

function buildControls(clock, timeline, jump) {
  const play = button("▶", "Play (space)", () => clock.toggle(), { class: "play" });
  const speed = element("select", { "aria-label": "Speed of the replay", onchange: () => clock.setSpeed(Number(speed.value)) },
    ...SPEEDS.map((s) => element("option", { value: s }, `${s} ×`)));
  const time = element("output", { class: "time", "aria-label": "Time and phase" });
  const step = (direction) => {
    const contact = timeline.neighbour(direction);
    if (contact) jump(contact);
  };
  const contacts = timeline.contacts.length
    ? [button("◂ contact", "Previous contact (key P)", () => step(-1)), button("contact ▸", "Next contact (key N)", () => step(1))]
    : [];
  clock.listen(() => {
    const label = clock.playing ? "Pause (space)" : "Play (space)";
    play.textContent = clock.playing ? "❚❚" : "▶";
    if (play.title !== label) {
      play.title = label;
      play.setAttribute("aria-label", label);
    }
    speed.value = String(clock.speed);
    time.textContent = `${clockText(clock.time)} · ${timeline.phaseAt(clock.time)}`;
  });
  return { node: element("div", { class: "controls" }, play, speed, time, ...contacts), step };
}

/** One plot beside the scene, to be chosen. */
function buildStrip(payload, clock) {
  const { plots } = payload.header;
  if (!plots.length) return element("div");
  const host = element("div", { class: "live" });
  let shown = null;
  const choice = element("select", { "aria-label": "Plot beside the replay", onchange: () => show(Number(choice.value)) },
    ...plots.map((plot, i) => element("option", { value: i }, plot.title)));
  const show = (index) => {
    shown?.destroy();
    host.replaceChildren();
    shown = new LivePlot(host, payload, clock, index, 150);
    choice.value = String(index);
  };
  const first = Math.max(0, plots.findIndex((plot) => plot.title.startsWith("Hoist wire")));
  requestAnimationFrame(() => show(first));
  return element("div", { class: "strip" }, choice, host);
}

/** Times in the tables lead to the replay. */
function linkTimes(clock, root) {
  for (const span of document.querySelectorAll("[data-time]")) {
    const text = span.textContent;
    span.replaceChildren(
      button(text, `Show ${text} in the replay`, () => {
        clock.toggle(false);
        clock.set(Number(span.dataset.time));
        root.scrollIntoView({ block: "start" });
      }, { class: "jump" }),
    );
  }
}

async function start() {
  const root = document.querySelector("#replay");
  const text = document.querySelector("#replay-data").textContent;
  const payload = await Payload.read(text);
  const { time } = payload;
  const clock = new Clock(time[0], time[time.length - 1]);
  clock.set(payload.header.opens);
  const jump = (contact) => {
    clock.toggle(false);
    clock.set(contact.time);
  };
  const timeline = new Timeline(root, payload, clock, jump);
  const controls = buildControls(clock, timeline, jump);
  const stage = buildStage(root, payload, clock);
  root.querySelector("#stage").after(controls.node);
  root.append(buildStrip(payload, clock));
  bindKeys(root, clock, { stage, step: controls.step });
  linkTimes(clock, root);
  enlivenFigures(payload, clock);
  const frame = (now) => {
    clock.advance(now);
    stage?.scene.draw();
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  // What a test, or a curious reader at the console, asks.
  window.stillhook = { payload, clock, scene: stage?.scene ?? null, elevation: (x, y, t) => elevation(payload.header.scene.sea, x, y, t) };
  document.documentElement.dataset.replay = "ready";
}

start().catch((error) => {
  document.querySelector("#stage").textContent = `The replay could not be started: ${error.message}`;
  throw error;
});
