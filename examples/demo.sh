#!/usr/bin/env bash
# Renders the built-in exhibition hall to a video and a report: installs packages, builds, makes the scene, walks through it.
# Takes about 14 minutes on two idle cores (docs/results.md). Run again, it goes on where it was stopped.
set -euo pipefail
cd "$(dirname "$0")/.."

if [ $# -gt 0 ]; then
  echo "usage: examples/demo.sh" >&2
  exit 2
fi

started=$SECONDS
step() { printf '\n== %s (%d s)\n' "$*" $((SECONDS - started)); }

step "Packages"
scripts/install-packages.sh

step "Building into build/release"
cmake --preset release > /dev/null
cmake --build --preset release --target promenade make_hall

step "Making the hall in out/hall-scene"
mkdir -p out
build/release/examples/make_hall out/hall-scene

step "Rendering the walk to out/hall: 200 frames of 640x360"
render() {
  build/release/src/app/promenade render out/hall-scene/hall.gltf --out out/hall --size 640x360 --supersample 2 \
    --spp 8 --exposure 0 --maps "$@"
}
status=0
render || status=$?
if [ "$status" -eq 2 ]; then  # out/hall holds the frames of another version of the program or of the scene
  render --overwrite
elif [ "$status" -ne 0 ]; then
  echo "The rendering stopped before its end; run examples/demo.sh again to go on." >&2
  exit "$status"
fi

step "Done"
echo "video    out/hall/walkthrough.mp4"
echo "frames   out/hall/frames/000000.exr and on"
echo "report   out/hall/report.html (and report.json)"
