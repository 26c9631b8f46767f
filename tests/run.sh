#!/usr/bin/env bash
# Installs packages, builds and runs every test. --sanitizers also builds with AddressSanitizer and
# UndefinedBehaviorSanitizer and runs the tests again under them.
set -euo pipefail
cd "$(dirname "$0")/.."

sanitizers=no
for argument in "$@"; do
  case "$argument" in
    --sanitizers) sanitizers=yes ;;
    *) echo "usage: tests/run.sh [--sanitizers]" >&2; exit 2 ;;
  esac
done

scripts/install-packages.sh

run() { # preset, further ctest arguments
  local preset=$1
  shift
  cmake --preset "$preset"
  cmake --build --preset "$preset"
  ctest --preset "$preset" "$@"
}

run release
if [ "$sanitizers" = yes ]; then
  # Slow tests measure speed or quality; what sanitizers look for, the others exercise too.
  ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 run asan -LE slow
fi
