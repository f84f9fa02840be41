/* Puts the page together. */
function describe() {
  const scene = (data.scene || "").split("/").pop();
  const [width, height] = data.resolution || [];
  get("title").textContent = scene ? `${scene}: error against time` : "Lightsheaf measure";
  document.title = get("title").textContent;
  const device = data.device || {}, machine = data.machine || {};
  get("facts").textContent = [`${width} × ${height}`, `${data.bounces} bounces`,
    `${configurations.length} configurations`, `${points.length} points${data.interrupted ? ", interrupted" : ""}`,
    device.renderer,
    `Lightsheaf ${data.lightsheaf}`].filter(Boolean).join(" · ");
  get("command").textContent = data.command_line || "";
  const rows = {
    Scene: data.scene, Processor: machine.processor && `${machine.processor}, ${machine.cores} cores`,
    Memory: machine.memory_bytes && bytes(machine.memory_bytes), System: machine.system,
    OpenGL: device.renderer && `${device.renderer}, ${device.version}`,
    Clock: { gpu: "GPU timestamps", wall: "wall clock of finished frames",
      processor: "processor time of all cores" }[data.clock],
    Reference: data.reference && `${data.reference.technique}, ${(data.reference.samples || []).join(" + ")} samples a ` +
      `pixel, standard deviation ${number(data.reference.rmse)}`,
    "relMSE’s ε": number(data.relmse_epsilon), "Took": `${number(data.seconds)} s`,
  };
  for (const [term, said] of Object.entries(rows))
    if (said) get("machine").append(element("dt", {}, term), element("dd", {}, said));
  const answer = data.answer;
  if (!answer) return;
  const asked = Number.isFinite(answer.budget_ms) ? `within ${number(answer.budget_ms)} ms`
    : `soonest to a relMSE of ${number(answer.budget_relmse)}`;
  const best = `${nameOf(configurations[answer.configuration])}, ${answer.samples} sample${answer.samples === 1 ? "" : "s"}`;
  const sure = Number.isFinite(answer.confidence) && Number.isFinite(answer.budget_ms) &&
    ` ${answer.candidates} candidates, ${answer.finalists} to the end: that none of these is better by 10 % has a ` +
    `probability of ${Math.floor(100 * answer.confidence)} %.`;
  get("answer").append(element("strong", {}, `Best ${data.interrupted ? "so far " : ""}${asked}: `), `${best}: relMSE ${interval(answer.relmse)} in ` +
    `${number(answer.milliseconds)} ms. ${answer.met ? sure || "" : "Nothing that was measured meets it."}`,
  element("pre", {}, answer.command || ""));
  get("answer").hidden = false;
}

describe();
const viewer = new Viewer();
const table = new Table(get("points"), pointColumns(), points, (point) => choose(point, true));

function choose(point, look) {
  const index = points.indexOf(point);
  get("picture-choice").value = String(index);
  viewer.choose(index);
  table.mark(point);
  if (look) get("viewer").scrollIntoView({ block: "nearest" });
}

points.forEach((point, index) => get("picture-choice").append(
  element("option", { value: String(index) }, `${pointName(point)}${point.front ? " ★" : ""}`)));
get("picture-choice").addEventListener("change", (event) => choose(points[Number(event.target.value)], false));
metrics.filter((metric) => points.some((point) => metric.of(point).value > 0)).forEach((metric) =>
  get("metric").append(element("option", { value: metric.key }, metric.label)));

const chosenMetric = () => metrics.find((metric) => metric.key === get("metric").value) || metrics[0];
const plots = {
  error: new Plot(get("error-plot"), errorFigure(chosenMetric()), (point) => choose(point, true)),
  convergence: new Plot(get("convergence-plot"), convergenceFigure(), (point) => choose(point, true)),
};

const swatches = configurations.map(() => element("span", { class: "swatch" }));

function redraw() {
  swatches.forEach((swatch, index) => { swatch.style.background = colourOf(index); });
  plots.error.set(errorFigure(chosenMetric()));
  plots.convergence.set(convergenceFigure());
}

get("metric").addEventListener("change", redraw);
darkPage.addEventListener("change", redraw);
configurations.forEach((configuration, index) => {
  const button = element("button", { type: "button", "aria-pressed": "true" }, swatches[index], nameOf(configuration));
  button.addEventListener("click", () => {
    const hide = !hiddenConfigurations.has(index);
    hiddenConfigurations[hide ? "add" : "delete"](index);
    button.setAttribute("aria-pressed", String(!hide));
    redraw();
  });
  get("legend").append(button);
});
redraw();

if (data.clock === "processor") get("pass-clock").textContent = ", by the clock on the wall";
get("passes").hidden = !passBars(get("pass-bars"), (said) => { get("pass-readout").textContent = said; });
if (data.prices && data.prices.features.length) {
  new Table(get("price-table"), priceColumns(), data.prices.features, null);
  get("price-technique").textContent = data.prices.technique;
  get("prices").hidden = false;
}
/* First of all what is best. */
const errorOf = (point) => (point.relmse || {}).value ?? Infinity;
const best = points.reduce((least, point) => (least && errorOf(least) <= errorOf(point) ? least : point), null);
if (best) choose(best, false);
