// Blocks of the page as numbers: base64, deflate, and predictions undone.

const inflatedBlocks = new Map();

/** Bytes of a block, once. */
function block(number) {
  if (!inflatedBlocks.has(number)) inflatedBlocks.set(number, inflated(number));
  return inflatedBlocks.get(number);
}

async function inflated(number) {
  const text = byId(`block-${number}`).textContent;
  const letters = atob(text);
  const bytes = new Uint8Array(letters.length);
  for (let at = 0; at < letters.length; at++) bytes[at] = letters.charCodeAt(at);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Whole numbers, each stored as the difference to the one so many places before. */
async function indices(number, stride) {
  const bytes = await block(number);
  const count = bytes.length / 4;
  const out = new Uint32Array(count);
  for (let at = 0; at < count; at++) {
    const folded = bytes[at] | (bytes[count + at] << 8) | (bytes[2 * count + at] << 16) | (bytes[3 * count + at] << 24);
    const difference = (folded >>> 1) ^ -(folded & 1);
    out[at] = (at >= stride ? out[at - stride] : 0) + difference;
  }
  return out;
}

async function reals(number) {
  return new Float32Array((await block(number)).buffer);
}

/** Codes of a field: one Uint16Array a time with the components one after the other, or null. */
async function codes(field) {
  field.codes ??= unpredicted(field);
  return field.codes;
}

async function unpredicted(field) {
  const bytes = await block(field.block);
  const count = bytes.length / 2;
  const known = field.scales.filter((scale) => scale !== null).length;
  const rows = known * field.components;
  const length = rows ? count / rows : 0;
  const all = new Uint16Array(count);
  for (let row = 0; row < rows; row++) {
    const start = row * length;
    const before = start - field.components * length;
    const how = field.predictions[row];
    for (let at = start; at < start + length; at++) {
      const folded = bytes[at] | (bytes[count + at] << 8);
      const difference = (folded >>> 1) ^ -(folded & 1);
      const left = at > start ? all[at - 1] : 0;
      const earlier = how === "s" ? 0 : all[before + at - start];
      const corner = how === "b" && at > start ? all[before + at - start - 1] : 0;
      all[at] = (how === "s" ? left : how === "t" ? earlier : earlier + left - corner) + difference;
    }
  }
  inflatedBlocks.delete(field.block);
  let next = 0;
  const step = field.components * length;
  return field.scales.map((scale) => (scale === null ? null : all.subarray(next, (next += step))));
}

/** Components of a field at a time, one array each; null where it is not known. */
async function components(field, time) {
  const moment = (await codes(field))[time];
  if (!moment) return null;
  const [least, step] = field.scales[time];
  const length = moment.length / field.components;
  return Array.from({ length: field.components }, (_, component) => {
    const out = new Float32Array(length);
    for (let at = 0; at < length; at++) {
      const code = moment[component * length + at];
      out[at] = code === 65535 ? NaN : least + step * code;
    }
    return out;
  });
}

/** A view of a field (magnitude, von Mises, xy, ...) at a time. */
async function viewed(field, view, time) {
  const parts = await components(field, time);
  if (!parts) return null;
  const place = field.order.indexOf(view);
  const length = parts[0].length;
  const out = new Float32Array(length);
  const point = new Float64Array(field.components);
  for (let at = 0; at < length; at++) {
    for (let c = 0; c < field.components; c++) point[c] = parts[c][at];
    out[at] = shown(point, place);
  }
  return out;
}

/** As in the program: see invariants.rs there. */
function shown(s, place) {
  const count = s.length;
  if (count === 1) return s[0];
  if (count !== 6) return place > 0 ? s[place - 1] : Math.hypot(...s);
  if (place >= 5) return s[place - 5];
  const mean = (s[0] + s[1] + s[2]) / 3;
  const [a, b, c] = [s[0] - mean, s[1] - mean, s[2] - mean];
  const j = 0.5 * (a * a + b * b + c * c) + s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
  if (place === 0) return Math.sqrt(3 * j);
  if (place === 4) return mean;
  const det = a * (b * c - s[4] * s[4]) - s[3] * (s[3] * c - s[4] * s[5]) + s[5] * (s[3] * s[4] - b * s[5]);
  const radius = Math.sqrt(j / 3);
  const cosine = radius > 0 ? Math.min(1, Math.max(-1, (0.5 * det) / radius ** 3)) : 0;
  const angle = Math.acos(cosine) / 3 + [0, -1, 1][place - 1] * ((2 * Math.PI) / 3);
  return mean + 2 * radius * Math.cos(angle);
}
