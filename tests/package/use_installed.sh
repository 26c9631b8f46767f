#!/usr/bin/env bash
# use_installed.sh BUILD EXAMPLE COMPILER SANITIZERS: exit status 0 if the example finds, links and runs the installed metric.
set -euo pipefail
build=$1 example=$2 compiler=$3 sanitizers=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cmake --install "$build" --component aqm --prefix "$folder/installed" > /dev/null
mv "$folder/installed" "$folder/moved"  # a package must not know where it was put

configure() { # source, build folder, further options
  cmake -S "$1" -B "$2" -DCMAKE_PREFIX_PATH="$folder/moved" -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release \
    ${sanitizers:+-DCMAKE_CXX_FLAGS=-fsanitize=$sanitizers} "${@:3}"
}
configure "$example" "$folder/build"
cmake --build "$folder/build"
"$folder/build/grating" | tee "$folder/seen"

fail() { echo "$*" >&2; exit 1; }
[ "$(wc -l < "$folder/seen")" -eq 5 ] || fail "expected five speeds"
grep -q '^   1 deg/s: visible on 100.0%' "$folder/seen" || fail "a grating of 4 cycles and 2% must be seen at 1 degree a second"
grep -q '^  80 deg/s: visible on   0.0%' "$folder/seen" || fail "... and not at 80"
if ldd "$folder/build/grating" | grep -iE 'embree|gltf|OpenImageIO|OpenEXR|avcodec'; then fail "the metric pulls in a renderer's libraries"; fi
if [ -e "$folder/moved/bin" ]; then fail "component aqm holds a program"; fi

# A component that does not exist is refused by name.
mkdir "$folder/wrong"
printf 'cmake_minimum_required(VERSION 3.25)\nproject(Wrong LANGUAGES CXX)\nfind_package(Promenade REQUIRED COMPONENTS renderer)\n' \
  > "$folder/wrong/CMakeLists.txt"
if configure "$folder/wrong" "$folder/wrong-build" > "$folder/said" 2>&1; then fail "component 'renderer' was found"; fi
grep -q "no component 'renderer'" "$folder/said" || fail "the error does not name the component: $(cat "$folder/said")"
