#!/usr/bin/env python3
"""Time at equal error against Blender Cycles (docs/results.md): one frame of the same glTF scene, by Blender's importer
and Cycles, and by `promenade render --method full`, path and walkthrough.

    tests/bench/against_cycles.py --out out/cycles hall=out/hall-scene/hall.gltf:40 \\
        kitchen=../shared/scenes/country-kitchen/kitchen_walk.gltf:25:0.5

Each scene is NAME=FILE:FRAME[:SKY], SKY being the radiance of a uniform sky, 0 if not said. Needs Debian's packages
blender and openimageio-tools. Prints Markdown; images, logs and numbers.json stay in --out. What is there is not rendered again.

What is alike: size, camera, threads, samples of a pixel (Promenade: supersample^2 positions, from each of which the
rest of the samples leave as paths), a pixel that is the mean over its square, 8 scatterings, no clamping, no
denoiser. What the importer loses, and cycles_frame.py gives back: thin panes, surfaces without a
reflection, lights without a size.

Time is the processor's, because it says the same on a busy machine. Whole is that of the process. Rendering leaves
the start out (reading the scene, building the hierarchy): Cycles renders all images in one process, for Promenade the
start is the least of three runs at 16x9 pixels with one sample. Error is the relative RMSE,
sqrt(mean((a - b)^2 / (b^2 + (m / 100)^2))) over pixels and channels, m the mean of b: b is one's own image of --converged
samples. The walkthrough's b is that of path, so that what its light solution blurs counts as error.
"""
import argparse
import json
import math
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
START_SIZE = (16, 9)


def processor_seconds(command, log):
    """Runs a command; user and system time of it and its children."""
    command = [str(word) for word in command]
    # Blender's Python looks for its library beside the first python3 in PATH, which may be another one.
    environment = {**os.environ, "PATH": "/usr/bin:" + os.environ.get("PATH", "")}
    with open(log, "w") as messages:
        child = subprocess.Popen(command, stdout=messages, stderr=subprocess.STDOUT, env=environment)
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit(f"{' '.join(command)}\nended with status {child.returncode}; see {log}")
    return usage.ru_utime + usage.ru_stime


def values_of(image):
    """Red, green and blue of all pixels, one after the other."""
    text = subprocess.run(["oiiotool", "--dumpdata", image], check=True, capture_output=True, text=True).stdout
    pixels = [line.rpartition(":")[2] for line in text.splitlines() if line.lstrip().startswith("Pixel (")]
    return [float(value) for pixel in pixels for value in pixel.split()[:3]]  # others come after them


def relative_rmse(image, reference):
    floor = (sum(reference) / len(reference) / 100.0) ** 2
    return math.sqrt(sum((a - b) ** 2 / (b * b + floor) for a, b in zip(image, reference)) / len(reference))


def numbers_of(attribute):
    return [float(number) for number in attribute.split(",")]


def camera_of(frame):
    """The camera that Promenade wrote into an OpenEXR file."""
    text = subprocess.run(["oiiotool", "--info", "-v", frame], check=True, capture_output=True, text=True).stdout
    found = {key.strip(): value.strip() for key, _, value in (line.rpartition(": ") for line in text.splitlines())}
    axes = numbers_of(found["promenade:cameraAxes"])
    return {"axes": [axes[0:3], axes[3:6], axes[6:9]], "eye": numbers_of(found["promenade:eye"]),
            "vertical_field_of_view": float(found["promenade:verticalFieldOfView"])}


def extensions_of_materials(scene):
    """By the material's name."""
    materials = json.loads(pathlib.Path(scene).read_text()).get("materials", [])
    return {m.get("name"): m.get("extensions", {}) for m in materials}


def thin_materials(scene):
    return [name for name, e in extensions_of_materials(scene).items()
            if "KHR_materials_transmission" in e and "KHR_materials_volume" not in e]


def matt_materials(scene):
    return [name for name, e in extensions_of_materials(scene).items()
            if e.get("KHR_materials_specular", {}).get("specularFactor", 1.0) == 0.0]


