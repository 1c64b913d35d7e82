// The report's plots, live: the same figures as the drawings they replace on the screen, with a shared cursor.

import uPlot from "uplot";
import { clockText } from "./clock.js";
import { element } from "./element.js";

const COLOURS = ["#0072b2", "#d55e00", "#00805c", "#aa4499", "#806000", "#404040"];
const LIMIT = "#b00020";
const FONT = '12px system-ui, "Segoe UI", Helvetica, Arial, sans-serif';
const TIME_STEPS = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400]; // s
const sync = uPlot.sync("report");

function decimals(step) {
  for (let d = 0; d < 6; ++d) if (Math.abs(step * 10 ** d - Math.round(step * 10 ** d)) < 1e-6) return d;
  return 6;
}

const minus = (text) => (Number(text) === 0 ? text.replace('-', '') : text.replace('-', '\u2212'));

/** A limit or range counts for the axis when it does not squeeze the data into less than 40 % of the height. */
function axisRange(plot) {
  return (u, low, high) => {
    if (low === null) return [0, 1];
    const span = Math.max(high - low, 1e-9 * Math.max(Math.abs(low), Math.abs(high)), 1e-6);
    let [a, b] = [low, high];
    for (const v of [...plot.limits.map((l) => l.value), ...plot.ranges.flatMap((r) => [r.low, r.high])]) {
      if (v === null || v > high + 1.5 * span || v < low - 1.5 * span) continue;
      a = Math.min(a, v);
      b = Math.max(b, v);
    }
    const room = Math.max(0.04 * (b - a), 1e-3);
    return [a - room, b + Math.max(room, 0.12 * (b - a))]; // the phases' names stand above the lines
  };
}

/** Phases as bands with their numbers, ranges, limits. */
function drawBackground(phases, plot) {
  return (u) => {
    const { ctx, bbox } = u;
    const ratio = uPlot.pxRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    phases.forEach((phase, i) => {
      const from = u.valToPos(phase.start, "x", true);
      const width = u.valToPos(phase.end, "x", true) - from;
      ctx.fillStyle = i % 2 ? "#eef1f4" : "#fafbfc";
      ctx.fillRect(from, bbox.top, width, bbox.height);
      ctx.fillStyle = "#3d4852";
      ctx.font = `${11 * ratio}px system-ui, sans-serif`;
      ctx.textAlign = "center";
      ctx.textBaseline = "top";
      const full = `${i + 1} ${phase.name}`;
      const text = ctx.measureText(full).width < width - 6 * ratio ? full : String(i + 1);
      if (ctx.measureText(text).width < width - 2 * ratio) ctx.fillText(text, from + width / 2, bbox.top + 3 * ratio);
    });
    ctx.fillStyle = "rgba(0, 158, 115, .16)";
    for (const range of plot.ranges) {
      const top = u.valToPos(range.high, "y", true);
      ctx.fillRect(bbox.left, top, bbox.width, u.valToPos(range.low, "y", true) - top);
    }
    ctx.restore();
  };
}

function drawLimits(plot) {
  return (u) => {
    const { ctx, bbox } = u;
    const ratio = uPlot.pxRatio;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = LIMIT;
    ctx.lineWidth = 1.4 * ratio;
    ctx.setLineDash([7 * ratio, 4 * ratio]);
    ctx.font = `${11 * ratio}px system-ui, sans-serif`;
    ctx.textAlign = "right";
    ctx.textBaseline = "bottom";
    for (const { value, label } of plot.limits) {
      if (value === null || value < u.scales.y.min || value > u.scales.y.max) continue;
      const y = u.valToPos(value, "y", true);
      ctx.beginPath();
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.stroke();
      if (label) ctx.fillText(label, bbox.left + bbox.width - 4 * ratio, y - 2 * ratio);
    }
    ctx.restore();
  };
}

