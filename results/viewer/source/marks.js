// Marks that tell directions and names: the world's x axis, true north, where the waves go, the bow of each vessel,
// names of bodies.

import * as THREE from "three";

const INK = "#1c2329";
const WAVES = "#0b5fa5";
const NORTH = '#8c0018';
const BOW = "#f2f2ec";
const SAME_DIRECTION = 0.5; // rad, partitions closer than this share an arrow

/** A text that always faces the camera, `height` m high. */
function label(text, height, colour) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const size = 48;
  const font = `600 ${size}px system-ui, sans-serif`;
  context.font = font;
  canvas.width = Math.ceil(context.measureText(text).width) + 24;
  canvas.height = Math.ceil(1.4 * size);
  context.font = font;
  context.textBaseline = "middle";
  context.lineWidth = 8;
  context.strokeStyle = "#ffffff";
  context.strokeText(text, 12, canvas.height / 2);
  context.fillStyle = colour;
  context.fillText(text, 12, canvas.height / 2);
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;  // or dark letters come out grey
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({map: texture, depthTest: false, transparent: true}));
  sprite.renderOrder = 6;
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  return sprite;
}

/** A flat arrow on the water from `from` along the heading (rad from +x, counter-clockwise), with its name at the tip. */
function arrow(from, heading, length, colour, text) {
  const group = new THREE.Group();
  const w = 0.05 * length;
  const outline = [[0, -w], [0.72 * length, -w], [0.72 * length, -3 * w], [length, 0], [0.72 * length, 3 * w], [0.72 * length, w], [0, w]];
  const shape = new THREE.Shape(outline.map(([x, y]) => new THREE.Vector2(x, y)));
  const mesh = new THREE.Mesh(
    new THREE.ShapeGeometry(shape),
    new THREE.MeshBasicMaterial({ color: colour, side: THREE.DoubleSide, depthTest: false, transparent: true, opacity: 0.85 }),
  );
  mesh.renderOrder = 4;
  mesh.rotation.z = heading;
  const name = label(text, 0.3 * length, colour);
  name.position.set(1.25 * length * Math.cos(heading), 1.25 * length * Math.sin(heading), 0);
  group.add(mesh, name);
  group.position.copy(from);
  return group;
}

/** Headings the waves travel towards, by energy: one for a sea from one side, more for crossing seas; none in calm water. */
export function waveHeadings(components) {
  const found = [];
  for (const [amplitude, , kx, ky] of components) {
    const energy = amplitude * amplitude;
    if (!(energy > 0)) continue;
    const heading = Math.atan2(ky, kx);
    const near = found.find((f) => Math.abs(Math.atan2(Math.sin(heading - f.heading), Math.cos(heading - f.heading))) < SAME_DIRECTION);
    if (!near) {
      found.push({ heading, x: energy * Math.cos(heading), y: energy * Math.sin(heading), energy });
      continue;
    }
    near.x += energy * Math.cos(heading);
    near.y += energy * Math.sin(heading);
    near.energy += energy;
    near.heading = Math.atan2(near.y, near.x);
  }
  const largest = Math.max(0, ...found.map((f) => f.energy));
  return found.filter((f) => f.energy > 0.1 * largest).map((f) => f.heading);
}

/** Arrows beside the scene, on the water: the world's x axis, true north (rad from +x) where it is known, the waves. */
export function directions(components, north, box) {
  const group = new THREE.Group();
  const size = box.getSize(new THREE.Vector3());
  const length = Math.max(6, 0.14 * Math.hypot(size.x, size.y));
  const corner = new THREE.Vector3(box.min.x - 0.3 * length, box.min.y - 0.5 * length, 0.3);
  group.add(arrow(corner, 0, length, INK, '+x'));
  if (north !== null) group.add(arrow(corner, north, length, NORTH, 'N'));
  const beside = corner.clone().add(new THREE.Vector3(2.7 * length, 0, 0)); // the middle of each wave's arrow
  for (const heading of waveHeadings(components)) {
    const half = new THREE.Vector3(Math.cos(heading), Math.sin(heading), 0).multiplyScalar(0.5 * length);
    group.add(arrow(beside.clone().sub(half), heading, length, WAVES, "waves"));
  }
  return group;
}

/**
 * A wedge on deck that points to the bow (+x of the body), for a body that floats, and the body's name above it; all
 * names are of one height, a share of the scene's `size`.
 */
export function bodyMarks({body, group}, sceneSize) {
  const box = group.children[0]?.geometry?.boundingBox;
  if (!box || !body.mesh || (!body.floats && body.kind !== "load")) return;
  const size = box.getSize(new THREE.Vector3());
  const middle = box.getCenter(new THREE.Vector3());
  if (body.floats && body.kind !== "load") {
    const b = 0.22 * size.y;
    const l = Math.min(1.2 * b, 0.2 * size.x);
    const wedge = new THREE.Shape([new THREE.Vector2(-l, -b), new THREE.Vector2(0, 0), new THREE.Vector2(-l, b)]);
    const mark = new THREE.Mesh(
      new THREE.ShapeGeometry(wedge),
      new THREE.MeshBasicMaterial({ color: BOW, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2 }),
    );
    mark.position.set(box.max.x - 0.02 * size.x, middle.y, box.max.z + 0.05);
    group.add(mark);
  }
  const name = label(body.name, 0.03 * sceneSize, INK);
  name.position.set(middle.x, middle.y, box.max.z + 0.02 * sceneSize);
  group.add(name);
}
