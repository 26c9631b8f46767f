#!/usr/bin/env python3
"""What the defaults of image-based rendering were chosen by (docs/method.md): traced_fraction against per cent visible, for
values of one option at a time, the others at their defaults.

    tests/bench/sweep.py --promenade build/release/src/app/promenade --out out/sweep \\
        hall=out/hall-scene/hall.gltf:--exposure 0 "kitchen=../shared/scenes/country-kitchen/kitchen_walk.gltf:--sky --exposure 2.5"

Each scene is NAME=FILE[:OPTIONS OF RENDER]; --exposure must be among them. Every run is held against one whose frames are
all traced, with the same light solution. sweep.csv grows as runs end, and what it has is not run again; then a
Markdown table and sweep.svg (Debian's gnuplot-nox; left out without it).
"""
import argparse
import csv
import json
import pathlib
import shlex
import shutil
import subprocess
import sys

FIELDS = ("scene", "option", "value", "keyframes", "frames", "traced_fraction", "visible_mean", "visible_worst", "seconds")


def run(command, log):
    with open(log, "w") as messages:
        done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=messages, text=True)
    if done.returncode != 0:
        sys.exit(f"{shlex.join(map(str, command))}\nended with status {done.returncode}; see {log}")
    return done.stdout


def plot(rows, options, out):
    if not shutil.which("gnuplot"):
        print("no sweep.svg: gnuplot not found (apt-get install gnuplot-nox)", file=sys.stderr)
        return
    script = [f"set terminal svg size {360 * len(options)},320 font 'sans-serif,11' background 'white'",
              f"set output '{out / 'sweep.svg'}'", f"set multiplot layout 1,{len(options)}", "set grid", "set key top right",
              "set xlabel 'traced fraction'", "set ylabel 'per cent visible, mean'", "set xrange [0:*]", "set yrange [0:*]"]
    scenes = list(dict.fromkeys(row["scene"] for row in rows))
    for option in options:
        curves = []
        for scene in scenes:
            data = "\\n".join(f"{row['traced_fraction']} {row['visible_mean']} {row['value']}"
                              for row in rows if row["scene"] == scene and row["option"] == option)
            name = f"${scene}_{option}".replace("-", "_")
            script.append(f"{name} << EOD\n{data}\nEOD".replace("\\n", "\n"))
            curves.append(f"{name} using 1:2 with linespoints pt 7 ps 0.5 title '{scene}'")
            curves.append(f"{name} using 1:2:3 with labels offset 0,0.6 font ',8' notitle")
        script += [f"set title '--{option}'", "plot " + ", ".join(curves)]
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--promenade", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--size", default="160x90")
    parser.add_argument("--frames", default="0-95")
    parser.add_argument("--spp", default="8")
    parser.add_argument("--vary", default="tolerance=0.3,1,3,10,30 spacing=8,16,32,64 footprint-limit=1.5,2.5,4,8",
                        help="OPTION=VALUES, apart by blanks; the values of each apart by commas")
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    table = options.out / "sweep.csv"
    rows = list(csv.DictReader(table.open())) if table.exists() else []
    vary = [(name, values.split(",")) for name, _, values in (part.partition("=") for part in options.vary.split())]

    for scene in options.scenes:
        name, _, rest = scene.partition("=")
        file, _, further = rest.partition(":")
        further = shlex.split(further)
        exposure = further[further.index("--exposure") + 1]
        light = options.out / f"{name}-light.bin"

        def render(folder, *arguments):
            run([options.promenade, "render", file, "--out", options.out / folder, "--size", options.size, "--frames",
                 options.frames, "--spp", options.spp, "--light-solution", light, "--overwrite", *further, *arguments],
                options.out / f"{folder}.log")

        full = f"{name}-full"
        if not (options.out / full / "report.json").exists():
            render(full, "--method", "full")
        for option, values in vary:
            for value in values:
                if any((row["scene"], row["option"], row["value"]) == (name, option, value) for row in rows):
                    continue
                folder = f"{name}-run"
                render(folder, f"--{option}", value)
                totals = json.loads((options.out / folder / "report.json").read_text())["totals"]
                seen = json.loads(run([options.promenade, "compare", options.out / folder / "frames",
                                       options.out / full / "frames", "--exposure", exposure, "--json"],
                                      options.out / f"{name}-compare.log"))
                rows.append(dict(zip(FIELDS, (
                    name, option, value, totals["keyframes"], totals["frames"], round(totals["traced_fraction"], 4),
                    round(seen["percent_visible_mean"], 3), round(seen["percent_visible_worst"], 2),
                    round(sum(totals["seconds"][part] for part in ("trace", "visibility", "warp", "metric")), 2)))))
                with table.open("w", newline="") as stream:
                    writer = csv.DictWriter(stream, FIELDS)
                    writer.writeheader()
                    writer.writerows(rows)

    print("| scene | option | keyframes | traced_fraction | per cent visible, mean | ... worst |\n|---|---|---|---|---|---|")
    for row in rows:
        print(f"| {row['scene']} | --{row['option']} {row['value']} | {row['keyframes']} of {row['frames']} "
              f"| {float(row['traced_fraction']):.3f} | {float(row['visible_mean']):.2f} | {float(row['visible_worst']):.1f} |")
    plot(rows, [option for option, _ in vary], options.out)


if __name__ == "__main__":
    main()
