/* What was measured, and its pictures. */
const data = JSON.parse(document.getElementById("data").textContent);
const points = data.points || [];
const configurations = data.configurations || [];
const get = (id) => document.getElementById(id);

/* Four significant digits at most, without an exponent where people do without. */
function number(value, digits = 3) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e7)) return value.toExponential(digits - 1);
  return String(Number(value.toPrecision(digits)));
}

function bytes(value) {
  const units = ["B", "KiB", "MiB", "GiB"];
  const sign = value < 0 ? "−" : "";
  let size = Math.abs(value), unit = 0;
  for (; size >= 1024 && unit < 3; unit++) size /= 1024;
  return `${sign}${unit ? size.toFixed(size < 10 ? 2 : 1) : size} ${units[unit]}`;
}

function nameOf(configuration) {
  const options = Object.entries(configuration.options || {}).map(([key, value]) => `${key}=${value}`);
  return [configuration.technique, ...options].join(" ");
}

function pointName(point) {
  return `${nameOf(point)}, ${point.samples} sample${point.samples === 1 ? "" : "s"}`;
}

/* Distinguishable with the common kinds of colour blindness: after Okabe and Ito, "Color universal
 * design", 2008, and more like them; brighter before a dark page. */
const darkPage = matchMedia("(prefers-color-scheme: dark)");
const palettes = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6d1f", "#7a5195", "#5f6b73", "#a63a50",
    "#3f8f29", "#31688e"],
  dark: ["#4aa3df", "#ff8a4c", "#3fc79a", "#e39ac8", "#f2bd4b", "#9bd7f7", "#c7a24f", "#b58fd6", "#a3b1bb", "#e67f92",
    "#82d06e", "#6fa8d6"],
};

function colourOf(index) {
  const palette = darkPage.matches ? palettes.dark : palettes.light;
  return palette[index % palette.length];
}

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/* A picture from RGBE (G. Ward, "Real Pixels", Graphics Gems II, 1991): three mantissas and an
 * exponent of base 2 with a bias of 128. Decoded when it is first looked at. */
const decoded = new Map();
function picture(id) {
  if (decoded.has(id)) return decoded.get(id);
  const source = get(`picture-${id}`);
  let image = null;
  if (source) {
    const width = Number(source.dataset.width), height = Number(source.dataset.height);
    const packed = atob(source.textContent.trim());
    const values = new Float32Array(3 * width * height);
    for (let i = 0; i < width * height; i++) {
      const scale = 2 ** (packed.charCodeAt(4 * i + 3) - 136);
      for (let c = 0; c < 3; c++) {
        const mantissa = packed.charCodeAt(4 * i + c);
        values[3 * i + c] = mantissa ? (mantissa + 0.5) * scale : 0;
      }
    }
    image = { width, height, values };
  }
  decoded.set(id, image);
  return image;
}
