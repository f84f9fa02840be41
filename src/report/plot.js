/* A plot with logarithmic axes, points that can be hovered, reached by keys and chosen. */

/* 1, 2, 5 and their like by powers of ten, thinned to what a label's width allows. */
function logTicks(low, high) {
  const decades = Math.log10(high / low);
  const steps = decades > 3 ? [1] : decades > 1.2 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 8];
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); power++)
    for (const step of steps) {
      const tick = step * 10 ** power;
      if (tick >= low && tick <= high) ticks.push(Number(tick.toPrecision(6)));
    }
  return ticks;
}

function logRange(values) {
  const positive = values.filter((value) => value > 0 && Number.isFinite(value));
  if (!positive.length) return [0.1, 10];
  const low = Math.min(...positive), high = Math.max(...positive);
  const margin = Math.max(0.06 * Math.log10(high / low), 0.08);
  return [low / 10 ** margin, high * 10 ** margin];
}

/* Keeps an interval's end within the picture, where it may be 0 or less. */
const clampTo = (value, low, high) => Math.min(Math.max(value, low), high);

class Plot {
  /* `what`: { label, x, y, series: [{ name, color, marks, curve, floor }], front }; a mark is { x, y,
   * low, high, xLow, xHigh, point, tip }. */
  constructor(container, what, choose) {
    this.container = container;
    this.choose = choose;
    this.tip = element("div", { class: "tip", role: "tooltip", hidden: "" });
    this.ring = element("div", { class: "ring", hidden: "" });
    this.current = -1;
    container.tabIndex = 0;
    container.setAttribute("role", "group");
    container.addEventListener("keydown", (event) => this.key(event));
    container.addEventListener("blur", () => this.point(-1));
    new ResizeObserver(() => this.resize()).observe(container);
    this.set(what);
  }

  set(what) {
    this.what = what;
    this.container.setAttribute("aria-label", `${what.label}. Arrow keys go from point to point.`);
    this.marks = what.series.flatMap((series) => series.marks.map((mark) => ({ ...mark, series })))
      .filter((mark) => mark.x > 0 && mark.y > 0);
    this.marks.sort((a, b) => a.x - b.x);
    const xs = this.marks.map((mark) => mark.x), ys = this.marks.map((mark) => mark.y);
    for (const series of what.series) if (series.floor > 0) ys.push(series.floor);
    this.ranges = [logRange(xs), logRange(ys)];
    this.draw();
  }

  draw() {
    if (this.chart) this.chart.destroy();
    const style = getComputedStyle(document.documentElement);
    const ink = (name) => style.getPropertyValue(name).trim();
    this.inks = { ink: ink("--ink"), accent: ink("--accent"), card: ink("--card") };
    const axis = (label, size, scale) => ({
      label, size, scale, labelSize: 20, stroke: ink("--soft"), font: "12px system-ui", labelFont: "12px system-ui",
      grid: { stroke: ink("--grid"), width: 1 }, ticks: { stroke: ink("--line"), width: 1 },
      splits: (u, index, low, high) => logTicks(low, high), filter: (u, splits) => splits,
      values: (u, splits) => splits.map((value) => number(value)),
    });
    const tables = this.what.series.map((series) => {
      const line = (series.curve || series.marks).filter((at) => at.x > 0 && at.y > 0).sort((a, b) => a.x - b.x);
      return line.length ? [line.map((at) => at.x), line.map((at) => at.y)] : [[this.ranges[0][0]], [null]];
    });
    const options = {
      width: Math.max(this.container.clientWidth, 280), height: 380, legend: { show: false },
      scales: { x: { time: false, distr: 3, range: () => this.ranges[0] },
        y: { distr: 3, range: () => this.ranges[1] } },
      axes: [axis(this.what.x, 34, "x"), axis(this.what.y, 62, "y")],
      series: [{}, ...this.what.series.map((series) => ({
        label: series.name, stroke: series.color, width: 1.5, spanGaps: true, points: { show: false } }))],
      cursor: { x: false, y: false, points: { show: false }, drag: { x: false, y: false } },
      hooks: { draw: [(u) => this.drawMarks(u)], setCursor: [(u) => this.hover(u)] },
    };
    this.chart = new uPlot(options, uPlot.join(tables), this.container);
    this.chart.over.append(this.ring, this.tip);
    this.chart.over.addEventListener("click", () => this.enter());
    this.point(-1);
  }

