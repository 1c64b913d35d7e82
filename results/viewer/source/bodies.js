// Hulls, load, booms: from the meshes and members of the case.

import * as THREE from "three";

const COLOURS = { crane: "#56687a", vessel: "#8a7d6b", load: "#c2552d", member: "#c9a13a" };
const BELOW_WATER = "#7d3b34";
const EDGE_ANGLE = 25; // deg between faces that show as an edge

/** Topsides in one colour, the part below the mean waterline (height in B, m) in another. */
function hullMaterial(colour, waterline) {
  const material = new THREE.MeshStandardMaterial({ color: colour, roughness: 0.85, flatShading: true });
  material.onBeforeCompile = (shader) => {
    shader.uniforms.waterline = { value: waterline };
    shader.uniforms.below = { value: new THREE.Color(BELOW_WATER) };
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying float heightInB;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nheightInB = position.z;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float heightInB;\nuniform float waterline;\nuniform vec3 below;")
      .replace("#include <color_fragment>", "#include <color_fragment>\nif (heightInB < waterline) diffuseColor.rgb = below;");
  };
  return material;
}

export function meshGeometry(payload, mesh) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(payload.floats(mesh.vertices, 3 * mesh.vertex_count), 3));
  geometry.setIndex(new THREE.BufferAttribute(payload.integers(mesh.corners, mesh.corner_count), 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingBox();
  return geometry;
}

function meshBody(payload, body, waterline) {
  const geometry = meshGeometry(payload, body.mesh);
  const colour = COLOURS[body.kind];
  const material = body.floats && body.kind !== "load"
    ? hullMaterial(colour, waterline)
    : new THREE.MeshStandardMaterial({ color: colour, roughness: 0.8, flatShading: true });
  const edges = new THREE.LineSegments(
    new THREE.EdgesGeometry(geometry, EDGE_ANGLE),
    new THREE.LineBasicMaterial({ color: "#1c2329", transparent: true, opacity: 0.55 }),
  );
  return [new THREE.Mesh(geometry, material), edges];
}

/** The struts of a lattice along an axis: [from, to, radius], four chords that taper to the ends, and their bracing. */
function lattice({ from, to, radius }) {
  const a = new THREE.Vector3(...from);
  const axis = new THREE.Vector3(...to).sub(a);
  const length = axis.length();
  axis.normalize();
  const across = new THREE.Vector3(0, 1, 0);
  if (Math.abs(axis.y) > 0.9) across.set(1, 0, 0);
  const up = new THREE.Vector3().crossVectors(axis, across).normalize();
  across.crossVectors(up, axis);
  const bays = Math.min(40, Math.max(4, Math.round(length / (2 * radius))));
  const half = (share) => radius * 0.707 * Math.min(1, 0.18 + share / 0.14, 0.18 + (1 - share) / 0.14);
  const corner = (bay, k) => {
    const share = bay / bays;
    const [s, u] = [[1, 1], [-1, 1], [-1, -1], [1, -1]][k % 4];
    const h = half(share);
    return a.clone().addScaledVector(axis, share * length).addScaledVector(across, s * h).addScaledVector(up, u * h);
  };
  const chord = Math.max(0.12, 0.09 * radius);
  const struts = [];
  for (let bay = 0; bay < bays; ++bay)
    for (let k = 0; k < 4; ++k) {
      struts.push([corner(bay, k), corner(bay + 1, k), chord]);
      struts.push([corner(bay + (bay % 2), k), corner(bay + 1 - (bay % 2), k + 1), 0.55 * chord]);
      if (bay === 0 || bay === bays - 1) struts.push([corner(bay === 0 ? 0 : bays, k), corner(bay === 0 ? 0 : bays, k + 1), chord]);
    }
  return struts;
}

function memberBody(body) {
  const struts = body.members.flatMap(lattice);
  const bars = new THREE.InstancedMesh(
    new THREE.CylinderGeometry(1, 1, 1, 6, 1),
    new THREE.MeshStandardMaterial({ color: COLOURS[body.kind], roughness: 0.7 }),
    struts.length,
  );
  const up = new THREE.Vector3(0, 1, 0);
  struts.forEach(([from, to, radius], i) => {
    const along = to.clone().sub(from);
    const length = along.length();
    const turn = new THREE.Quaternion().setFromUnitVectors(up, along.normalize());
    const middle = from.clone().addScaledVector(along, length / 2);
    bars.setMatrixAt(i, new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(radius, length, radius)));
  });
  bars.frustumCulled = false;
  return [bars];
}

/** An upright column under each hinge that stands clear of the deck. */
function pedestals(body) {
  return body.pedestals.map(({from, to, radius}) => {
    const height = to[2] - from[2];
    const column = new THREE.Mesh(
        new THREE.CylinderGeometry(radius, radius, height, 24),
        new THREE.MeshStandardMaterial({color: COLOURS[body.kind], roughness: 0.85}),
    );
    column.rotation.x = Math.PI / 2;
    column.position.set(from[0], from[1], from[2] + height / 2);
    return column;
  });
}

/** A body's group; update() moves it. */
export class Body {
  constructor(payload, body) {
    this.body = body;
    this.group = new THREE.Group();
    if (body.pose.length) {
      const waterline = -payload.series(body.pose[2])[0];
      if (body.mesh) this.group.add(...meshBody(payload, body, waterline));
      if (body.envelope)
        this.group.add(new THREE.LineSegments(new THREE.EdgesGeometry(meshGeometry(payload, body.envelope), EDGE_ANGLE),
          new THREE.LineBasicMaterial({ color: COLOURS[body.kind] })));
      if (body.members.length) this.group.add(...memberBody(body));
      for (const pedestal of pedestals(body)) this.group.add(pedestal); // add() of nothing is an error to three.js
    }
  }

  update(payload, place) {
    const pose = this.body.pose;
    if (!pose.length) return;
    const value = (k) => payload.value(pose[k], place);
    this.group.position.set(value(0), value(1), value(2));
    this.group.quaternion.set(value(4), value(5), value(6), value(3)).normalize();
    this.group.updateMatrixWorld();
  }
}
