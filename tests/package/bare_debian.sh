#!/usr/bin/env bash
# bare_debian.sh BUILD [PACKAGE.deb]: installs the Debian package of a whole build in a Debian 12 that has nothing but what
# every Debian has, uses it as a user would, and removes it. Needs root, debootstrap and a mirror ($DEBIAN_MIRROR, about
# 300 MB), so it is no part of the test suite; $BARE_DEBIAN may name a folder where `debootstrap --variant=minbase` has made
# one before, which is copied. Exit status 77: skipped, with the reason.
set -euo pipefail
skip() { echo "SKIPPED: $*" >&2; exit 77; }
fail() { echo "$*" >&2; exit 1; }

[ $# -ge 1 ] || fail "usage: bare_debian.sh BUILD [PACKAGE.deb]"
build=$1 deb=${2:-}
here=$(cd "$(dirname "$0")" && pwd)
mirror=${DEBIAN_MIRROR:-http://deb.debian.org/debian}
[ "$(id -u)" -eq 0 ] || skip "a chroot needs root"
[ -n "${BARE_DEBIAN:-}" ] || command -v debootstrap > /dev/null || skip "debootstrap is not installed (Debian: apt-get install debootstrap)"

folder=$(mktemp -d)
root=$folder/root
leave() { mountpoint -q "$root/proc" && umount "$root/proc"; rm -rf --one-file-system "$folder"; }
trap leave EXIT

if [ -z "$deb" ]; then
  cpack --config "$build/CPackConfig.cmake" -B "$folder/made" > "$folder/said" 2>&1 || fail "cpack: $(cat "$folder/said")"
  deb=$(echo "$folder"/made/*.deb)
fi
[ -f "$deb" ] || fail "there is no package: $deb"

if [ -n "${BARE_DEBIAN:-}" ]; then
  cp -a "$BARE_DEBIAN" "$root"
else
  debootstrap --variant=minbase bookworm "$root" "$mirror" > "$folder/said" 2>&1 ||
    skip "debootstrap cannot get Debian 12 from $mirror: $(tail -3 "$folder/said")"
fi
mount -t proc proc "$root/proc" || skip "a chroot cannot have /proc here"
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
             ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} "$@"; }

inside apt-get update -q
megabytes() { inside apt-get clean && du -smx "$root" | cut -f1; }
before=$(megabytes)
cp "$deb" "$root/root/promenade.deb"
inside apt-get install -y -q --no-install-recommends /root/promenade.deb
packages=$(inside dpkg-query -W | wc -l)
echo "bare Debian 12: $before MB; with the package and what it needs: $(megabytes) MB, $packages packages"

inside promenade --version
cp "$here/triangle.gltf" "$root/root/"
inside promenade info /root/triangle.gltf
cat > "$root/root/walk.json" << 'JSON'
{ "fps": 25, "keys": [ { "time": 0, "eye": [0,0,3], "target": [0,0,0], "fov": 40 },
                       { "time": 0.08, "eye": [0.1,0,3], "target": [0.1,0,0] } ] }
JSON
inside promenade render /root/triangle.gltf --path /root/walk.json --size 64x36 --spp 4 --out /root/walk --quiet
for file in frames/000000.exr frames/000001.exr walkthrough.mp4 report.json report.html; do
  [ -s "$root/root/walk/$file" ] || fail "the render left no $file"
done
inside promenade compare /root/walk /root/walk --fail-above 0
inside promenade encode /root/walk /root/walk.webm

# Man pages and completion, by the programs that Debian has for them.
inside apt-get install -y -q --no-install-recommends man-db bash-completion > /dev/null
inside man promenade-render | grep -q -- --supersample || fail "there is no man page of promenade render"
inside bash -c '. /usr/share/bash-completion/bash_completion; _completion_loader promenade; complete -p promenade' ||
  fail "bash does not complete promenade"
[ -f "$root/usr/share/zsh/vendor-completions/_promenade" ] || fail "there is no completion for zsh"

inside apt-get purge -y -q promenade > /dev/null
left=$(find "$root/usr" -name '*promenade*')
[ -z "$left" ] || fail "removing the package leaves $left"
echo "bare Debian 12: installed, used and removed"