  resize() {
    const width = Math.max(this.container.clientWidth, 280);
    if (this.chart && this.chart.width !== width) this.chart.setSize({ width, height: this.chart.height });
  }

  drawMarks(u) {
    const context = u.ctx, ratio = devicePixelRatio;
    const at = (x, y) => [u.valToPos(x, "x", true), u.valToPos(y, "y", true)];
    const [[left, right], [bottom, top]] = this.ranges;
    const line = (from, to) => {
      context.beginPath();
      context.moveTo(...from);
      context.lineTo(...to);
      context.stroke();
    };
    context.save();
    if (this.what.front) {
      const front = this.marks.filter((mark) => mark.point.front);
      context.strokeStyle = this.inks.accent;
      context.globalAlpha = 0.35;
      context.lineWidth = 6 * ratio;
      context.lineJoin = "round";
      context.beginPath();
      front.forEach((mark, i) => {
        if (i) context.lineTo(...at(mark.x, front[i - 1].y));
        context[i ? "lineTo" : "moveTo"](...at(mark.x, mark.y));
      });
      context.stroke();
    }
    for (const series of this.what.series) {
      if (!(series.floor > bottom)) continue;
      context.globalAlpha = 0.8;
      context.setLineDash([5 * ratio, 4 * ratio]);
      context.strokeStyle = series.color;
      context.lineWidth = ratio;
      line(at(left, series.floor), at(right, series.floor));
      context.setLineDash([]);
    }
    for (const mark of this.marks) {
      context.strokeStyle = context.fillStyle = mark.series.color;
      context.globalAlpha = 0.55;
      context.lineWidth = 1.2 * ratio;
      if (mark.low !== null && mark.high !== null && mark.low !== undefined)
        line(at(mark.x, clampTo(mark.low, bottom, top)), at(mark.x, clampTo(mark.high, bottom, top)));
      if (mark.xLow > 0 && mark.xHigh > 0)
        line(at(clampTo(mark.xLow, left, right), mark.y), at(clampTo(mark.xHigh, left, right), mark.y));
      context.globalAlpha = 1;
      context.beginPath();
      context.arc(...at(mark.x, mark.y), 4.5 * ratio, 0, 2 * Math.PI);
      context.fill();
      context.strokeStyle = this.inks.card;
      context.lineWidth = ratio;
      context.stroke();
    }
    context.restore();
  }

  hover(u) {
    const { left, top } = u.cursor;
    let nearest = -1, least = 30 ** 2; /* pixels */
    if (left >= 0)
      this.marks.forEach((mark, i) => {
        const away = (u.valToPos(mark.x, "x") - left) ** 2 + (u.valToPos(mark.y, "y") - top) ** 2;
        if (away < least) [nearest, least] = [i, away];
      });
    if (nearest !== this.current) this.point(nearest);
  }

  point(index) {
    this.current = index;
    const mark = this.marks[index];
    this.tip.hidden = this.ring.hidden = !mark;
    if (!mark) return;
    const x = this.chart.valToPos(mark.x, "x"), y = this.chart.valToPos(mark.y, "y");
    this.ring.style.left = `${x}px`;
    this.ring.style.top = `${y}px`;
    this.tip.replaceChildren(element("b", {}, mark.tip[0]), ...mark.tip.slice(1).map((text) => element("div", {}, text)));
    const over = this.chart.over, width = this.tip.offsetWidth, height = this.tip.offsetHeight;
    this.tip.style.left = `${x + width + 16 > over.clientWidth ? Math.max(x - width - 14, 0) : x + 14}px`;
    this.tip.style.top = `${clampTo(y - height / 2, 0, Math.max(over.clientHeight - height, 0))}px`;
  }

  enter() {
    if (this.current >= 0) this.choose(this.marks[this.current].point);
  }

  key(event) {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (step && this.marks.length) {
      this.point((this.current + step + this.marks.length) % this.marks.length);
      event.preventDefault();
      event.stopPropagation();
    } else if (event.key === "Enter") {
      this.enter();
    } else if (event.key === "Escape") {
      this.point(-1);
    }
  }
}