/** One live plot in `root`, which gives the width. */
export class LivePlot {
  constructor(root, payload, clock, index, height) {
    this.root = root;
    this.clock = clock;
    const plot = payload.header.plots[index];
    const phases = payload.header.phases;
    const off = plot.limits.filter((l) => l.label && l.value !== null);
    this.now = element("div", { class: "now" });
    const options = {
      width: this.#width(),
      height,
      cursor: {
        sync: { key: sync.key, setSeries: false, scales: ["x", null] },
        drag: { x: true, y: false, setScale: true },
        points: { size: 6 },
        bind: {
          // A click sets the time; a drag looks closer.
          click: (u, target, handler) => (event) => {
            handler(event);
            if (!u.select.width) clock.set(u.posToVal(event.offsetX, "x"));
          },
        },
      },
      scales: { x: { time: false, range: (u, a, b) => [a, b] }, y: { range: axisRange(plot) } },
      axes: [
        { font: FONT, stroke: "#1c2329", incrs: TIME_STEPS, grid: { show: false }, ticks: { stroke: "#7c8894", size: 4 }, size: 34, gap: 3,
          values: (u, splits) => splits.map(clockText) },
        { font: FONT, stroke: "#1c2329", label: plot.y_label, labelFont: FONT, labelSize: 18, size: 56, gap: 4,
          grid: { stroke: "#d4dae0", width: 1 }, ticks: { show: false },
          values: (u, splits) => splits.map((v) => minus(v.toFixed(decimals(splits[1] - splits[0])))) },
      ],
      series: [
        { label: "time", value: (u, v) => (v === null ? "–" : clockText(v)) },
        ...plot.lines.map((line, i) => ({
          label: line.label, stroke: COLOURS[i % COLOURS.length], width: 1.4, points: { show: false },
          value: (u, v) => (v === null || Number.isNaN(v) ? "–" : minus(v.toPrecision(4))),
        })),
      ],
      hooks: {
        drawClear: [drawBackground(phases, plot)],
        draw: [drawLimits(plot), () => this.#showTime()],
        setSize: [() => this.#showTime()],
      },
    };
    this.plot = new uPlot(options, [payload.time, ...plot.lines.map((line) => payload.series(line.series))], root);
    this.plot.over.append(this.now);
    this.#showTime();
    root.setAttribute("role", "group");
    root.setAttribute("aria-label", `${plot.title}, ${plot.y_label}`);
    if (off.length) root.dataset.limits = String(off.length);
    this.observer = new ResizeObserver(() => {
      const width = this.#width();
      if (width > 0 && width !== this.plot.width) this.plot.setSize({ width, height });
    });
    this.observer.observe(root);
    this.unlisten = () => (this.gone = true);
    clock.listen(() => this.gone || this.#showTime());
  }

  #width() {
    return Math.floor(this.root.clientWidth);
  }

  #showTime() {
    if (!this.plot) return;
    const { min, max } = this.plot.scales.x;
    const { time } = this.clock;
    this.now.hidden = time < min || time > max;
    this.now.style.transform = `translateX(${this.plot.valToPos(time, "x")}px)`;
    if (this.plot.cursor.left < 0) this.plot.setLegend({ idx: this.plot.valToIdx(time) }, false);
  }

  destroy() {
    this.gone = true;
    this.observer.disconnect();
    this.plot.destroy();
    this.plot = null;
  }
}

/** Replaces the drawings of the report by live plots when they come near the window. */
export function enlivenFigures(payload, clock) {
  const watch = new IntersectionObserver(
    (entries) => {
      for (const { isIntersecting, target } of entries) {
        if (!isIntersecting) continue;
        watch.unobserve(target);
        const index = Number(target.dataset.plot);
        const host = element("div", { class: "live" });
        target.prepend(element("h4", {}, payload.header.plots[index].title), host);
        target.classList.add("is-live");
        new LivePlot(host, payload, clock, index, 250);
      }
    },
    { rootMargin: "300px" },
  );
  for (const figure of document.querySelectorAll("figure[data-plot]")) watch.observe(figure);
}
