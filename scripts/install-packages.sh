#!/usr/bin/env bash
# Installs what Promenade is built from on Debian 12. Does nothing, quickly, where all of it is there.
set -euo pipefail

# (openimageio-tools: the CMake files of libopenimageio-dev insist that its programs are there.)
packages=(
  g++ cmake ninja-build pkg-config dpkg-dev
  libembree-dev libopenexr-dev libopenimageio-dev libopencolorio-dev openimageio-tools libtinygltf-dev libstb-dev libglm-dev
  libavcodec-dev libavformat-dev libavutil-dev libswscale-dev
  libfftw3-dev libhwy-dev libtbb-dev libcli11-dev libspdlog-dev nlohmann-json3-dev libjs-chart.js
  libgtest-dev libgmock-dev libbenchmark-dev
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "Please run as root, or install sudo: packages are missing: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${as_root[@]}" apt-get update -q
"${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
