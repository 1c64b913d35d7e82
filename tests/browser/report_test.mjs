// Opens a report from the disk as a reader would and tries everything in it:
//   node report_test.mjs CHROMIUM REPORT.html HISTORY.csv [FOLDER for pictures]
// HISTORY.csv is the run's own export: what the page shows is compared with it.
// Ends with 0, or with 1 and one line for each thing that is wrong.

import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Chromium } from "./chromium.mjs";
import { faintTexts, overlaps } from "./layout.mjs";

const [program, report, history, pictures] = process.argv.slice(2);
const faults = [];
const check = (holds, what) => {
  if (!holds) faults.push(what);
};
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance;

/** The pixels of the picture, coarsely: the sum over a grid of 16 x 16 cells, to tell two pictures apart. */
const FINGERPRINT = `(() => {
  const source = document.querySelector("#stage canvas");
  const small = document.createElement("canvas");
  small.width = small.height = 64;
  const context = small.getContext("2d");
  context.drawImage(source, 0, 0, 64, 64);
  return [...context.getImageData(0, 0, 64, 64).data];
})()`;
const difference = (a, b) => a.reduce((sum, v, i) => sum + Math.abs(v - b[i]), 0) / a.length;

/** Where the cursors of time stand: share of the timeline, and of each plot that is drawn. */
const CURSORS = `(() => {
  const { clock } = stillhook;
  const share = (clock.time - clock.start) / (clock.end - clock.start);
  const range = document.querySelector("input.cursor");
  const plots = [...document.querySelectorAll(".live")].filter((e) => e.querySelector(".u-over")).map((e) => {
    const over = e.querySelector(".u-over").getBoundingClientRect();
    const now = e.querySelector(".now").getBoundingClientRect();
    return (now.left + now.width / 2 - over.left) / over.width;
  });
  return { share, rail: (range.value - range.min) / (range.max - range.min), plots };
})()`;

async function checkCursors(page, what) {
  const { share, rail, plots } = await page.evaluate(CURSORS);
  check(near(rail, share, 1e-3), `${what}: the timeline's cursor stands at ${rail}, not at ${share}`);
  check(plots.length >= 1, `${what}: no plot is drawn`);
  for (const at of plots) check(near(at, share, 0.005), `${what}: a plot's cursor stands at ${at}, not at ${share}`);
}

async function checkScrubbing(page) {
  const { start, end } = await page.evaluate("({ start: stillhook.clock.start, end: stillhook.clock.end })");
  const rail = await page.evaluate(`(() => { const rail = document.querySelector(".rail");
    rail.scrollIntoView({ block: "center" });
    const r = rail.getBoundingClientRect();
    return { x: r.left, y: r.top + r.height / 2, width: r.width }; })()`);
  const seen = [];
  for (const share of [0.1, 0.5, 0.85]) {
    await page.click(rail.x + share * rail.width, rail.y);
    await page.settle();
    const time = await page.evaluate("stillhook.clock.time");
    check(near((time - start) / (end - start), share, 0.01), `a click at ${share} of the timeline leads to ${time} s`);
    await checkCursors(page, `after a click at ${share}`);
    const picture = await page.evaluate(FINGERPRINT);
    if (seen.length) check(difference(picture, seen.at(-1)) > 0.5, `the scene does not change up to ${share}`);
    seen.push(picture);
  }
}

/** The run's export: its channels by name, underscores as blanks, which is how the page writes names. */
function readHistory(path) {
  const [head, ...rows] = readFileSync(path, "utf8").trim().split("\n").map((line) => line.split(","));
  const columns = new Map(head.map((title, i) => [title.replace(/ \[[^\]]*\]$/, "").replaceAll("_", " "), rows.map((row) => Number(row[i]))]));
  return { time: columns.get("time"), columns };
}