def seconds_at(error, points):
    """Log-log interpolation in (seconds, error), sorted by seconds: ("", seconds); ("under ", seconds) where the first
    point is better than asked; None where no point is as good."""
    if points[0][1] <= error:
        return "under ", points[0][0]
    for (s0, e0), (s1, e1) in zip(points, points[1:]):
        if e1 <= error:
            part = math.log(e0 / error) / math.log(e0 / e1)
            return "", s0 * (s1 / s0) ** part
    return None


class Bench:
    def __init__(self, options, name, scene, frame, sky):
        self.o, self.name, self.scene, self.frame, self.sky = options, name, scene, int(frame), float(sky)
        self.folder = options.out / name
        self.folder.mkdir(parents=True, exist_ok=True)
        self.known = self.folder / "numbers.json"
        self.seconds = json.loads(self.known.read_text()) if self.known.exists() else {}
        self.environment = []
        if self.sky > 0.0:
            file = self.folder / "sky.exr"
            subprocess.run(["oiiotool", "--pattern", f"constant:color={self.sky},{self.sky},{self.sky}", "4x2", "3", "-d", "float",
                            "-o", file], check=True)
            self.environment = ["--environment", file]

    def timed(self, key, command):
        if key not in self.seconds:
            self.seconds[key] = processor_seconds(command, self.folder / f"{key}.log")
            self.known.write_text(json.dumps(self.seconds, indent=1))
            print(f"{self.name}: {key}: {self.seconds[key]:.1f} s", file=sys.stderr, flush=True)
        return self.seconds[key]

    def promenade(self, key, integrator, samples, size=None, seed=0, further=()):
        size = size or self.o.size
        supersample = 1 if size == START_SIZE else self.o.supersample
        return self.timed(key, [
            self.o.promenade, "render", self.scene, "--method", "full", "--integrator", integrator, "--frames",
            f"{self.frame}-{self.frame}", "--size", f"{size[0]}x{size[1]}", "--supersample", supersample, "--spp",
            max(1, samples // supersample ** 2), "--threads", self.o.threads, "--exposure", "0", "--seed", seed, "--out",
            self.folder / key, "--overwrite", *self.environment, *further])

    def promenade_image(self, key):
        return self.folder / key / "frames" / f"{self.frame:06d}.exr"

    def cycles(self, images):
        """`images`: (samples, seed) by name."""
        times = self.folder / "cycles.json"
        job = {"scene": os.path.abspath(self.scene), "thin": thin_materials(self.scene),
               "matt": matt_materials(self.scene), "sky": self.sky, "size": self.o.size,
               "threads": self.o.threads, "bounces": 64, "times": os.path.abspath(times),  # bounces: PathSettings::maxBounces
               "images": [{"name": name, "samples": samples, "seed": seed, "output": os.path.abspath(self.cycles_image(name))}
                          for name, (samples, seed) in images.items()],
               **camera_of(self.promenade_image("path-start-0"))}
        self.timed("cycles", [self.o.blender, "--background", "-noaudio", "--factory-startup", "--python-exit-code", "3",
                              "--python", HERE / "cycles_frame.py", "--", json.dumps(job)])
        return json.loads(times.read_text())

    def cycles_image(self, key):
        return self.folder / f"{key}.exr"

    def visible(self, image, reference):
        result = subprocess.run([self.o.promenade, "compare", image, reference, "--exposure", "auto", "--json"],
                                check=True, capture_output=True, text=True).stdout
        return json.loads(result)["percent_visible_mean"]

    def measure(self):
        """Rows by renderer: samples, rendering, whole, error, per cent visible."""
        start = {"path": min(self.promenade(f"path-start-{i}", "path", 1, START_SIZE) for i in range(3))}
        start["walkthrough"] = start["path"]
        use_light = ["--light-solution", self.folder / "light.bin"]
        least = self.o.samples[0]
        solving = self.promenade("walkthrough-solving", "walkthrough", least, further=use_light)
        whole, images = {}, {}
        for n in self.o.samples:
            whole["path", n] = self.promenade(f"path-{n}", "path", n)
            whole["walkthrough", n] = self.promenade(f"walkthrough-{n}", "walkthrough", n, further=use_light)
            for integrator in ("path", "walkthrough"):
                images[integrator, n] = self.promenade_image(f"{integrator}-{n}")
        # Other random numbers, so that no image shares its noise with what it is held against.
        cycles = self.cycles({**{f"cycles-{n}": (n, 0) for n in self.o.samples}, "cycles-converged": (self.o.converged, 1)})
        start["cycles"] = cycles["start"]
        for n in self.o.samples:
            whole["cycles", n] = cycles["start"] + cycles[f"cycles-{n}"]
            images["cycles", n] = self.cycles_image(f"cycles-{n}")
        self.promenade("path-converged", "path", self.o.converged, seed=1)
        converged = {"cycles": self.cycles_image("cycles-converged"), "path": self.promenade_image("path-converged")}
        converged["walkthrough"] = converged["path"]
        self.light_seconds = solving - whole["walkthrough", least]
        rows = {}
        for (renderer, n), seconds in whole.items():
            reference = converged[renderer]
            error = relative_rmse(values_of(images[renderer, n]), values_of(reference))
            rows.setdefault(renderer, []).append(
                (n, seconds - start[renderer], seconds, error, self.visible(images[renderer, n], reference)))
        self.agreement = (relative_rmse(values_of(converged["path"]), values_of(converged["cycles"])),
                          self.visible(converged["path"], converged["cycles"]))
        for row in rows["walkthrough"][:]:
            n, rendering, whole_seconds, error, visible = row
            rows.setdefault("walkthrough, light counted", []).append(
                (n, rendering + self.light_seconds, whole_seconds + self.light_seconds, error, visible))
        return rows

    def report(self):
        rows = self.measure()
        print(f"\n{self.name}, frame {self.frame}, {self.o.size[0]}x{self.o.size[1]}, light solution {self.light_seconds:.1f} s; the two "
              f"converged images: relative RMSE {self.agreement[0]:.3f}, {self.agreement[1]:.1f} per cent visible\n")
        print("| renderer | samples | seconds rendering | whole | relative RMSE | per cent visible |\n" + "|---" * 6 + "|")
        for renderer, points in rows.items():
            for n, rendering, whole, error, visible in points:
                print(f"| {renderer} | {n} | {rendering:.1f} | {whole:.1f} | {error:.4f} | {visible:.1f} |")
        print("\n| as good as Cycles with | Cycles: seconds rendering (whole) | Promenade | ratio (whole) |\n" + "|---" * 4 + "|")
        for renderer in [r for r in rows if r != "cycles"]:
            for n, rendering, whole, error, _ in rows["cycles"]:
                mine = seconds_at(error, [(row[1], row[3]) for row in rows[renderer]])
                mine_whole = seconds_at(error, [(row[2], row[3]) for row in rows[renderer]])
                found = "not reached | |"
                if mine:
                    found = (f"{mine[0]}{mine[1]:.1f} ({mine_whole[1]:.1f}) | "
                             f"{mine[0]}{mine[1] / rendering:.2f} ({mine_whole[1] / whole:.2f}) |")
                print(f"| {n} samples: {renderer} | {rendering:.1f} ({whole:.1f}) | {found}", flush=True)


def size_of(text):
    width, height = text.split("x")
    return int(width), int(height)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--promenade", default=HERE.parent.parent / "build/release/src/app/promenade")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--size", type=size_of, default=(160, 90))
    parser.add_argument("--supersample", type=int, default=4)
    parser.add_argument("--samples", type=lambda text: [int(n) for n in text.split(",")], default=[16, 64, 256])
    parser.add_argument("--converged", type=int, default=4096)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    for scene in options.scenes:
        name, _, rest = scene.partition("=")
        file, frame, *sky = rest.split(":")
        Bench(options, name, file, frame, sky[0] if sky else 0.0).report()


if __name__ == "__main__":
    main()
