// The replay's picture: what stands in the scene and where it is looked at from. Frames as in the program: z up, metres.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { Body, meshGeometry } from "./bodies.js";
import { Moorings, Wires } from "./lines.js";
import { Sea } from "./sea.js";

const SKY = "#e6edf2";
const LEG_DEPTH = 40; // m, how far down a support's legs are drawn

/** `room`: 1 = the corners of the box around everything just touch the edge. */
export const VIEWS = [
  { name: "Overview", direction: [0.62, -0.72, 0.34], room: 0.86 },
  { name: "Side", direction: [0, -1, 0.03], room: 1.06 },
  { name: "Ahead", direction: [1, 0, 0.05], room: 1.06 },
  { name: "Plan", direction: [0, -0.001, 1], room: 1.06 },
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
    this.box = this.#extent();
    this.middle = this.box.getCenter(new THREE.Vector3());
    this.sea = new Sea(this.data.sea, this.middle, SKY, coarse ? 72 : 144);
    this.scene.add(this.sea.mesh);
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

  /** Around the hulls, members and wires' ends at the start; not the moorings, which lie far out. */
  #extent() {
    const box = new THREE.Box3();
    for (const { group } of this.bodies) box.expandByObject(group);
    box.expandByPoint(new THREE.Vector3(...this.data.target));
    return box;
  }

  /** Where the load shall stand: its outline, and a cross. */
  #addTarget() {
    const target = new THREE.Vector3(...this.data.target);
    const material = new THREE.LineBasicMaterial({ color: "#00603a" });
    const arm = 6;
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
    this.controls.target.copy(this.middle);
    // The camera's axes, to see how far the corners of the box lie to the side and above.
    this.camera.position.copy(this.middle).add(direction);
    this.camera.lookAt(this.middle);
    this.camera.updateMatrixWorld();
    const back = this.camera.matrixWorldInverse.copy(this.camera.matrixWorld).invert();
    const tan = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const room = this.camera.aspect < 1.6 ? 1.02 : VIEWS[index].room;
    let distance = 10;
    for (const x of [this.box.min.x, this.box.max.x])
      for (const y of [this.box.min.y, this.box.max.y])
        for (const z of [Math.max(this.box.min.z, -30), this.box.max.z]) {
          const p = new THREE.Vector3(x, y, z).applyMatrix4(back);
          const needed = Math.max(Math.abs(p.x) / (tan * this.camera.aspect), Math.abs(p.y) / tan) + p.z + 1;
          distance = Math.max(distance, room * needed);
        }
    this.camera.position.copy(this.middle).addScaledVector(direction, distance);
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
    this.sea.update(t);
    const contact = this.payload.header.contacts.find((c) => Math.abs(t - c.time) < 1);
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
