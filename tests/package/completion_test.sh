#!/usr/bin/env bash
# completion_test.sh PROMENADE: what bash and, where it is installed, zsh offer. Exit status 77: only bash was tried.
set -euo pipefail
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir scenes
touch 'hall one.glb' walk.json
fail() { echo "$*" >&2; exit 1; }

eval "$("$program" completion bash)"
offered() { # words typed, the last to be completed
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _promenade 2> /dev/null
  printf '%s\n' "${COMPREPLY[@]}"
}
expect() { # wanted, words
  local wanted=$1 found
  shift
  found=$(offered "$@")
  [ "$found" = "$wanted" ] || fail "after '$*': expected '$wanted', found '$found'"
}
expect render promenade ren
expect --method promenade render --meth
expect $'ibr\nfull' promenade render a.glb --method ''
expect full promenade render a.glb --method f
expect 'hall one.glb' promenade render hall
expect scenes promenade render a.glb --out sc
expect --reference promenade report walk --ref

if ! command -v zsh > /dev/null; then
  echo "SKIPPED: zsh is not installed (apt-get install zsh): only bash's completion was tried"
  exit 77
fi
"$program" completion zsh > _promenade
zsh -n _promenade || fail "zsh cannot read its completion"
# In a terminal of its own, the tab key asks for what there is.
zsh -f > "$folder/said" 2>&1 <<EOF
zmodload zsh/zpty
zpty -b shell "TERM=dumb zsh -f -i"
zpty -w shell "PS1=; fpath=($folder \\\$fpath); autoload -Uz compinit; compinit -u -D; cd $folder; echo re''ady"
wait_for() { local line all=; repeat 600; do zpty -r -t shell line && all+=\$line; [[ \$all == *\$1* ]] && { print -r -- \$all; return 0; }; sleep 0.05; done; print -r -- \$all; return 1; }
wait_for ready || exit 1
zpty -w -n shell \$'promenade render a.glb --integrator walk\t'
wait_for walkthrough
EOF
grep -q walkthrough "$folder/said" || fail "zsh does not complete --integrator walk: $(cat "$folder/said")"
