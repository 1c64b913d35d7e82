// The keyboard, while the focus is in the replay (WCAG 2.1.4: not elsewhere on the page).

import { element } from "./element.js";

const HELP = [
  ["Space", "play, pause"],
  ["← →", "5 s back, forward; with Shift 0.2 s"],
  ["↑ ↓", "faster, slower"],
  ["Home End", "start, end"],
  ["P N", "previous, next contact"],
  ["1 … 4", "views"],
  ["F", "follow the load"],
  ["A D W S", "turn the camera"],
  ["+ −", "closer, farther"],
  ["H", "this list"],
];

export function bindKeys(root, clock, { stage, step }) {
  const close = () => help.close();
  const help = element("dialog", { "aria-label": "Keys of the replay" },
    element("table", {}, element("tbody", {}, ...HELP.map(([key, what]) =>
      element("tr", {}, element("th", { scope: "row" }, key), element("td", {}, what))))),
    element("button", { type: "button", onclick: close }, "Close"));
  root.append(help);
  const actions = {
    " ": () => clock.toggle(),
    ArrowLeft: (e) => clock.set(clock.time - (e.shiftKey ? 0.2 : 5)),
    ArrowRight: (e) => clock.set(clock.time + (e.shiftKey ? 0.2 : 5)),
    ArrowUp: () => clock.changeSpeed(1),
    ArrowDown: () => clock.changeSpeed(-1),
    Home: () => clock.set(clock.start),
    End: () => clock.set(clock.end),
    p: () => step(-1),
    n: () => step(1),
    f: () => stage?.setFollow(stage.scene.followed === null),
    a: () => stage?.scene.turn(-0.1, 0),
    d: () => stage?.scene.turn(0.1, 0),
    w: () => stage?.scene.turn(0, 0.06),
    s: () => stage?.scene.turn(0, -0.06),
    "+": () => stage?.scene.zoom(0.9),
    "-": () => stage?.scene.zoom(1 / 0.9),
    h: () => help.showModal(),
    "?": () => help.showModal(),
  };
  for (let i = 0; i < 4; ++i) actions[String(i + 1)] = () => stage?.look(i);
  root.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || help.open) return;
    if (event.target.tagName === "SELECT") return;
    if (event.target.tagName === "BUTTON" && event.key === " ") return; // the button's own
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
