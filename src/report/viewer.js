/* One picture at a time: the result, the reference or their difference, at any exposure. */

const srgb = (value) => (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055);

/* Code values of what a display emits, 0 to 1 in steps of a 4096th. */
const codes = Uint8ClampedArray.from({ length: 4097 }, (unused, i) => Math.round(255 * srgb(i / 4096)));

/* Khronos PBR Neutral, as the command's own PNG files have it. */
function neutral(rgb) {
  const least = Math.min(rgb[0], rgb[1], rgb[2]);
  const veil = least < 0.08 ? least - 6.25 * least * least : 0.04;
  const peak = Math.max(rgb[0], rgb[1], rgb[2]) - veil;
  let scale = 1, white = 0;
  if (peak >= 0.76) {
    const squeezed = 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
    const keep = 1 / (0.15 * (peak - squeezed) + 1);
    scale = squeezed / peak * keep;
    white = squeezed * (1 - keep);
  }
  for (let c = 0; c < 3; c++) rgb[c] = (rgb[c] - veil) * scale + white;
}

class Viewer {
  constructor() {
    this.stage = get("stage");
    this.canvas = get("canvas");
    this.show = "result";
    this.point = null;
    this.exposure = data.exposure || 0;
    this.view = { x: 0, y: 0, zoom: 1, fitted: true };
    get("exposure").value = this.exposure;
    get("exposure").addEventListener("input", (event) => this.expose(Number(event.target.value)));
    for (const button of document.querySelectorAll("[data-show]"))
      button.addEventListener("click", () => this.flip(button.dataset.show));
    get("zoom-in").addEventListener("click", () => this.zoomBy(Math.SQRT2));
    get("zoom-out").addEventListener("click", () => this.zoomBy(Math.SQRT1_2));
    get("zoom-fit").addEventListener("click", () => this.fit());
    this.listenToStage();
    document.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.view.fitted && this.fit()).observe(this.stage);
    this.expose(this.exposure);
  }

  listenToStage() {
    const stage = this.stage;
    let dragged = null;
    stage.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomBy(2 ** (-event.deltaY / 300), this.within(event));
    }, { passive: false });
    stage.addEventListener("pointerdown", (event) => {
      dragged = [event.clientX, event.clientY];
      stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
      if (dragged) this.moveBy(event.clientX - dragged[0], event.clientY - dragged[1]);
      dragged = dragged && [event.clientX, event.clientY];
      this.readOut(this.within(event));
    });
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { dragged = null; });
    stage.addEventListener("pointerleave", () => this.readOut(null));
  }

  within(event) {
    const box = this.stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  images() {
    const result = this.point === null ? null : picture(`point-${this.point}`);
    return { result, reference: picture("reference") };
  }

  choose(point) {
    this.point = point;
    this.draw();
    if (this.view.fitted) this.fit();
  }

  flip(show) {
    this.show = show;
    for (const button of document.querySelectorAll("[data-show]"))
      button.setAttribute("aria-checked", String(button.dataset.show === show));
    this.draw();
  }

  expose(exposure) {
    this.exposure = clampTo(Math.round(10 * exposure) / 10, -10, 10);
    get("exposure").value = this.exposure;
    get("exposure-value").value = `${this.exposure < 0 ? "−" : "+"}${Math.abs(this.exposure).toFixed(1)} EV`;
    this.draw();
  }

  draw() {
    const { result, reference } = this.images();
    const shown = this.show === "reference" ? reference : result;
    const missing = !shown || (this.show === "difference" && !reference);
    get("no-picture").hidden = !missing;
    this.canvas.hidden = missing;
    const name = this.point === null ? "" : pointName(points[this.point]);
    this.stage.setAttribute("aria-label", missing ? "No picture" : `${this.show} of ${name}`);
    if (missing) return;
    const { width, height } = shown;
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    const context = this.canvas.getContext("2d", { willReadFrequently: true }), image = context.createImageData(width, height);
    const scale = 2 ** this.exposure, rgb = [0, 0, 0];
    for (let i = 0; i < width * height; i++) {
      for (let c = 0; c < 3; c++) {
        const value = shown.values[3 * i + c];
        rgb[c] = this.show === "difference" ? 4 * Math.abs(value - reference.values[3 * i + c]) : value;
        rgb[c] = Math.min(rgb[c] * scale, 1e6);
      }
      neutral(rgb);
      for (let c = 0; c < 3; c++) image.data[4 * i + c] = codes[Math.round(4096 * clampTo(rgb[c], 0, 1))];
      image.data[4 * i + 3] = 255;
    }
    context.putImageData(image, 0, 0);
  }

  /* --- zoom --- */

  place() {
    const { x, y, zoom } = this.view;
    this.canvas.style.transform = `translate(${x}px, ${y}px) scale(${zoom})`;
    this.canvas.style.imageRendering = zoom < 1 ? "auto" : "pixelated";
  }

  fit() {
    const { clientWidth, clientHeight } = this.stage, { width, height } = this.canvas;
    const zoom = Math.min(clientWidth / width, clientHeight / height);
    this.view = { zoom, x: (clientWidth - zoom * width) / 2, y: (clientHeight - zoom * height) / 2, fitted: true };
    this.place();
  }

  zoomBy(factor, [x, y] = [this.stage.clientWidth / 2, this.stage.clientHeight / 2]) {
    const before = this.view, zoom = clampTo(before.zoom * factor, 0.05, 64), ratio = zoom / before.zoom;
    this.view = { zoom, x: x - ratio * (x - before.x), y: y - ratio * (y - before.y), fitted: false };
    this.place();
  }

  moveBy(x, y) {
    this.view = { ...this.view, x: this.view.x + x, y: this.view.y + y, fitted: false };
    this.place();
  }

  readOut(at) {
    const { result, reference } = this.images();
    const shown = result || reference, { x, y, zoom } = this.view;
    const column = at && Math.floor((at[0] - x) / zoom), row = at && Math.floor((at[1] - y) / zoom);
    if (!at || !shown || column < 0 || row < 0 || column >= shown.width || row >= shown.height) {
      get("readout").textContent = "\u00a0";
      return;
    }
    const pixel = (image) => [0, 1, 2].map((c) => number(image.values[3 * (row * image.width + column) + c]));
    const parts = [`pixel ${column}, ${row}`];
    if (result) parts.push(`result ${pixel(result).join(" ")}`);
    if (reference) parts.push(`reference ${pixel(reference).join(" ")}`);
    get("readout").textContent = parts.join("   ");
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    const actions = {
      1: () => this.flip("result"), 2: () => this.flip("reference"), 3: () => this.flip("difference"),
      "+": () => this.zoomBy(Math.SQRT2), "=": () => this.zoomBy(Math.SQRT2), "-": () => this.zoomBy(Math.SQRT1_2),
      0: () => this.fit(), "[": () => this.expose(this.exposure - 0.5), "]": () => this.expose(this.exposure + 0.5),
    };
    const action = actions[event.key] ||
      (event.target === this.stage && arrows[event.key] && (() => this.moveBy(...arrows[event.key])));
    if (!action) return;
    event.preventDefault();
    action();
  }
}
