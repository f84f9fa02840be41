/* Tables that sort by any column: { title, of, shown } each, `of` for the order. */
class Table {
  constructor(table, columns, rows, choose) {
    Object.assign(this, { columns, rows, choose, sorted: -1, ascending: true, body: element("tbody") });
    this.heads = columns.map((column, index) => {
      const button = element("button", { type: "button" }, column.title);
      button.addEventListener("click", () => this.sort(index));
      return element("th", { scope: "col", "aria-sort": "none" }, button);
    });
    table.append(element("thead", {}, element("tr", {}, ...this.heads)), this.body);
    this.lines = new Map(rows.map((row) => [row, this.line(row)]));
    this.body.append(...this.lines.values());
  }

  line(row) {
    const cells = this.columns.map((column) => {
      const cell = element("td", column.words ? { class: "words" } : {}, column.shown(row));
      if (column.more) cell.title = column.more(row);
      if (column.strong && column.strong(row)) cell.classList.add("front");
      if (column.faint && column.faint(row)) cell.classList.add("faint");
      return cell;
    });
    const line = element("tr", this.choose ? { tabindex: "0" } : {}, ...cells);
    if (this.choose) {
      line.addEventListener("click", () => this.choose(row));
      line.addEventListener("keydown", (event) => event.key === "Enter" && this.choose(row));
    }
    return line;
  }

  sort(index) {
    this.ascending = this.sorted === index ? !this.ascending : true;
    this.sorted = index;
    const of = this.columns[index].of, way = this.ascending ? 1 : -1;
    const missing = (value) => value === null || value === undefined || Number.isNaN(value);
    const order = [...this.rows].sort((a, b) => {
      const x = of(a), y = of(b);
      if (missing(x) || missing(y)) return missing(x) - missing(y);
      return way * (typeof x === "string" ? x.localeCompare(y, undefined, { numeric: true }) : x - y);
    });
    this.body.append(...order.map((row) => this.lines.get(row)));
    this.heads.forEach((head, i) => head.setAttribute("aria-sort",
      i === index ? (this.ascending ? "ascending" : "descending") : "none"));
  }

  mark(row) {
    for (const [other, line] of this.lines) line.classList.toggle("chosen", other === row);
  }
}

const figure = (title, of, digits) => ({ title, of, shown: (row) => number(of(row), digits) });

function pointColumns() {
  const value = (key) => (point) => (point[key] || {}).value;
  const bias = (point) => {
    const means = (point.bias || []).map((channel) => channel.value).filter(Number.isFinite);
    return means.length ? 100 * means.reduce((most, mean) => (Math.abs(mean) > Math.abs(most) ? mean : most), 0) : null;
  };
  return [
    { title: "Technique and options", of: nameOf, shown: nameOf, strong: (point) => point.front },
    figure("Samples", (point) => point.samples, 6),
    figure("ms", medianTime),
    { title: "GL memory", of: (point) => (point.gl_bytes || {}).peak,
      shown: (point) => (point.gl_bytes ? bytes(point.gl_bytes.peak) : "–") },
    figure("RMSE", value("rmse")),
    { ...figure("relMSE", value("relmse")), more: (point) => interval(point.relmse || {}) },
    figure("Bias %", bias, 2),
    figure("SSIM", value("ssim"), 4),
    figure("FLIP", value("flip")),
    figure("HDR-FLIP", value("flip_hdr")),
    figure("Gain %/ms", (point) => point.ssim_gain),
    ...pathColumns(),
  ];
}

/* Of frames that follow each other, where they were measured. */
function pathColumns() {
  if (!points.some((point) => point.path)) return [];
  const of = (key) => (point) => ((point.path || {})[key] || {}).value;
  return [figure("Frames’ relMSE", of("relmse")), figure("Change", of("difference")), figure("Flicker", of("flicker"))];
}

/* Whether an interval is all on one side of 0. */
const shows = (estimate) => Boolean(estimate) && (estimate.low > 0 || estimate.high < 0);

/* What a scene without one of its features saves. */
function priceColumns() {
  return [
    { title: "Without", of: (price) => price.feature, shown: (price) => price.feature },
    { title: "Bytes saved", of: (price) => price.bytes, shown: (price) => bytes(price.bytes) },
    { title: "ms saved", of: (price) => (price.milliseconds || {}).value, faint: (price) => !shows(price.milliseconds),
      shown: (price) => interval(price.milliseconds || {}) },
    figure("Passes", (price) => price.passes.length, 3),
    figure("Switches", (price) => price.switches.length, 3),
    { title: "What goes", words: true, of: (price) => price.passes.join(" "),
      shown: (price) => [...price.passes, ...price.resources].join(", ") || "–" },
  ];
}
