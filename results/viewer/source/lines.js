// Wires and taglines in the colour of their tension, moorings as catenaries, forces as arrows.

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";

/** Tension over its reference (a wire's largest static tension, a tagline's limit) and the colour that shows it. */
export const TENSION_COLOURS = [
  [0, "#f4f4f4"],
  [0.1, "#8fc7e8"],
  [0.6, "#2a7fb8"],
  [1.0, "#1d4f3f"],
  [1.15, "#e0a100"],
  [1.5, "#c4001d"],
];

const stops = TENSION_COLOURS.map(([at, colour]) => [at, new THREE.Color(colour)]);

export function tensionColour(ratio, out = new THREE.Color()) {
  if (!(ratio > 0)) return out.copy(stops[0][1]);
  for (let i = 1; i < stops.length; ++i)
    if (ratio <= stops[i][0])
      return out.lerpColors(stops[i - 1][1], stops[i][1], (ratio - stops[i - 1][0]) / (stops[i][0] - stops[i - 1][0]));
  return out.copy(stops[stops.length - 1][1]);
}

/** World position of a point of a body; index -1 is the world. */
function worldPoint(bodies, index, point, out) {
  out.set(...point);
  return index < 0 ? out : out.applyMatrix4(bodies[index].group.matrixWorld);
}

export class Wires {
  constructor(lines) {
    this.lines = lines;
    this.geometry = new LineSegmentsGeometry();
    this.geometry.setPositions(new Float32Array(6 * lines.length));
    this.geometry.setColors(new Float32Array(6 * lines.length));
    this.material = new LineMaterial({ vertexColors: true, linewidth: 3 });
    this.mesh = new LineSegments2(this.geometry, this.material);
    this.mesh.frustumCulled = false;
    this.from = new THREE.Vector3();
    this.to = new THREE.Vector3();
    this.colour = new THREE.Color();
  }

  update(payload, place, t, bodies) {
    const points = this.geometry.attributes.instanceStart.data;
    const colours = this.geometry.attributes.instanceColorStart.data;
    this.lines.forEach((line, i) => {
      const shown = line.shown_from !== null && t >= line.shown_from;
      worldPoint(bodies, line.from, line.point_from, this.from);
      worldPoint(bodies, line.to, line.point_to, this.to);
      if (!shown) this.to.copy(this.from);
      const tension = line.tension >= 0 ? payload.value(line.tension, place) : NaN;
      tensionColour(line.reference > 0 ? tension / line.reference : NaN, this.colour);
      points.array.set([this.from.x, this.from.y, this.from.z, this.to.x, this.to.y, this.to.z], 6 * i);
      for (const end of [0, 3]) colours.array.set([this.colour.r, this.colour.g, this.colour.b], 6 * i + end);
    });
    points.needsUpdate = true;
    colours.needsUpdate = true;
  }
}

/** Forces as arrows: along the force, in length its share of the largest. They point at what they push. */
export class Arrows {
  constructor(arrows, length) {
    this.arrows = arrows;
    this.length = length;
    this.group = new THREE.Group();
    this.helpers = arrows.map(() => new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1, "#7a2fb8"));
    for (const helper of this.helpers) this.group.add(helper);
    this.point = new THREE.Vector3();
    this.force = new THREE.Vector3();
  }

  update(payload, place, bodies) {
    this.arrows.forEach((arrow, i) => {
      const helper = this.helpers[i];
      this.force.set(...arrow.force.map((series) => (series >= 0 ? payload.value(series, place) : 0)));
      const length = (this.length * this.force.length()) / arrow.reference;
      helper.visible = length > 0.02 * this.length;
      if (!helper.visible) return;
      worldPoint(bodies, arrow.body, arrow.point, this.point);
      this.force.normalize();
      helper.setDirection(this.force);
      helper.setLength(length, 0.25 * length, 0.12 * length);
      helper.position.copy(this.point).addScaledVector(this.force, -length);
    });
  }
}

const SEGMENTS = 32;

/**
 * Points of a line from fairlead to anchor in a vertical plane: a = H / w; the part above the bottom is a catenary of
 * height h whose foot lies a acosh(1 + h/a) away, the rest lies on the bottom.
 */
function hang(from, anchor, a, out) {
  const height = from.z - anchor.z;
  const across = Math.hypot(anchor.x - from.x, anchor.y - from.y) || 1;
  const foot = a > 0 && height > 0 ? a * Math.acosh(1 + height / a) : Infinity;
  for (let k = 0; k <= SEGMENTS; ++k) {
    const share = k / SEGMENTS;
    const x = share * across;
    let z = from.z + share * (anchor.z - from.z); // straight: a linear line, or one pulled off the bottom
    if (foot <= across) z = x < foot ? anchor.z + a * (Math.cosh((foot - x) / a) - 1) : anchor.z;
    out.push(from.x + share * (anchor.x - from.x), from.y + share * (anchor.y - from.y), z);
  }
}

export class Moorings {
  constructor(moorings) {
    this.moorings = moorings;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6 * SEGMENTS * moorings.length), 3));
    this.mesh = new THREE.LineSegments(
      this.geometry,
      new THREE.LineBasicMaterial({ color: "#39434c", transparent: true, opacity: 0.8 }),
    );
    this.mesh.frustumCulled = false;
    this.from = new THREE.Vector3();
    this.anchor = new THREE.Vector3();
  }

  update(payload, place, bodies) {
    const position = this.geometry.attributes.position;
    this.moorings.forEach((line, i) => {
      worldPoint(bodies, line.body, line.fairlead, this.from);
      this.anchor.set(...line.anchor);
      if (line.tow >= 0) this.anchor.addScaledVector(new THREE.Vector3(...line.tow_direction), payload.value(line.tow, place));
      const a = line.weight > 0 && line.horizontal >= 0 ? payload.value(line.horizontal, place) / line.weight : 0;
      const points = [];
      hang(this.from, this.anchor, a, points);
      for (let k = 0; k < SEGMENTS; ++k) position.array.set(points.slice(3 * k, 3 * k + 6), 6 * (i * SEGMENTS + k));
    });
    position.needsUpdate = true;
  }
}