/** R_WB of roll, pitch and yaw, which turn about x, then y, then z of the world; written out. */
function rotation(roll, pitch, yaw) {
  const [cr, sr, cp, sp, cy, sy] = [Math.cos(roll), Math.sin(roll), Math.cos(pitch), Math.sin(pitch), Math.cos(yaw), Math.sin(yaw)];
  return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
          [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
          [-sp, cp * sr, cp * cr]];
}

/** Every body stands and is turned in the picture as the run's own angles say, and tensions, hook load and wave are the run's. */
async function checkAgainstRun(page, run) {
  const shown = await page.evaluate(`(() => {
    const { payload, clock, scene } = stillhook;
    const { header } = payload;
    const out = [];
    for (let k = 0; k <= 40; ++k) {
      const i = Math.round((k / 40) * (payload.time.length - 1));
      clock.set(payload.time[i]);
      out.push({
        time: payload.time[i],
        bodies: scene.bodies.filter(({ body }) => body.pose.length).map(({ body, group }) => ({ name: body.name, at: [...group.matrixWorld.elements] })),
        lines: header.scene.lines.filter((line) => line.tension >= 0).map((line) => ({ name: line.name, kind: line.kind, tension: payload.series(line.tension)[i] })),
        readings: Object.fromEntries(header.readings.map((r) => [r.label, payload.series(r.series)[i]])),
      });
    }
    return out;
  })()`);
  const tonne = 9806.65;
  let turned = 0;
  for (const { time, bodies, lines, readings } of shown) {
    const row = run.time.findIndex((t) => Math.abs(t - time) < 6e-4); // the page's times are whole milliseconds
    if (row < 0) {
      check(false, `the run has no sample at ${time} s`);
      continue;
    }
    const value = (name) => run.columns.get(name)?.[row] ?? NaN;
    for (const { name, at } of bodies) {
      const place = ["x", "y", "z"].map((axis) => value(`${name}.${axis}`));
      // A series keeps 1/65534 of its range: 2 mm in 100 m.
      for (let k = 0; k < 3; ++k)
        check(near(at[12 + k], place[k], 3e-3), `${name} stands at ${at[12 + k]}, not at ${place[k]} (${"xyz"[k]}, ${time} s)`);
      const R = rotation(value(`${name}.roll`), value(`${name}.pitch`), value(`${name}.yaw`));
      // Each part of a quaternion is stored to half of 1/65534 of its range of at most 2.
      for (let column = 0; column < 3; ++column)
        for (let r = 0; r < 3; ++r)
          check(near(at[4 * column + r], R[r][column], 2e-4), `${name} is not turned as in the run at ${time} s: ${at[4 * column + r]} for ${R[r][column]}`);
      turned = Math.max(turned, Math.abs(R[1][0]), Math.abs(R[2][0]), Math.abs(R[2][1]));
    }
    let hoisted = 0;
    for (const { name, kind, tension } of lines) {
      const truth = value(`${name}.tension`) / tonne;
      check(near(tension, truth, 2e-4 * Math.max(50, Math.abs(truth)) + 0.05), `tension of ${name} is ${tension} t, not ${truth} t (${time} s)`);
      if (kind === "hoist") hoisted += truth;
    }
    check(near(readings["hook load"], hoisted, 0.1), `the hook load reads ${readings["hook load"]} t, not ${hoisted} t (${time} s)`);
    check(near(readings.wave, value("sea.elevation"), 1e-3), `the wave reads ${readings.wave} m, not ${value("sea.elevation")} m (${time} s)`);
  }
  // Without a large turn a conjugated quaternion would pass: the booms of every shipped lift lean by more than this.
  check(turned > 0.2, `nothing in this run is turned by more than ${turned}, so its attitudes are not tried`);
}

