#!/usr/bin/env python3
"""How many paths a pixel `--integrator path` needs until two seeds look alike (docs/results.md, Clean frames).

    tests/bench/paths_until_clean.py --out out/clean --size 128x72 --spp 256 --seeds 8 "hall=out/hall-scene/hall.gltf:40:--exposure 0"

Each scene is NAME=FILE:FRAME:OPTIONS OF RENDER; --exposure must be among them. Frames of --seeds seeds with --spp paths are
rendered, and means of disjoint groups of them (frames of 2, 3, 4, ... times the paths) compared in pairs. For each number of
paths: per cent of the pixels that differ visibly, mean JND, the pooled JND that 99 per cent of the pixels stay below, and the
paths with which that would be 1.1, P = 0.75, if it fell by the root of their number: what 1 per cent visible takes.

With --against FRAME, an OpenEXR frame of the same size made otherwise, that is compared with the mean of all seeds: as a viewer
sees it, and by the luminance of blocks of 8 x 8 pixels, where the noise of path tracing averages out and is stated.

One sample a pixel, so that all images show the same places. Needs Debian's openimageio-tools. Prints Markdown; images stay
in --out, and what is there is not rendered again.
"""
import argparse
import json
import math
import os
import pathlib
import shlex
import statistics
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
VISIBLE = 1.10  # pooled JND where P = 0.75 (docs/method.md)
BLOCK = 8
LUMINANCE = (0.2126, 0.7152, 0.0722)  # Rec.709


def output_of(command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def size_and_channels(image):
    info = output_of(["oiiotool", "--info", "-v", image])
    size = info.split(" : ", 1)[1].split(",", 1)[0]
    names = info.split("channel list:", 1)[1].split("\n", 1)[0]
    return tuple(int(n) for n in size.split("x")), [name.split()[0] for name in names.split(",")]


def pixels_of(image, channels):
    """For each pixel the values of the channels of these names."""
    at = [size_and_channels(image)[1].index(name) for name in channels]
    lines = output_of(["oiiotool", "--dumpdata", image]).splitlines()
    values = [line.rpartition(":")[2].split() for line in lines if line.lstrip().startswith("Pixel (")]
    return [[float(pixel[i]) for i in at] for pixel in values]


def luminance_of_blocks(image):
    (width, height), _ = size_and_channels(image)
    blocks = {}
    for i, rgb in enumerate(pixels_of(image, "RGB")):
        blocks.setdefault((i // width // BLOCK, i % width // BLOCK), []).append(sum(w * c for w, c in zip(LUMINANCE, rgb)))
    return {place: statistics.fmean(values) for place, values in blocks.items()}


class Scene:
    def __init__(self, options, name, file, frame, render_options):
        self.o, self.name, self.file, self.frame = options, name, file, int(frame)
        self.render_options = shlex.split(render_options)
        at = self.render_options.index("--exposure")
        self.exposure = self.render_options[at:at + 2]
        self.seconds = []

    def image(self, seed):
        folder = self.o.out / f"{self.name}-{seed}"
        image = folder / "frames" / f"{self.frame:06d}.exr"
        if not image.exists():
            before = os.times()
            output_of([self.o.promenade, "render", self.file, *self.render_options, "--integrator", "path", "--method", "full", "--frames",
                       f"{self.frame}-{self.frame}", "--size", self.o.size, "--supersample", 1, "--spp", self.o.spp, "--seed", seed,
                       "--threads", self.o.threads, "--quiet", "--out", folder])
            after = os.times()
            self.seconds.append(after.children_user + after.children_system - before.children_user - before.children_system)
        return image

    def mean(self, seeds):
        images = [self.image(seed) for seed in seeds]
        if len(images) == 1:
            return images[0]
        mean = self.o.out / f"{self.name}-{seeds[0]}-to-{seeds[-1]}.exr"
        sums = [word for image in images[1:] for word in (image, "--add")]
        output_of(["oiiotool", images[0], *sums, "--mulc", 1.0 / len(images), "-d", "float", "-o", mean])
        return mean

    def compared(self, test, reference):
        """Per cent visible, mean JND, and the pooled JND that 99 per cent of the pixels stay below."""
        maps = self.o.out / f"{self.name}-maps"
        frame = json.loads(output_of([self.o.promenade, "compare", test, reference, *self.exposure, "--json", "--quiet", "--maps",
                                      maps]))["frames"][0]
        pooled = sorted(values[0] for values in pixels_of(maps / "000000.exr", ["Jp"]))
        return frame["percent_visible"], frame["jnd_mean"], pooled[math.ceil(0.99 * len(pooled)) - 1]

    def report(self):
        seeds = list(range(1, self.o.seeds + 1))
        print(f"\n{self.name}, frame {self.frame}, {self.o.size}\n\n| paths | pairs | per cent visible | mean JND | 99 per cent below | "
              "paths for 1 per cent |\n" + "|---" * 6 + "|")
        for group in range(1, len(seeds) // 2 + 1):
            starts = range(0, len(seeds) - 2 * group + 1, 2 * group)
            pairs = [self.compared(self.mean(seeds[i:i + group]), self.mean(seeds[i + group:i + 2 * group])) for i in starts]
            visible, jnd, most = (statistics.fmean(column) for column in zip(*pairs))
            paths = group * self.o.spp
            print(f"| {paths} | {len(pairs)} | {visible:.1f} | {jnd:.2f} | {most:.2f} | {paths * (most / VISIBLE) ** 2:.0f} |", flush=True)
        if self.seconds:
            print(f"\n{statistics.fmean(self.seconds):.1f} processor seconds for {self.o.spp} paths, start included")
        if self.o.against:
            self.report_against(seeds)

    def report_against(self, seeds):
        visible, jnd, _ = self.compared(self.o.against, self.mean(seeds))
        print(f"\n{self.o.against} against all {len(seeds) * self.o.spp} paths: {visible:.1f} per cent visible, mean {jnd:.2f} JND")
        of_seeds = [luminance_of_blocks(self.image(seed)) for seed in seeds]
        off, errors = {}, []
        for place, value in luminance_of_blocks(self.o.against).items():
            values = [blocks[place] for blocks in of_seeds]
            mean = statistics.fmean(values)
            if mean > 0.0:
                off[place] = value / mean - 1.0
                errors.append(statistics.stdev(values) / math.sqrt(len(seeds)) / mean)
        rms = [math.sqrt(statistics.fmean(x * x for x in values)) for values in (off.values(), errors)]
        low, high = min(off, key=off.get), max(off, key=off.get)
        print(f"blocks of {BLOCK} x {BLOCK}: mean {100 * statistics.fmean(off.values()):+.2f} per cent, rms {100 * rms[0]:.2f} (noise of the "
              f"paths: {100 * rms[1]:.2f}), {100 * off[low]:+.1f} at row {low[0]}, column {low[1]}, {100 * off[high]:+.1f} at row {high[0]}, column {high[1]}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--promenade", default=HERE.parent.parent / "build/release/src/app/promenade")
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--size", default="128x72")
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--seeds", type=int, default=8)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--against", type=pathlib.Path)
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for scene in options.scenes:
        name, _, rest = scene.partition("=")
        Scene(options, name, *rest.split(":", 2)).report()


if __name__ == "__main__":
    main()
