"""The report of `lightsheaf measure --html` in a real browser: plots, pictures, tables, keys.

With LSF_SCREENSHOTS in the environment, pictures of the page go to the folder that it names.
"""
import base64
import json
import os
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.environ["LSF_SOURCE_ROOT"], "tests/cli"))
sys.path.insert(0, os.path.dirname(__file__))
import browser  # noqa: E402
from command import CommandTest  # noqa: E402

SKIPPED = 77
NAME = "a<b>&'quoted'.gltf"
LEFT, RIGHT, ENTER = "\ue012", "\ue014", "\ue007"


def neutral(rgb):
    """Khronos PBR Neutral and sRGB, to codes of 0 to 255."""
    smallest = min(rgb)
    veil = smallest - 6.25 * smallest ** 2 if smallest < 0.08 else 0.04
    rgb = [v - veil for v in rgb]
    peak = max(rgb)
    if peak >= 0.76:
        new = 1 - 0.24 ** 2 / (peak + 0.24 - 0.76)
        keep = 1 / (0.15 * (peak - new) + 1)
        rgb = [v * new / peak * keep + new * (1 - keep) for v in rgb]
    return [255 * (12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055) for v in rgb]


class Report(CommandTest):
    def setUp(self):
        super().setUp()
        self.scene(NAME)
        self.run_command("measure", NAME, "-t", "direct,cone", "--sweep", "voxel.resolution=16,32", "-s", "4",
                         "--seeds", "2", "--reference-samples", "8", "-r", "48,36", "--cache", "none",
                         "--prices", "--html", "r.html", "--json", "r.json", "--pictures", "pictures", "-q")
        self.data = self.read_json("r.json")
        self.browser = browser.Browser()
        self.addCleanup(self.browser.close)
        self.browser.open("file://" + self.path("r.html"))

    def js(self, script, *arguments):
        return self.browser.run(script, *arguments)

    def text(self, selector):
        return self.js("return document.querySelector(arguments[0]).textContent", selector)

    def canvas(self):
        """Codes of the viewer's picture."""
        return self.js("""const c = document.getElementById('canvas');
            return [c.width, c.height, Array.from(c.getContext('2d').getImageData(0, 0, c.width, c.height).data)]""")

    def png(self, name):
        """Codes of a PNG, which the browser decodes."""
        url = "data:image/png;base64," + base64.b64encode(self.read(name)).decode()
        return self.browser.run_later("""const [url, done] = arguments, image = new Image();
            image.onload = () => {
                const c = document.createElement('canvas');
                c.width = image.width; c.height = image.height;
                const context = c.getContext('2d');
                context.drawImage(image, 0, 0);
                done([c.width, c.height, Array.from(context.getImageData(0, 0, c.width, c.height).data)]);
            };
            image.src = url;""", url)

    def assert_same_picture(self, name):
        width, height, codes = self.canvas()
        self.assertEqual((width, height), (48, 36))
        expected = self.png(name)
        self.assertEqual(expected[:2], [width, height])
        worst = max(abs(a - b) for a, b in zip(codes, expected[2]))
        self.assertLessEqual(worst, 3, name)  # 8 bits of mantissa, of the brightest channel
        self.assertGreater(max(codes[0::4]) - min(codes[0::4]), 30)

    def shoot(self, name):
        folder = os.environ.get("LSF_SCREENSHOTS")
        if folder:
            self.browser.screenshot(os.path.join(folder, name))

    def test_all_of_it(self):
        """One page, for a browser takes a while to start."""
        self.head()
        self.plots()
        self.pictures()
        self.tables()
        self.prices()
        self.names()
        self.shoot("light.png")
        self.dark()
        self.narrow()
        self.nothing_went_wrong()

    def head(self):
        self.assertEqual(self.text("h1"), f"{NAME}: error against time")
        self.assertEqual(self.text("#command"), self.data["command_line"])
        self.assertIn(self.data["device"]["renderer"], self.text("#facts"))
        self.assertIn("Leon Sorokin", self.read("r.html").decode())

    def ring(self, plot):
        return self.js("""const ring = document.querySelector(arguments[0] + ' .ring');
            if (ring.hidden) return null;
            const box = ring.getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]""", plot)

    def tip(self, plot):
        return self.js("""const tip = document.querySelector(arguments[0] + ' .tip');
            return tip.hidden ? null : tip.innerText""", plot)

    def plots(self):
        for plot in ("#error-plot", "#convergence-plot"):
            self.js("document.querySelector(arguments[0]).scrollIntoView({block: 'center'})", plot)
            self.js("document.querySelector(arguments[0]).focus()", plot)
            self.assertIsNone(self.tip(plot))
            seen = set()
            for _ in self.data["points"]:
                self.browser.press(RIGHT)
                by_key, place = self.tip(plot), self.ring(plot)
                self.js("document.activeElement.blur()")
                self.assertIsNone(self.tip(plot))
                self.browser.move(*place)
                self.assertIsNotNone(self.tip(plot))
                seen.add(by_key)
                self.js("document.querySelector(arguments[0]).focus()", plot)
            self.js("document.activeElement.blur()")
            self.assertIsNotNone(self.tip(plot) or by_key)
            self.browser.move(2, 2)
            self.assertIsNone(self.tip(plot))
        self.one_point()
        self.metric()

    def one_point(self):
        """What a hovered point says is what was measured; a click shows its picture."""
        point = min(self.data["points"], key=lambda p: p["milliseconds"]["median"])
        self.js("document.getElementById('error-plot').scrollIntoView({block: 'center'})")
        self.js("document.getElementById('error-plot').focus()")
        self.browser.press(RIGHT)
        place = self.ring("#error-plot")
        self.js("document.activeElement.blur()")
        self.browser.move(*place)
        said = self.tip("#error-plot")
        self.assertTrue(said.startswith(point["technique"]), said)
        self.assertAlmostEqual(float(re.search(r"relMSE (\S+)", said)[1]) / point["relmse"]["value"], 1, delta=0.01)
        self.assertAlmostEqual(float(re.search(r"(\S+) ms a frame", said)[1]) /
                               point["milliseconds"]["median"], 1, delta=0.01)
        self.shoot("hover.png")
        self.browser.move(*place, click=True)
        self.assertEqual(self.js("return document.getElementById('picture-choice').value"),
                         str(self.data["points"].index(point)))

    def metric(self):
        """Another error, and one configuration less."""
        self.js("""const s = document.getElementById('metric'); s.value = 'flip';
            s.dispatchEvent(new Event('change'))""")
        self.js("document.getElementById('error-plot').focus()")
        self.browser.press(RIGHT)
        self.assertIn("FLIP", self.tip("#error-plot").splitlines()[1])
        self.js("document.querySelector('#legend button').click()")
        self.js("document.getElementById('error-plot').focus()")
        self.browser.press(LEFT)
        hidden = self.text("#legend button")
        self.assertNotIn(hidden + ",", self.tip("#error-plot"))
        self.js("document.querySelector('#legend button').click(); document.activeElement.blur()")

    def choose(self, index):
        self.js("""const s = document.getElementById('picture-choice'); s.value = String(arguments[0]);
            s.dispatchEvent(new Event('change')); document.activeElement.blur()""", index)

    def pictures(self):
        self.js("document.getElementById('viewer').scrollIntoView({block: 'start'})")
        for index, point in enumerate(self.data["points"]):
            self.choose(index)
            self.browser.press("1")
            self.assert_same_picture(point["preview"])
        self.browser.press("2")
        self.assertEqual(self.js("return document.querySelector('[aria-checked=true]').dataset.show"), "reference")
        self.assert_same_picture(self.data["reference"]["preview"])
        self.exposure()
        self.keys()
        self.difference()
        self.zoom()

    def keys(self):
        """They flip whatever was touched last: the slider keeps its arrows, the list its own."""
        shown = "return document.querySelector('.flip [aria-checked=true]').dataset.show"
        for name in ("exposure", "picture-choice", "metric"):
            self.js("document.getElementById(arguments[0]).focus()", name)
            for key, show in (("1", "result"), ("2", "reference")):
                self.browser.press(key)
                self.assertEqual(self.js(shown), show)
        before = self.text("#exposure-value")
        self.js("document.getElementById('exposure').focus()")
        self.browser.press(RIGHT)
        self.assertNotEqual(self.text("#exposure-value"), before)
        self.browser.press(LEFT)
        self.assertEqual(self.text("#exposure-value"), before)
        self.js("document.activeElement.blur()")

    def exposure(self):
        """Pixels are tone-mapped at the slider's exposure; keys go by half an EV."""
        self.js("""const e = document.getElementById('exposure'); e.value = '-1.5';
            e.dispatchEvent(new Event('input'))""")
        self.assertEqual(self.text("#exposure-value"), "−1.5 EV")
        darker = self.canvas()[2]
        self.browser.press("]", "]", "]")
        self.assertEqual(self.text("#exposure-value"), "+0.0 EV")
        self.assert_same_picture(self.data["reference"]["preview"])
        brighter = self.canvas()[2]
        self.assertTrue(all(a <= b for a, b in zip(darker, brighter)))
        at = max(range(0, len(brighter), 4), key=lambda i: brighter[i])
        rgb = self.linear(at // 4)
        for c, code in enumerate(neutral([v * 2 ** -1.5 for v in rgb])):
            self.assertAlmostEqual(darker[at + c], code, delta=2)

    def linear(self, pixel):
        """A pixel of the reference as the page holds it, decoded here."""
        packed = re.search(rb'id="picture-reference"[^>]*>([^<]*)<', self.read("r.html"))[1]
        r, g, b, e = base64.b64decode(packed)[4 * pixel:4 * pixel + 4]
        return [(m + 0.5) * 2.0 ** (e - 136) if m else 0.0 for m in (r, g, b)]

    def difference(self):
        self.browser.press("3")
        dark = self.canvas()[2]
        self.browser.press("1")
        self.assertLess(sum(dark[0::4]), sum(self.canvas()[2][0::4]))
        self.assertGreater(max(dark[0::4]), 0)

    def zoom(self):
        scale = "return new DOMMatrix(getComputedStyle(document.getElementById('canvas')).transform).a"
        fitted = self.js(scale)
        self.browser.press("+", "+")
        self.assertAlmostEqual(self.js(scale) / fitted, 2, places=2)
        self.browser.press("-")
        self.assertAlmostEqual(self.js(scale) / fitted, 2 ** 0.5, places=2)
        self.browser.press("0")
        self.assertAlmostEqual(self.js(scale), fitted, places=4)
        middle = self.js("""const box = document.getElementById('stage').getBoundingClientRect();
            return [box.x + box.width / 2, box.y + box.height / 2]""")
        self.browser.move(*middle)
        self.assertRegex(self.text("#readout"), r"^pixel 2[34], 1[78]   result \S+ \S+ \S+   reference \S+ \S+ \S+$")

    def tables(self):
        column = """const rows = [...document.querySelectorAll('#points tbody tr')];
            return rows.map((row) => Number(row.cells[arguments[0]].textContent))"""
        heads = self.js("return [...document.querySelectorAll('#points th')].map((th) => th.textContent)")
        index = heads.index("relMSE")
        expected = sorted(p["relmse"]["value"] for p in self.data["points"])
        for turn in (expected, expected[::-1]):
            self.js("document.querySelectorAll('#points th button')[arguments[0]].click()", index)
            for got, want in zip(self.js(column, index), turn):
                self.assertAlmostEqual(got, want, delta=0.01 * abs(want))
        self.js("document.querySelector('#points tbody tr').click()")
        worst = max(range(len(self.data["points"])), key=lambda i: self.data["points"][i]["relmse"]["value"])
        self.assertEqual(self.js("return document.getElementById('picture-choice').value"), str(worst))

    def prices(self):
        prices = self.data["prices"]
        self.assertEqual(self.text("#price-technique"), prices["technique"])
        rows = self.js("""return [...document.querySelectorAll('#price-table tbody tr')]
            .map((row) => [...row.cells].map((cell) => cell.textContent))""")
        self.assertEqual([row[0] for row in rows], [price["feature"] for price in prices["features"]])
        self.assertIn("lights", [row[0] for row in rows])
        for row, price in zip(rows, prices["features"]):
            saved = price["milliseconds"]
            said = re.fullmatch(r"(\S+) \((\S+) to (\S+)\)", row[2])
            for text, key in zip(said.groups(), ("value", "low", "high")):
                self.assertAlmostEqual(float(text), saved[key], delta=0.01 * abs(saved[key]))
        bars = self.js("return [...document.querySelectorAll('.bar')].map((bar) => bar.children.length)")
        self.assertEqual(len(bars), len(self.data["configurations"]))
        self.assertTrue(all(bars))

    def names(self):
        """All that can be operated has a name for who cannot see it."""
        bare = self.js("""return [...document.querySelectorAll('button, input, select, [tabindex="0"]')].filter((e) =>
            !(e.getAttribute('aria-label') || e.textContent.trim() || (e.labels && e.labels.length)))
            .map((e) => e.outerHTML)""")
        self.assertEqual(bare, [])

    def dark(self):
        self.browser.developer("Emulation.setEmulatedMedia",
                               features=[{"name": "prefers-color-scheme", "value": "dark"}])
        ink = self.js("return getComputedStyle(document.body).backgroundColor")
        self.assertLess(max(map(int, re.findall(r"\d+", ink))), 60)
        self.shoot("dark.png")

    def narrow(self):
        self.browser.developer("Emulation.setDeviceMetricsOverride", width=400, height=800, deviceScaleFactor=2,
                               mobile=True)
        self.browser.run_later("setTimeout(arguments[0], 300)")
        self.assertLessEqual(self.js("return document.documentElement.scrollWidth"), 401)
        self.shoot("narrow.png")

    def nothing_went_wrong(self):
        self.assertEqual([e["message"] for e in self.browser.log("browser")
                          if e["level"] in ("WARNING", "SEVERE")], [])
        asked = set()
        for entry in self.browser.log("performance"):
            message = json.loads(entry["message"])["message"]
            if (message["method"] == "Network.requestWillBeSent" and
                    message["params"]["documentURL"].startswith("file:")):  # not the browser's own page
                asked.add(message["params"]["request"]["url"].split(":")[0])
        self.assertEqual(asked, {"file", "data"})  # itself, and the PNG files of this test


if __name__ == "__main__":
    if not browser.find():
        print("skipped: chromium and chromium-driver are not installed")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
