"""report.html in a headless Chromium: it opens without an error or a request to anywhere, the scrubber moves, and the numbers
that it shows are report.json's.

usage: report_page_test.py PROMENADE [FOLDER]   FOLDER keeps what was rendered, and screenshots
Exit status 77: skipped."""

import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

import browser

PROMENADE = ""
FOLDER = pathlib.Path()
# The page names the folder that the command was given in; this one has no place where a browser would break the line.
WIDE_NAME = "where_it_was_rendered_and_wider_than_any_telephone"


def write_scene(folder):
    """A square that a camera passes: 9 frames at 8 a second, and a name that must not break out of the page."""
    points = struct.pack("<12f", -1, -1, -3, 1, -1, -3, 1, 1, -3, -1, 1, -3)
    indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
    (folder / "square.bin").write_bytes(points + indices)
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}]
    accessors = [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, -3], "max": [1, 1, -3]},
                 {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]
    scene = {"asset": {"version": "2.0"}, "buffers": [{"uri": "square.bin", "byteLength": 60}], "bufferViews": views,
             "accessors": accessors, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
             # Dark, so that it can be told from the white sky that a scene without lights gets.
             "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.6, 1], "metallicFactor": 0}}],
             "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}
    file = folder / "a<b>& 'square'.gltf"
    file.write_text(json.dumps(scene))
    keys = [{"time": 0, "eye": [0, 0, 1], "target": [0, 0, -3]}, {"time": 1.125, "eye": [0.6, 0, 1], "target": [0.6, 0, -3]}]
    (folder / "walk.json").write_text(json.dumps({"fps": 8, "keys": keys}))
    return file


def run(*arguments):
    (FOLDER / WIDE_NAME).mkdir(exist_ok=True)
    done = subprocess.run([PROMENADE, *map(str, arguments)], capture_output=True, text=True, check=False, cwd=FOLDER / WIDE_NAME)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)


