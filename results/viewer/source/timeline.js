// The operation as a bar with a cursor that can be dragged, and the contacts under it.

import { clockText } from "./clock.js";
import { element } from "./element.js";

const CLOSEST = 24; // px between the middles of two marks

/** Contacts that would lie on one another become one mark, which leads to the fastest of them. */
export function cluster(contacts, place) {
  const marks = [];
  for (const contact of contacts) {
    const last = marks[marks.length - 1];
    if (last && place(contact.time) - place(last[0].time) < CLOSEST) last.push(contact);
    else marks.push([contact]);
  }
  return marks;
}

const worst = (contacts) => contacts.reduce((a, b) => (b.speed > a.speed ? b : a));

export function describe(contact) {
  return `${contact.name}: ${contact.kind} at ${clockText(contact.time)}, ${contact.speed.toFixed(2)} m/s, ${contact.force.toFixed(0)} t`;
}

export class Timeline {
  constructor(root, payload, clock, jump) {
    this.clock = clock;
    this.jump = jump;
    const { start, end } = clock;
    this.contacts = payload.header.contacts.filter((c) => c.kind !== "at rest at the start");
    this.phases = payload.header.phases;
    this.ticks = root.querySelector(".ticks");
    const track = root.querySelector(".track");
    track.setAttribute("aria-hidden", "true");
    track.removeAttribute("role");
    this.cursor = element("input", {
      type: "range", class: "cursor", min: start, max: end, step: "any", "aria-label": "Time of the replay",
      oninput: () => clock.set(Number(this.cursor.value)),
    });
    const rail = element("div", { class: "rail" });
    track.replaceWith(rail);
    rail.append(track, this.cursor);
    this.ticks.removeAttribute("aria-hidden");
    new ResizeObserver(() => this.#drawMarks()).observe(this.ticks);
    clock.listen(() => this.#show());
  }

  phaseAt(t) {
    let name = "";
    for (const phase of this.phases) if (t >= phase.start - 1e-6) name = phase.name;
    return name;
  }

  /** The contact before (-1) or after (+1) the time now. */
  neighbour(direction) {
    const t = this.clock.time;
    const later = this.contacts.filter((c) => (direction > 0 ? c.time > t + 0.05 : c.time < t - 0.05));
    return direction > 0 ? later[0] : later[later.length - 1];
  }

  #show() {
    const { time } = this.clock;
    this.cursor.value = time;
    this.cursor.setAttribute("aria-valuetext", `${clockText(time)}, ${this.phaseAt(time)}`);
  }

  #drawMarks() {
    const { start, end } = this.clock;
    const width = this.ticks.clientWidth;
    if (!width) return;
    const place = (t) => ((t - start) / (end - start)) * width;
    this.ticks.replaceChildren(
      ...cluster(this.contacts, place).map((contacts) => {
        const contact = worst(contacts);
        const text = contacts.length === 1
          ? describe(contact)
          : `${contacts.length} contacts from ${clockText(contacts[0].time)} to ${clockText(contacts[contacts.length - 1].time)}, fastest ${describe(contact)}`;
        const bad = contacts.some((c) => c.kind === "re-hit");
        return element("button", {
          type: "button", class: bad ? "mark bad" : "mark", title: text, "aria-label": text, "data-at": contact.time,
          style: `left:${Math.min(width - 12, Math.max(12, place(contacts[0].time))).toFixed(1)}px`,
          onclick: () => this.jump(contact),
        });
      }),
    );
  }
}
