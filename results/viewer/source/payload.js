// Reads what results/replay.h wrote: base64 -> zlib -> header and blocks -> numbers.

const GAP = 65535;

async function inflate(base64) {
  const text = atob(base64);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

const unzigzag = (v) => (v >>> 1) ^ -(v & 1);

/** Running sums, `order` times, in place; Uint16Array and Uint32Array wrap around as they were written. */
function integrate(values, order) {
  for (let pass = 0; pass < order; ++pass) for (let i = 1; i < values.length; ++i) values[i] += values[i - 1];
  return values;
}

export class Payload {
  static async read(base64) {
    const bytes = await inflate(base64);
    const length = new DataView(bytes.buffer).getUint32(0, true);
    const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
    return new Payload(header, bytes.subarray(4 + length));
  }

  constructor(header, blocks) {
    this.header = header;
    this.blocks = blocks;
    this.known = new Map();
    this.time = Float64Array.from(this.integers(header.time.at, header.time.count), (ms) => header.time.start + ms / 1000);
  }

  integers(at, count) {
    const b = this.blocks;
    const values = new Uint32Array(count);
    for (let i = 0; i < count; ++i) {
      const coded =
        b[at + i] | (b[at + count + i] << 8) | (b[at + 2 * count + i] << 16) | (b[at + 3 * count + i] << 24);
      values[i] = unzigzag(coded);
    }
    return integrate(values, 2);
  }

  /** One value a time; NaN where there is none. */
  series(index) {
    if (!this.known.has(index)) this.known.set(index, this.#unpack(this.header.series[index]));
    return this.known.get(index);
  }

  #unpack({ at, low, step, order }) {
    const count = this.time.length;
    const q = new Uint16Array(count);
    for (let i = 0; i < count; ++i) q[i] = unzigzag(this.blocks[at + i] | (this.blocks[at + count + i] << 8));
    integrate(q, order);
    const values = new Float32Array(count);
    for (let i = 0; i < count; ++i) values[i] = q[i] === GAP ? NaN : low + step * q[i];
    return values;
  }

  floats(at, count) {
    return new Float32Array(this.blocks.slice(at, at + 4 * count).buffer);
  }

  /** The interval that t lies in: its first index, and how far into it t is, 0 to 1. */
  place(t) {
    const time = this.time;
    let low = 0;
    let high = time.length - 1;
    if (t <= time[0]) return { i: 0, share: 0 };
    if (t >= time[high]) return { i: high - 1, share: 1 };
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (time[middle] <= t) low = middle;
      else high = middle;
    }
    return { i: low, share: (t - time[low]) / (time[low + 1] - time[low]) };
  }

  /** A series between its samples. */
  value(index, { i, share }) {
    const s = this.series(index);
    return s[i] + share * (s[i + 1] - s[i]);
  }
}
