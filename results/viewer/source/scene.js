// The replay's picture: what stands in the scene and where it is looked at from. Frames as in the program: z up, metres.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Body, meshGeometry } from "./bodies.js";
import { Arrows, Moorings, Wires } from "./lines.js";
import { bodyMarks, directions } from "./marks.js";
import { Sea } from "./sea.js";

const SKY = "#e6edf2";
const DEEPEST = -30; // m, what lies deeper need not be in the first view
const ROOM = 1.08; // 1: the outermost corner touches the edge
const LEG_DEPTH = 40; // m, how far down a support's legs are drawn

export const VIEWS = [
  { name: "Overview", direction: [0.62, -0.72, 0.34] },
  { name: "Side", direction: [0, -1, 0.03] },
  { name: "Ahead", direction: [1, 0, 0.05] },
  { name: "Plan", direction: [0, -0.001, 1] },
];

/** Something to be set down on: a slab under the rectangle, on legs where it stands in the world above the sea. */
function support(surface) {
  const group = new THREE.Group();
  const material = new THREE.MeshStandardMaterial({ color: surface.role === "target" ? "#5d7a63" : "#6b6257", roughness: 0.9 });
  const thickness = surface.body < 0 ? 1.2 : 0.5;
  const slab = new THREE.Mesh(new THREE.BoxGeometry(surface.length, surface.breadth, thickness), material);
  slab.position.z = -thickness / 2;
  group.add(slab);
  if (surface.body < 0 && surface.centre[2] > 0)
    for (const sx of [-0.4, 0.4])
      for (const sy of [-0.42, 0, 0.42]) {
        const height = surface.centre[2] + LEG_DEPTH;
        const leg = new THREE.Mesh(new THREE.CylinderGeometry(0.9, 0.9, height, 12), material);
        leg.rotation.x = Math.PI / 2;
        leg.position.set(sx * surface.length, sy * surface.breadth, -height / 2);
        group.add(leg);
      }
  group.position.set(...surface.centre);
  return group;
}

/** Without a graphics card the scene is drawn coarser, to stay fluent. */
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