/** The scene's bodies stand where the payload has them, the sea is the run's own. */
async function checkTruth(page) {
  const wrong = await page.evaluate(`(() => {
    const { payload, clock, scene, elevation } = stillhook;
    const wrong = [];
    const wave = payload.header.readings.find((r) => r.label === "wave");
    for (const share of [0.02, 0.31, 0.77]) {
      clock.set(clock.start + share * (clock.end - clock.start));
      const place = payload.place(clock.time);
      const sample = payload.time[place.i];
      if (wave) {
        const s = payload.header.series[wave.series];
        const error = elevation(0, 0, sample) - payload.series(wave.series)[place.i];
        if (!(Math.abs(error) < s.step + 1e-3)) wrong.push("sea at the origin is off by " + error + " m at " + sample + " s");
      }
      for (const { body, group } of scene.bodies)
        for (const [k, axis] of ["x", "y", "z"].entries())
          if (!(Math.abs(group.position[axis] - payload.value(body.pose[k], place)) < 1e-6)) wrong.push(body.name + "." + axis);
      // The payload has w, x, y, z; what the scene turns by is the matrix, written out here from them.
      for (const { body, group } of scene.bodies) {
        const parts = [3, 4, 5, 6].map((k) => payload.value(body.pose[k], place)), length = Math.hypot(...parts);
        const [w, x, y, z] = parts.map((part) => part / length);
        const columns = [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
                         [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
                         [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]];
        for (let column = 0; column < 3; ++column)
          for (let row = 0; row < 3; ++row)
            if (!(Math.abs(group.matrix.elements[4 * column + row] - columns[column][row]) < 1e-6)) wrong.push(body.name + " is turned wrongly");
      }
    }
    return wrong;
  })()`);
  for (const what of wrong) check(false, what);
}

async function checkContacts(page) {
  const marks = await page.evaluate(`[...document.querySelectorAll(".mark")].map((m) => Number(m.dataset.at))`);
  const known = await page.evaluate(`stillhook.payload.header.contacts.filter((c) => c.kind !== "at rest at the start").length`);
  check((marks.length > 0) === (known > 0), `${known} contacts, but ${marks.length} marks`);
  for (let i = 0; i < marks.length; ++i) {
    const { x, y } = await page.evaluate(`(() => { const r = document.querySelectorAll(".mark")[${i}].getBoundingClientRect();
      return { x: r.left + r.width / 2, y: r.top + r.height / 2 }; })()`);
    await page.click(x, y);
    await page.settle();
    const { time, text } = await page.evaluate(`({ time: stillhook.clock.time, text: document.querySelector(".event").textContent })`);
    check(near(time, marks[i], 1e-3), `contact mark ${i} leads to ${time} s, not to ${marks[i]} s`);
    check(text.includes("m/s"), `contact mark ${i} says "${text}"`);
  }
  const link = await page.evaluate(`document.querySelector(".jump")?.closest("[data-time]").dataset.time ?? null`);
  if (link === null) return;
  await page.evaluate(`document.querySelector(".jump").click()`);
  const time = await page.evaluate("stillhook.clock.time");
  check(near(time, Number(link), 1e-2), `a time in the text leads to ${time} s, not to ${link} s`);
}

