/* What the plots and bars show of the data. */
const identity = (estimate) => estimate || {};
const metrics = [
  { key: "relmse", label: "relMSE", of: (point) => identity(point.relmse) },
  { key: "rmse", label: "RMSE", of: (point) => identity(point.rmse) },
  { key: "flip", label: "FLIP", of: (point) => identity(point.flip) },
  { key: "flip_hdr", label: "HDR-FLIP", of: (point) => identity(point.flip_hdr) },
  { key: "ssim", label: "1 − SSIM", of: (point) => lessThanOne(identity(point.ssim)) },
];

/* An interval of what is missing to 1 runs the other way round. */
function lessThanOne({ value, low, high }) {
  const rest = (x) => (x === null || x === undefined ? null : 1 - x);
  return { value: rest(value), low: rest(high), high: rest(low) };
}

const medianTime = (point) => (point.milliseconds || {}).median;
const timeLabel = data.clock === "processor" ? "milliseconds of processor time a frame" : "milliseconds a frame";

function interval(estimate) {
  const known = estimate.low !== null && estimate.low !== undefined;
  return known ? `${number(estimate.value)} (${number(estimate.low)} to ${number(estimate.high)})` : number(estimate.value);
}

function tipOf(point, metric) {
  return [
    pointName(point),
    `${metric.label} ${interval(metric.of(point))}`,
    `${number(medianTime(point))} ms a frame`,
    `SSIM ${number((point.ssim || {}).value, 4)}, FLIP ${number((point.flip || {}).value)}`,
    ...(point.gl_bytes ? [bytes(point.gl_bytes.peak)] : []),
    ...(point.front ? ["on the Pareto front"] : []),
  ];
}

/* A mark for each point of a configuration. */
function marksOf(index, metric, x) {
  return points.filter((point) => point.configuration === index).map((point) => {
    const { value, low, high } = metric.of(point);
    const time = point.milliseconds || {};
    const spread = x === medianTime ? { xLow: time.lower_quartile, xHigh: time.upper_quartile } : {};
    return { x: x(point), y: value, low, high, ...spread, point, tip: tipOf(point, metric) };
  });
}

const hiddenConfigurations = new Set();

function seriesOf(metric, x, more = () => ({})) {
  return configurations.map((configuration, index) => ({
    name: nameOf(configuration), color: colourOf(index), marks: marksOf(index, metric, x), ...more(configuration, index),
  })).filter((series, index) => !hiddenConfigurations.has(index));
}

function errorFigure(metric) {
  return { label: `${metric.label} against milliseconds a frame`, x: timeLabel, y: metric.label,
    series: seriesOf(metric, medianTime), front: metric.key === "relmse" };
}

function convergenceFigure() {
  const metric = metrics[0];
  return { label: "relMSE against samples", x: "samples", y: "relMSE",
    series: seriesOf(metric, (point) => point.samples, (configuration, index) => {
      const fit = (configuration.fit || {}).relmse || {};
      const floor = (fit.floor || {}).value, noise = (fit.noise || {}).value, exponent = (fit.exponent || {}).value;
      const samples = points.filter((point) => point.configuration === index).map((point) => point.samples);
      /* Noise that grows is none: too few seeds, or a default that changed on the way. */
      if (!samples.length || [floor, noise, exponent].some((value) => !Number.isFinite(value)) || exponent <= 0) return {};
      const least = Math.min(...samples), most = Math.max(...samples);
      const curve = Array.from({ length: 41 }, (unused, i) => {
        const x = least * (most / least) ** (i / 40);
        return { x, y: floor + noise * x ** -exponent };
      });
      return { floor, curve: most > least ? curve : undefined };
    }) };
}

/* --- where the time goes --- */

/* The point of each configuration with the most samples, where its passes were timed. */
function timedPoints() {
  return configurations.map((unused, index) => points
    .filter((point) => point.configuration === index && point.passes && point.passes.length)
    .reduce((most, point) => (most && most.samples >= point.samples ? most : point), null)).filter(Boolean);
}

function passBars(container, readOut) {
  const timed = timedPoints();
  const took = (point, pass) => point.samples * pass.milliseconds; /* which is a mean per iteration */
  const sum = (point) => point.passes.reduce((total, pass) => total + took(point, pass), 0);
  const longest = Math.max(...timed.map(sum), 0);
  const names = [...new Set(timed.flatMap((point) => point.passes.map((pass) => pass.name)))];
  for (const point of timed) {
    const bar = element("div", { class: "bar", role: "list" });
    bar.style.width = `${100 * sum(point) / longest}%`;
    for (const pass of point.passes) {
      const share = 100 * took(point, pass) / sum(point);
      const said = `${pass.name}: ${number(took(point, pass))} ms, ${number(share, 2)} %`;
      const part = element("span", { role: "listitem", title: said, "aria-label": said });
      part.style.flexGrow = String(pass.milliseconds);
      part.style.background = colourOf(names.indexOf(pass.name));
      part.addEventListener("mouseenter", () => readOut(said));
      bar.append(part);
    }
    container.append(element("div", { class: "bar-row" },
      element("div", { class: "bar-label" }, element("span", {}, pointName(point)),
        element("span", {}, `${number(sum(point))} ms`)), bar));
  }
  /* Colours of those that some frame spends a fortieth of its time on. */
  const large = names.filter((name) => timed.some((point) => point.passes.some((pass) =>
    pass.name === name && took(point, pass) > sum(point) / 40)));
  container.append(element("p", { class: "keys" }, ...large.map((name) => {
    const swatch = element("span", { class: "swatch" });
    swatch.style.background = colourOf(names.indexOf(name));
    return element("span", {}, swatch, name);
  })));
  return timed.length > 0;
}
