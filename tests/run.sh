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

run() { # preset
  cmake --preset "$1"
  cmake --build --preset "$1"
  ctest --preset "$1"
}

run release
# Without the tests labelled slow: what sanitizers look for, the others exercise too.
if [ "$sanitizers" = yes ]; then run asan; fi