export class ReplayScene {
  constructor(canvas, payload) {
    this.payload = payload;
    this.data = payload.header.scene;
    this.contacts = payload.header.contacts.filter((c) => c.kind !== 'at rest at the start');
    const coarse = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !coarse, preserveDrawingBuffer: true });
    this.renderer.setClearColor(SKY);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#6f8794", 1.9));
    const sun = new THREE.DirectionalLight("#fff6e6", 2.0);
    sun.position.set(-0.5, -0.7, 1);
    this.scene.add(sun);

    this.bodies = this.data.bodies.map((body) => new Body(payload, body));
    for (const body of this.bodies) this.scene.add(body.group);
    for (const surface of this.data.surfaces)
      (surface.body < 0 ? this.scene : this.bodies[surface.body].group).add(support(surface));
    this.wires = new Wires(this.data.lines);
    this.moorings = new Moorings(this.data.moorings);
    this.scene.add(this.wires.mesh, this.moorings.mesh);

    const start = payload.place(payload.time[0]);
    for (const body of this.bodies) body.update(payload, start);
    this.corners = this.#corners();
    const box = new THREE.Box3().setFromPoints(this.corners);
    this.middle = box.getCenter(new THREE.Vector3());
    this.size = box.getSize(new THREE.Vector3()).length();
    this.sea = new Sea(this.data.sea, this.middle, SKY, coarse ? 72 : 144);
    this.scene.add(this.sea.mesh);
    this.arrows = new Arrows(this.data.arrows ?? [], 0.16 * this.size);
    this.scene.add(this.arrows.group);
    this.scene.add(directions(this.data.sea.components, this.data.north, box));
    for (const body of this.bodies) bodyMarks(body, this.size);
    this.load = this.bodies.find(({ body }) => body.kind === "load") ?? this.bodies[0];
    this.#addTarget();
    this.#addFlash();

    this.camera = new THREE.PerspectiveCamera(32, 1, 1, 6000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableZoom = false; // the wheel scrolls the page until the scene has the focus
    this.controls.addEventListener("change", () => (this.dirty = true));
    this.followed = null;
    this.view(0);
  }

  /** Corners of the hulls, ends of members and wires at the start: what the views fit in; not the far moorings. */
  #corners() {
    const points = [new THREE.Vector3(...this.data.target)];
    const corner = new THREE.Vector3();
    this.bodies.forEach(({ body, group }, i) => {
      for (const { from, to } of body.members)
        for (const end of [from, to]) points.push(new THREE.Vector3(...end).applyMatrix4(group.matrixWorld));
      for (const line of this.data.lines)
        for (const [index, point] of [[line.from, line.point_from], [line.to, line.point_to]])
          if (index === i) points.push(new THREE.Vector3(...point).applyMatrix4(group.matrixWorld));
          else if (index < 0) points.push(new THREE.Vector3(...point));
      const box = group.children[0]?.geometry?.boundingBox;
      if (!box || !body.mesh) return;
      for (let k = 0; k < 8; ++k)
        points.push(corner.set(k & 1 ? box.min.x : box.max.x, k & 2 ? box.min.y : box.max.y, k & 4 ? box.min.z : box.max.z)
          .clone().applyMatrix4(group.matrixWorld));
    });
    return points.filter((p) => p.z > DEEPEST);
  }

  /** Where the load shall stand: its outline, and a cross. */
  #addTarget() {
    const target = new THREE.Vector3(...this.data.target);
    const material = new THREE.LineBasicMaterial({ color: "#00603a" });
    const arm = 0.025 * this.size;
    const cross = [[arm, 0, 0], [0, arm, 0], [0, 0, arm]].flatMap((v) => [
      target.clone().sub(new THREE.Vector3(...v)),
      target.clone().add(new THREE.Vector3(...v)),
    ]);
    this.scene.add(new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(cross), material));
    const mesh = this.load?.body.mesh;
    if (!mesh) return;
    const outline = new THREE.LineSegments(
      new THREE.EdgesGeometry(meshGeometry(this.payload, mesh), 25),
      new THREE.LineDashedMaterial({ color: "#00603a", dashSize: 1.2, gapSize: 0.8 }),
    );
    outline.computeLineDistances();
    outline.position.copy(target).sub(new THREE.Vector3(...this.data.load_reference));
    this.scene.add(outline);
  }

  /** The contact that is shown at t: one that begins within a second; what rests at the start is none. */
  touching(t) {
    return this.contacts.find((c) => Math.abs(t - c.time) < 1);
  }

  /** What shows a contact for a moment. */
  #addFlash() {
    this.flash = new THREE.Mesh(
      new THREE.RingGeometry(2.6, 3.6, 32),
      new THREE.MeshBasicMaterial({ color: "#c4001d", depthTest: false, transparent: true, side: THREE.DoubleSide }),
    );
    this.flash.renderOrder = 5;
    this.flash.visible = false;
    this.scene.add(this.flash);
  }

  /** Looks from one of VIEWS, everything in sight. */
  view(index) {
    const direction = new THREE.Vector3(...VIEWS[index].direction).normalize();
    const tan = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const look = this.middle.clone();
    let distance = this.size;
    // Each pass centres what it sees and comes as close as it can; the second pass corrects the perspective of the first.
    for (let pass = 0; pass < 3; ++pass) {
      this.camera.position.copy(look).addScaledVector(direction, distance);
      this.camera.lookAt(look);
      this.camera.updateMatrixWorld();
      const toCamera = this.camera.matrixWorld.clone().invert();
      const seen = new THREE.Box2();
      const points = this.corners.map((corner) => corner.clone().applyMatrix4(toCamera));
      for (const p of points) seen.expandByPoint(new THREE.Vector2(p.x / -p.z, p.y / -p.z));
      const centre = seen.getCenter(new THREE.Vector2()).multiplyScalar(distance);
      look.add(new THREE.Vector3(centre.x, centre.y, 0).applyQuaternion(this.camera.quaternion));
      const needed = points.map(({ x, y, z }) =>
        ROOM * Math.max(Math.abs(x - centre.x) / (tan * this.camera.aspect), Math.abs(y - centre.y) / tan) + z + distance);
      distance = Math.max(10, ...needed);
    }
    this.controls.target.copy(look);
    this.camera.position.copy(look).addScaledVector(direction, distance);
    this.current = index;
    this.followed = this.followed && this.#loadPlace();
    this.controls.update();
    this.dirty = true;
  }

  #loadPlace() {
    return this.load.group.position.clone();
  }

  /** Keeps the camera's place relative to the load. */
  follow(on) {
    this.followed = on ? this.#loadPlace() : null;
    if (on) {
      const shift = this.#loadPlace().sub(this.controls.target);
      this.controls.target.add(shift);
      this.camera.position.add(shift);
      const away = this.camera.position.clone().sub(this.controls.target);
      if (away.length() > 190) this.camera.position.copy(this.controls.target).add(away.setLength(190));
    }
    this.controls.update();
    this.dirty = true;
  }

  /** Turns the camera about what it looks at, rad. */
  turn(azimuth, height) {
    const away = this.camera.position.clone().sub(this.controls.target);
    away.applyAxisAngle(new THREE.Vector3(0, 0, 1), azimuth);
    const side = new THREE.Vector3().crossVectors(away, this.camera.up).normalize();
    const tilted = away.clone().applyAxisAngle(side, height);
    if (Math.abs(tilted.z) < 0.98 * tilted.length()) away.copy(tilted);
    this.camera.position.copy(this.controls.target).add(away);
    this.controls.update();
    this.dirty = true;
  }

  zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.dirty = true;
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    this.renderer.setSize(width, height, false);
    const fresh = this.camera.aspect === 1;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (fresh) this.view(this.current);
    this.dirty = true;
  }

  update(t) {
    const place = this.payload.place(t);
    for (const body of this.bodies) body.update(this.payload, place);
    this.wires.update(this.payload, place, t, this.bodies);
    this.moorings.update(this.payload, place, this.bodies);
    this.arrows.update(this.payload, place, this.bodies);
    this.sea.update(t);
    const contact = this.touching(t);
    this.flash.visible = contact !== undefined;
    if (contact) this.flash.position.set(...contact.place);
    if (this.followed) {
      const now = this.#loadPlace();
      const shift = now.clone().sub(this.followed);
      this.camera.position.add(shift);
      this.controls.target.add(shift);
      this.followed = now;
      this.controls.update();
    }
    this.dirty = true;
  }

  draw() {
    if (!this.dirty) return;
    this.dirty = false;
    this.flash.lookAt(this.camera.position);
    this.renderer.render(this.scene, this.camera);
  }
}
