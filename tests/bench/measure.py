#!/usr/bin/env python3
"""Measures what image-based rendering saves and what a viewer sees of it, for docs/results.md.

For every scene: are keyframes clean (two renders of one frame with different seeds), a full render, an image-based
render, and the comparison of the two. Prints a Markdown table and keeps all outputs and JSON files in --out.

    tests/bench/measure.py --promenade build/release/src/app/promenade --out out/results \
        hall=out/hall-scene/hall.gltf:64 sponza=../shared/scenes/sponza-256/Sponza_walk.gltf:64:--sky

Each scene is NAME=FILE:SPP[:FURTHER OPTIONS OF RENDER].
"""
import argparse
import json
import pathlib
import shlex
import subprocess
import sys


def run(command, log, output=None):
    """Runs a command; what it says goes to `log`, its results to `output` where that is given."""
    with open(log, "w") as messages, open(output or log, "a" if output is None else "w") as results:
        status = subprocess.run(list(map(str, command)), stdout=results, stderr=messages).returncode
    if status != 0:
        sys.exit(f"{shlex.join(map(str, command))}\nended with status {status}; see {log}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--promenade", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--size", default="320x180")
    parser.add_argument("--supersample", default="2")
    parser.add_argument("--frames", default="0-49")
    parser.add_argument("--clean-frame", default="25")
    parser.add_argument("--ibr-options", default="", help="further options of the image-based render alone")
    parser.add_argument("--steps", default="clean,full,ibr,compare")
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    steps = options.steps.split(",")

    header = ("scene", "paths a sample", "clean: % visible", "keyframes", "traced_fraction", "seconds ibr", "seconds full",
              "speedup", "% visible mean", "% visible worst (frame)", "peak memory MB")
    rows = []
    for scene in options.scenes:
        name, rest = scene.split("=", 1)
        parts = rest.split(":", 2)
        file, spp = parts[0], parts[1]
        further = shlex.split(parts[2]) if len(parts) > 2 else []

        def render(folder, *arguments):
            command = [options.promenade, "render", file, "--out", options.out / folder, "--size", options.size,
                       "--supersample", options.supersample, "--spp", spp, "--overwrite", *further, *arguments]
            run(command, options.out / f"{folder}.log")

        def compare(test, reference, result):
            exposure = json.loads((options.out / reference / "report.json").read_text())["job"]["exposure_ev"]
            run([options.promenade, "compare", options.out / test / "frames", options.out / reference / "frames",
                 "--exposure", exposure, "--json"], options.out / f"{result}.log", options.out / result)

        if "clean" in steps:
            frame = f"{options.clean_frame}-{options.clean_frame}"
            render(f"{name}-seed1", "--method", "full", "--frames", frame, "--seed", "1")
            render(f"{name}-seed2", "--method", "full", "--frames", frame, "--seed", "2")
            compare(f"{name}-seed1", f"{name}-seed2", f"{name}-clean.json")
        if "full" in steps:
            render(f"{name}-full", "--method", "full", "--frames", options.frames)
        if "ibr" in steps:
            render(f"{name}-ibr", "--frames", options.frames, *shlex.split(options.ibr_options))
        if "compare" in steps:
            compare(f"{name}-ibr", f"{name}-full", f"{name}-compare.json")

        def read(path):
            return json.loads((options.out / path).read_text())

        if not {"compare"} & set(steps):
            continue
        ibr, full = read(f"{name}-ibr/report.json")["totals"], read(f"{name}-full/report.json")["totals"]
        seen, clean = read(f"{name}-compare.json"), read(f"{name}-clean.json")
        rows.append((name, spp, f"{clean['percent_visible_mean']:.2f}", f"{ibr['keyframes']} of {ibr['frames']}",
                     f"{ibr['traced_fraction']:.3f}", f"{ibr['seconds_wall']:.0f}", f"{full['seconds_wall']:.0f}",
                     f"{full['seconds_wall'] / ibr['seconds_wall']:.2f}", f"{seen['percent_visible_mean']:.2f}",
                     f"{seen['percent_visible_worst']:.2f} ({seen['worst_frame']})",
                     f"{ibr['peak_rss_bytes'] / 1e6:.0f}"))
        table = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
        table += ["| " + " | ".join(row) + " |" for row in rows]
        (options.out / "table.md").write_text("\n".join(table) + "\n")
        print("\n".join(table), flush=True)


if __name__ == "__main__":
    main()