def render(scene, out, *more):
    run("render", scene, "--path", scene.parent / "walk.json", "--out", out, "--size", "64x36", "--supersample", "1",
        "--spp", "64", "--exposure", "0", "--spacing", "4", *more)


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scene = write_scene(FOLDER)
        render(scene, FOLDER / "walk", "--maps")
        render(scene, FOLDER / "reference", "--method", "full")
        run("report", FOLDER / "walk", "--reference", FOLDER / "reference", "--out", FOLDER / "compared.html")
        cls.report = json.loads((FOLDER / "walk" / "report.json").read_text())
        cls.browser = browser.Browser(1280, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def open(self, file="walk/report.html"):
        self.browser.requests()
        self.browser.log("browser")
        self.browser.open(FOLDER / file)

    def value(self, key):
        return self.browser.run("return document.querySelector(`[data-key='${arguments[0]}']`)?.dataset.value ?? null", key)

    def frame(self):
        return int(self.value("current"))

    def shown(self, place):
        """Address, natural width and alternative text of a picture."""
        return self.browser.run("const i = document.getElementById(arguments[0]);"
                                "return i.decode().then(() => [i.src, i.naturalWidth, i.alt]);", f"picture-{place}")

    def test_opens_without_an_error_or_a_request_to_anywhere(self):
        for file in ("walk/report.html", "compared.html"):
            self.open(file)
            self.browser.press("#scrubber", "end")
            self.assertEqual(self.browser.log("browser"), [])
            outside = [url for url in self.browser.requests() if not url.startswith("data:")]
            self.assertEqual(len(outside), 1, outside)  # the page itself
            self.assertTrue(outside[0].startswith("file:///"))
            page = (FOLDER / file).read_text()
            for word in ("<link rel=\"stylesheet", "<script src", "@import", "url(http"):
                self.assertNotIn(word, page)

    def test_shows_the_numbers_of_report_json(self):
        self.open()
        totals = self.report["totals"]
        for key in ("frames", "keyframes", "samples", "samples_traced", "traced_fraction", "rays", "visibility_rays",
                    "seconds_wall", "peak_rss_bytes"):
            self.assertEqual(float(self.value(key)), totals[key], key)
        self.assertIn(f"{100 * totals['traced_fraction']:.1f}"[:3], self.browser.text("[data-key=traced_fraction]"))
        self.assertEqual(float(self.value("speedup")), totals["speedup_estimated"])
        self.assertIn("estimated, not measured", self.browser.text("#speedup-how"))
        rows = self.browser.run("return [...document.querySelectorAll('#frames-table tbody tr')]"
                                ".map((r) => [...r.cells].map((c) => c.textContent));")
        self.assertEqual([[int(r[0]), r[1], int(r[2].replace(",", "")), int(r[3]), int(r[4])] for r in rows],
                         [[f["index"], f["kind"], f["samples_traced"], f["holes"], f["items_traced"]]
                          for f in self.report["frames"]])
        segments = self.browser.run("return [...document.querySelectorAll('#segments-table tbody tr')]"
                                    ".map((r) => [r.cells[0].textContent, r.cells[6].textContent]);")
        self.assertEqual(segments, [[f"{s['first']}–{s['last']}", s["decision"]] for s in self.report["segments"]])
        parts = self.browser.run("return [...document.querySelectorAll('#parts-table tbody tr')]"
                                 ".map((r) => [r.cells[0].textContent, r.cells[1].textContent]);")
        self.assertEqual(parts, [[name, f"{seconds:.2f}"] for name, seconds in totals["seconds"].items()])
        embedded = self.browser.run("return JSON.parse(document.getElementById('data').textContent).report;")
        self.assertEqual(embedded, self.report)
        self.assertEqual(self.browser.text("#command"), self.report["job"]["command"])

    def test_the_scrubber_moves_the_walk(self):
        self.open()
        self.assertEqual(self.frame(), 0)
        first = self.shown("first")
        self.browser.press("#scrubber", "right")
        self.assertEqual(self.frame(), 1)
        second = self.shown("first")
        self.assertNotEqual(first[0], second[0])
        self.assertEqual(second[1], 64)
        self.assertIn("Frame 1", second[2])
        self.browser.press("#scrubber", "end")
        self.assertEqual(self.frame(), 8)
        self.browser.press("#scrubber", "page up")
        keys = [f["index"] for f in self.report["frames"] if f["kind"] == "keyframe"]
        self.assertEqual(self.frame(), max(k for k in keys if k < 8))
        self.browser.press("#scrubber", "home")
        self.browser.click("#next-key")
        self.assertEqual(self.frame(), min(k for k in keys if k > 0))
        self.browser.run("const s = document.getElementById('scrubber'); s.value = 5; s.dispatchEvent(new Event('input'));")
        frame = self.report["frames"][5]
        self.assertEqual(int(self.value("frame.samples_traced")), frame["samples_traced"])
        self.assertEqual(float(self.value("frame.seconds")), frame["seconds"])

    def test_the_walk_plays_to_its_end(self):
        self.open()
        self.browser.click("#play")
        ended = self.browser.run("return new Promise((done) => { const wait = () => document.getElementById('play').textContent"
                                 " === 'Play' ? done(true) : setTimeout(wait, 50); setTimeout(() => done(false), 20000); wait(); });")
        self.assertTrue(ended)
        self.assertEqual(self.frame(), 8)

    def test_a_judged_middle_shows_what_the_metric_saw(self):
        self.open()
        judged = self.report["segments"][-1]
        self.browser.run("const pick = document.getElementById('second'); pick.value = 'metric';"
                         "pick.dispatchEvent(new Event('change'));"
                         "const s = document.getElementById('scrubber'); s.value = arguments[0];"
                         "s.dispatchEvent(new Event('input'));", judged["middle"])
        source, width, text = self.shown("second")
        self.assertTrue(source.startswith("data:image/webp"))
        self.assertEqual(width, 64)
        self.assertIn("a viewer sees a difference", text)
        self.assertIn("visible", self.browser.text("#legend"))

    def test_a_reference_stands_beside_the_result(self):
        self.open("compared.html")
        self.assertIn("measured", self.browser.run("return document.getElementById('speedup-how').textContent"))
        reference = json.loads((FOLDER / "reference" / "report.json").read_text())
        wanted = reference["totals"]["seconds_wall"] / self.report["totals"]["seconds_wall"]
        self.assertAlmostEqual(float(self.value("speedup")), wanted, places=9)
        self.assertEqual(self.browser.run("return document.getElementById('second').value"), "reference")
        # Frame 0 is a keyframe: the very frame of the reference.
        self.assertEqual(self.shown("first")[0], self.shown("second")[0])
        self.assertEqual(self.browser.run("return [...document.getElementById('first').options].map((o) => o.value)"),
                         ["result", "source", "metric", "reference"])
        self.browser.click("input[value=wipe]")
        self.browser.run("const w = document.getElementById('wipe'); w.value = 20; w.dispatchEvent(new Event('input'));")
        clip = self.browser.run("return getComputedStyle(document.getElementById('picture-second')).clipPath")
        self.assertIn("20%", clip)
        self.assertIsNotNone(self.value("percent_visible_mean"))

    def test_fits_a_telephone_in_light_and_dark(self):
        for width in (360, 1280):
            for dark in (False, True):
                with browser.Browser(width, 800, dark) as other:
                    other.open(FOLDER / "compared.html")
                    self.assertLessEqual(other.run("return document.documentElement.scrollWidth"), width)
                    ground = other.run("return getComputedStyle(document.body).backgroundColor")
                    self.assertEqual(sum(map(int, ground[4:-1].split(","))) < 200, dark, ground)
                    self.assertTrue(other.run("return Object.values(Chart.instances).every((c) => c.width > 100);"))
                    other.screenshot(FOLDER / f"page-{width}-{'dark' if dark else 'light'}.png")

    def test_every_picture_and_chart_has_a_text(self):
        self.open("compared.html")
        silent = self.browser.run("return [...document.querySelectorAll('img, canvas')].filter((e) =>"
                                  "!(e.getAttribute('alt') ?? e.getAttribute('aria-label'))).map((e) => e.id)")
        self.assertEqual(silent, [])
        unnamed = self.browser.run("return [...document.querySelectorAll('input, select, button')].filter((e) => !e.labels?.length"
                                   " && !e.textContent && !e.getAttribute('aria-label')).map((e) => e.id)")
        self.assertEqual(unnamed, [])


if __name__ == "__main__":
    PROMENADE = str(pathlib.Path(sys.argv[1]).absolute())
    reason = browser.missing()
    if reason:
        print(f"SKIPPED: report.html was not tested in a browser: {reason}")
        sys.exit(77)
    if len(sys.argv) > 2:
        FOLDER = pathlib.Path(sys.argv[2]).absolute()
        FOLDER.mkdir(parents=True, exist_ok=True)
        unittest.main(argv=sys.argv[:1])
    with tempfile.TemporaryDirectory(prefix="promenade-page-") as kept:
        FOLDER = pathlib.Path(kept)
        unittest.main(argv=sys.argv[:1], exit=True)
