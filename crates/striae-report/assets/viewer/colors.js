// Colour maps: viridis for what has one sign, blue to red about zero for what has two, and
// from grey to dark red for what contact transmits, so that nothing looks like nothing.

const VIRIDIS = ["#440154", "#482878", "#3e4a89", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6dcd59", "#b4de2c", "#fde725"];
const HEAT = ["#dde2e6", "#f3dfab", "#f5b86d", "#e8824d", "#cb4e3b", "#96243a", "#5a0f35"];
const BLUE_RED = ["#2a4ea0", "#5c86c9", "#9dbce0", "#d6e2ee", "#f4f2ee", "#f3d5c3", "#e39f83", "#c9604f", "#9c1c2b"];
const STATUS = [
  { code: 0, name: "open", color: "#b9c2c9" },
  { code: 1, name: "stick", color: "#2f7fb8" },
  { code: 2, name: "slip", color: "#e0803a" },
];
const UNKNOWN = "#aeb6bd";
const BANDS = 10;

function channels(color) {
  return [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16));
}

function mixed(stops, share) {
  const place = Math.min(Math.max(share, 0), 1) * (stops.length - 1);
  const at = Math.min(Math.floor(place), stops.length - 2);
  const [low, high] = [channels(stops[at]), channels(stops[at + 1])];
  return low.map((value, channel) => Math.round(value + (high[channel] - value) * (place - at)));
}

/** Stops and limits for values from low to high. */
function palette(name, low, high, kind) {
  if (name === "status") return { stops: STATUS.map((s) => s.color), low: -0.5, high: 2.5, bands: 3 };
  if (low < 0 && high > 0 && Math.min(-low, high) > 0.05 * Math.max(-low, high)) {
    const reach = Math.max(-low, high);
    return { stops: BLUE_RED, low: -reach, high: reach };
  }
  const transmitted = kind === "contact" && low >= 0 && name !== "gap";
  return { stops: transmitted ? HEAT : VIRIDIS, low, high };
}

/** Colours from low to high, 256 of them or one a band, for the texture and the legend. */
function colorSteps(colors, bands) {
  const count = bands || 256;
  const share = (at) => (bands ? at / Math.max(1, bands - 1) : at / 255);
  return Array.from({ length: count }, (_, at) => mixed(colors.stops, share(at)));
}

/** The colours as a texture of two rows, the second for what is not known. */
function colorTexture(colors, bands) {
  const row = colorSteps(colors, bands);
  const none = channels(UNKNOWN);
  const bytes = new Uint8Array(row.length * 8);
  row.forEach((color, at) => bytes.set([...color, 255], 4 * at));
  row.forEach((_, at) => bytes.set([...none, 255], 4 * (row.length + at)));
  const texture = new THREE.DataTexture(bytes, row.length, 2, THREE.RGBAFormat, THREE.UnsignedByteType);
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.minFilter = texture.magFilter = THREE.NearestFilter;
  texture.needsUpdate = true;
  return texture;
}

/** The same as a CSS gradient, upwards. */
function gradient(colors, bands) {
  const row = colorSteps(colors, bands);
  const css = (color) => `rgb(${color.join(" ")})`;
  const stop = (color, at) => {
    if (!bands) return `${css(color)} ${(100 * at) / (row.length - 1)}%`;
    return `${css(color)} ${(100 * at) / bands}% ${(100 * (at + 1)) / bands}%`;
  };
  return `linear-gradient(to top, ${row.map(stop).join(", ")})`;
}
