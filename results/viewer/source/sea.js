// The sea surface: the components that the simulation used, summed on the grid's vertices by the graphics card.
//   zeta(x, y, t) = r(t) sum a cos(kx x + ky y - w t + e),   r(t) = s^3 (10 - 15 s + 6 s^2), s = t / ramp

import * as THREE from "three";

const REACH = 1600; // m, from the middle to the edge
const NEAR = 260; // m, half the width of the part with fine cells

/** r(t), as sim/sea/wave_field.cpp has it. */
export function ramp(t, duration) {
  if (!(duration > 0) || t >= duration) return 1;
  if (t <= 0) return 0;
  const s = t / duration;
  return s * s * s * (10 - 15 * s + 6 * s * s);
}

/** Elevation at a point, for what the graphics card need not be asked. */
export function elevation(sea, x, y, t) {
  let sum = 0;
  for (const [a, w, kx, ky, e] of sea.components) sum += a * Math.cos(kx * x + ky * y - w * t + e);
  return ramp(t, sea.ramp) * sum;
}

const VERTEX = /* glsl */ `
  uniform highp sampler2D waves;
  uniform int count;
  uniform float rampNow;
  uniform vec2 middle;
  varying vec3 place;
  varying vec3 slope;
  void main() {
    vec2 p = position.xy + middle;
    float zeta = 0.0;
    vec2 gradient = vec2(0.0);
    for (int j = 0; j < count; ++j) {
      vec4 wave = texelFetch(waves, ivec2(j, 0), 0); // amplitude, kx, ky, phase with the time in it
      float theta = dot(wave.yz, p) + wave.w;
      zeta += wave.x * cos(theta);
      gradient -= wave.x * sin(theta) * wave.yz;
    }
    // The far cells are longer than the waves: let them lie flat.
    float fade = 1.0 - smoothstep(${NEAR.toFixed(1)}, ${(2.2 * NEAR).toFixed(1)}, length(position.xy));
    place = vec3(p, zeta * rampNow * fade);
    slope = vec3(gradient * rampNow * fade, fade);
    gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  }`;

const FRAGMENT = /* glsl */ `
  uniform vec3 deep, light, sky;
  varying vec3 place;
  varying vec3 slope;
  void main() {
    vec3 n = normalize(vec3(-2.2 * slope.xy, 1.0)); // steeper than they are, to be seen
    vec3 view = normalize(cameraPosition - place);
    if (view.z < 0.0) n = -n;
    float glance = pow(1.0 - clamp(dot(n, view), 0.0, 1.0), 4.0);
    float sun = 0.5 + 0.5 * dot(n, normalize(vec3(-0.5, -0.35, 0.6)));
    vec3 water = mix(deep, light, clamp(1.6 * (sun - 0.55), 0.0, 1.0));
    float far = smoothstep(500.0, ${REACH.toFixed(1)}, length(cameraPosition.xy - place.xy));
    gl_FragColor = vec4(mix(mix(water, sky, 0.55 * glance), sky, far), mix(view.z < 0.0 ? 0.35 : 0.84, 1.0, far));
    #include <colorspace_fragment>
  }`;

/** Fine cells in the middle, long ones towards the horizon. */
function grid(cells) {
  const geometry = new THREE.PlaneGeometry(2, 2, cells, cells);
  const position = geometry.attributes.position;
  const stretch = (u) => u * (NEAR * 0.9 + (REACH - NEAR * 0.9) * Math.pow(Math.abs(u), 5));
  for (let i = 0; i < position.count; ++i) position.setXYZ(i, stretch(position.getX(i)), stretch(position.getY(i)), 0);
  return geometry;
}

export class Sea {
  /** `cells`: along each side of the grid. */
  constructor(sea, middle, sky, cells) {
    this.sea = sea;
    const count = Math.max(1, sea.components.length);
    this.values = new Float32Array(4 * count);
    this.texture = new THREE.DataTexture(this.values, count, 1, THREE.RGBAFormat, THREE.FloatType);
    this.uniforms = {
      waves: { value: this.texture },
      count: { value: sea.components.length },
      rampNow: { value: 0 },
      middle: { value: new THREE.Vector2(middle.x, middle.y) },
      deep: { value: new THREE.Color("#1f5064") },
      light: { value: new THREE.Color("#7fa9b6") },
      sky: { value: new THREE.Color(sky) },
    };
    this.mesh = new THREE.Mesh(
      grid(cells),
      new THREE.ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: this.uniforms,
        transparent: true,
        side: THREE.DoubleSide,
      }),
    );
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 2;
  }

  update(t) {
    this.sea.components.forEach(([a, w, kx, ky, e], j) => {
      // The phase is taken modulo a turn here, in double precision: after an hour single precision would be lost.
      this.values.set([a, kx, ky, (e - w * t) % (2 * Math.PI)], 4 * j);
    });
    this.texture.needsUpdate = true;
    this.uniforms.rampNow.value = ramp(t, this.sea.ramp);
  }
}
