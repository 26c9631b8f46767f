#!/usr/bin/env bash
# deb_test.sh BUILD SCENE: makes the Debian package, looks at it, and runs the program that is in it.
set -euo pipefail
build=$1 scene=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$*" >&2; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B "$folder/made" > "$folder/said" 2>&1 || fail "cpack: $(cat "$folder/said")"
deb=$(echo "$folder"/made/*.deb)
[ -f "$deb" ] || fail "cpack made no .deb: $(cat "$folder/said")"
dpkg-deb --info "$deb"

# The libraries that it needs, as dpkg-shlibdeps found them; no package for building.
depends=$(dpkg-deb --field "$deb" Depends)
for library in libembree libopenimageio libopencolorio libavcodec libfftw3 libtbb libc6; do
  case "$depends" in *"$library"*) ;; *) fail "the package does not depend on $library: $depends" ;; esac
done
case "$depends" in *-dev*) fail "the package depends on a -dev package: $depends" ;; esac

dpkg-deb --extract "$deb" "$folder/root"
for file in bin/promenade share/man/man1/promenade.1.gz share/man/man1/promenade-render.1.gz \
            share/bash-completion/completions/promenade share/zsh/vendor-completions/_promenade \
            share/doc/promenade/copyright share/doc/promenade/changelog.gz; do
  [ -f "$folder/root/usr/$file" ] || fail "the package has no usr/$file"
done
[ ! -e "$folder/root/usr/include" ] || fail "the package holds headers"
[ -z "$(objdump -p "$folder/root/usr/bin/promenade" | grep -E 'RPATH|RUNPATH')" ] || fail "the program has a path to the build"
"$folder/root/usr/bin/promenade" --version
"$folder/root/usr/bin/promenade" info "$scene"

if command -v lintian > /dev/null; then
  lintian --fail-on error --allow-root --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$deb" || fail "lintian finds errors"
else
  echo "lintian is not installed (apt-get install lintian): the package was not looked over"
fi