async function checkKeys(page) {
  await page.evaluate(`stillhook.clock.set(stillhook.clock.start + 100), document.querySelector("#stage canvas").focus()`);
  const after = async (key, more) => {
    const before = await page.evaluate("stillhook.clock.time");
    await page.key(key, more);
    return (await page.evaluate("stillhook.clock.time")) - before;
  };
  check(near(await after("ArrowRight"), 5, 1e-6), "arrow right does not lead 5 s on");
  check(near(await after("ArrowLeft", { shift: true }), -0.2, 1e-6), "shift and arrow left does not lead 0.2 s back");
  await page.key("Home");
  check(await page.evaluate("stillhook.clock.time === stillhook.clock.start"), "Home does not lead to the start");
  await page.key(" ");
  check(await page.evaluate("stillhook.clock.playing"), "space does not play");
  await page.until("stillhook.clock.time > stillhook.clock.start + 1");
  await page.key(" ");
  check(!(await page.evaluate("stillhook.clock.playing")), "space does not pause");
  const view = await page.evaluate("stillhook.scene.camera.position.toArray()");
  await page.key("4");
  check((await page.evaluate("stillhook.scene.camera.position.toArray()")).some((v, i) => !near(v, view[i], 1)), "4 does not change the view");
  await page.key("1");
  await page.key("f");
  check(await page.evaluate("stillhook.scene.followed !== null"), "F does not follow the load");
  await page.key("f");
  await page.key("h");
  check(await page.evaluate(`document.querySelector("dialog").open`), "H does not show the keys");
  await page.key("Escape");
  // Tab alone reaches every control of the replay.
  await page.evaluate(`document.querySelector("#stage canvas").focus()`);
  const names = [];
  for (let i = 0; i < 12; ++i) {
    await page.key("Tab");
    names.push(await page.evaluate(`document.activeElement.getAttribute("aria-label") ?? document.activeElement.textContent.slice(0, 40)`));
  }
  for (const wanted of ["Play (space)", "Speed of the replay", "Time of the replay"])
    check(names.includes(wanted), `Tab does not reach "${wanted}": ${names.join(", ")}`);
}

const run = readHistory(history);
const browser = await Chromium.launch(program);
try {
  for (const [width, height] of [[1280, 800], [390, 844]]) {
    const size = `${width} x ${height}`;
    const page = await browser.open(width, height);
    await page.go(pathToFileURL(resolve(report)).href);
    await page.until(`document.documentElement.dataset.replay === "ready"`);
    await page.settle();
    check(await page.evaluate("stillhook.scene !== null"), `${size}: the scene is not there`);
    check(await page.evaluate("stillhook.clock.time === stillhook.payload.header.opens"), `${size}: the replay does not open where it shall`);
    await page.evaluate("stillhook.clock.set(stillhook.clock.start)"); // calm still: the waves grow from nothing
    check(!(await page.evaluate(`/\u22120(\\.0*)? /.test(document.querySelector(".readings").textContent)`)), `${size}: a reading is minus zero`);
    await checkScrubbing(page);
    if (width > 1000) {
      await checkTruth(page);
      await checkAgainstRun(page, run);
      await checkContacts(page);
      await checkKeys(page);
    }
    // Every plot comes alive when it is scrolled to, and shows the same time.
    await page.evaluate(`document.querySelectorAll("details").forEach((d) => (d.open = true))`);
    const figures = await page.evaluate(`document.querySelectorAll("figure[data-plot]").length`);
    for (let i = 0; i < figures; i += 2) {
      await page.evaluate(`document.querySelectorAll("figure[data-plot]")[${i}].scrollIntoView()`);
      await page.settle();
    }
    await page.until(`document.querySelectorAll("figure.is-live").length === ${figures}`);
    await page.settle();
    await checkCursors(page, `${size}, all plots`);
    for (const what of await overlaps(page)) check(false, `${size}: ${what}`);
    for (const what of await faintTexts(page)) check(false, `${size}: ${what}`);
    for (const error of page.errors) check(false, `${size}: console: ${error}`);
    const asked = page.requests.filter((url) => !url.startsWith("data:"));
    check(asked.length === 1, `${size}: the page asked for ${asked.slice(1).join(", ")}`);
    if (pictures) {
      mkdirSync(pictures, { recursive: true });
      await page.evaluate(`scrollTo(0, 0), stillhook.clock.set(stillhook.clock.start + 0.62 * (stillhook.clock.end - stillhook.clock.start))`);
      await page.settle();
      writeFileSync(join(pictures, `report-${width}.png`), await page.screenshot());
    }
    await page.close();
  }
} finally {
  await browser.close();
}
for (const fault of faults) console.error(fault);
process.exit(faults.length ? 1 : 0);
