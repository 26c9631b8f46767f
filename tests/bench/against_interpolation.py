#!/usr/bin/env python3
"""What else makes a video of keyframes (docs/results.md): FFmpeg's motion-compensated interpolation (minterpolate) and
plain blending of neighbouring keyframes, beside image-based rendering, all against the frames traced whole.

    tests/bench/against_interpolation.py --promenade build/release/src/app/promenade --out out/interpolation \\
        hall=out/hall-ibr:out/hall-full sponza=out/sponza-ibr:out/sponza-full

Each scene is NAME=IMAGE_BASED:FULL, two outputs of `promenade render` of the same frames. Needs Debian's package ffmpeg.
The interpolators get every SPACING-th frame of FULL (--spacing; all of them evenly spaced, which is what they are made
for) and are asked for the frames between. What the display shows is compared, with the motion that FULL's frames know. Prints
Markdown; videos and results stay in --out. The frames after the last multiple of the largest spacing are left out.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys

INTERPOLATORS = {
    "minterpolate": "minterpolate=fps={fps}:mi_mode=mci:mc_mode=aobmc:me_mode=bidir:vsbmc=1:scd=none",
    "blending": "minterpolate=fps={fps}:mi_mode=blend:scd=none",
}


def run(command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with status {done.returncode}\n{done.stderr}")
    return done.stdout


def link_frames(source, folder, count):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for frame in sorted((source / "frames").glob("*.exr"))[:count]:
        (folder / frame.name).symlink_to(frame.resolve())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--promenade", required=True)
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--spacing", default="16,4", help="of the interpolators' keyframes, frames; several with commas")
    parser.add_argument("scenes", nargs="+")
    options = parser.parse_args()
    spacings = [int(spacing) for spacing in options.spacing.split(",")]
    if not shutil.which("ffmpeg"):
        sys.exit("ffmpeg: not found; apt-get install ffmpeg")

    print("| scene | made by | keyframes | per cent visible, mean | ... worst | PSNR, dB, mean | ... worst |")
    print("|---|---|---|---|---|---|---|")
    for scene in options.scenes:
        name, _, folders = scene.partition("=")
        image_based, _, full = (pathlib.Path(part) for part in folders.partition(":"))
        job = json.loads((image_based / "report.json").read_text())
        exposure = job["job"]["exposure_ev"]
        fps = job["job"]["fps"]
        largest = max(spacings)
        count = (len(job["frames"]) - 1) // largest * largest + 1
        folder = options.out / name
        folder.mkdir(parents=True, exist_ok=True)
        link_frames(full, folder / "full", count)
        link_frames(image_based, folder / "image-based", count)
        run([options.promenade, "encode", full, folder / "full.mkv", "--exposure", exposure])

        def compare(label, test, keyframes):
            def by(metric):
                result = run([options.promenade, "compare", test, folder / "full", "--exposure", exposure, "--metric",
                              metric, "--json"])
                (folder / f"{label}-{metric}.json").write_text(result)
                return json.loads(result)

            seen = by("aqm")
            ratios = [frame["psnr"] for frame in by("psnr")["frames"] if frame["psnr"] is not None]  # null: equal
            print(f"| {name} | {label} | {keyframes} of {count} | {seen['percent_visible_mean']:.2f} "
                  f"| {seen['percent_visible_worst']:.1f} | {sum(ratios) / len(ratios):.1f} | {min(ratios):.1f} |", flush=True)

        ours = sum(frame["kind"] == "keyframe" for frame in job["frames"][:count])
        compare("Promenade", folder / "image-based", ours)
        for spacing in spacings:
            for label, interpolator in INTERPOLATORS.items():
                video = folder / f"{label}-{spacing}.mkv"
                # The filter drops what follows the last but one frame, so the last is repeated.
                run(["ffmpeg", "-v", "error", "-y", "-i", folder / "full.mkv", "-vf",
                     f"select='not(mod(n\\,{spacing}))',setpts=N*{spacing}/({fps}*TB),fps={fps}/{spacing},"
                     f"tpad=stop_mode=clone:stop=2,{interpolator.format(fps=fps)},trim=end_frame={count}",
                     "-c:v", "ffv1", "-pix_fmt", "bgr0", video])
                compare(f"{label}, every {spacing}th frame", video, (count - 1) // spacing + 1)


if __name__ == "__main__":
    main()
