# shellcheck shell=bash disable=SC2034,SC2154
# What the tests of docs/cluster/ share; sourced with the program as first argument.
export LC_ALL=C
lanelight=$(readlink -f "$1")
root=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
scripts=$root/docs/cluster scene=$root/scenes/cornell-box.pbrt
folder=$(mktemp -d -t lanelight-cluster-XXXXXX)
failed=0
export PATH=$folder/bin:$PATH:/usr/sbin
mkdir "$folder/bin"
ln -s "$lanelight" "$folder/bin/lanelight"

fail() { echo "FAILED: $*"; failed=1; }
say() { printf '%6.1f s  %s\n' "$(bc <<<"$EPOCHREALTIME - $began")" "$*"; }
began=$EPOCHREALTIME

# needs PROGRAM...: skips the test where one is not installed.
needs() {
  local program
  for program; do
    command -v "$program" >/dev/null || { echo "skipped: no $program here"; exit 77; }
  done
}

# wait_for SECONDS COMMAND...: until it succeeds; false if it never does.
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [[ $SECONDS -lt $end ]] || return 1
    sleep 0.1
  done
}

# render_process STATE: the process that keeps it, if one does.
render_process() {
  local note
  note=$(sed -n 's/^process \([0-9]*\) .*/\1/p' "$1.lock" 2>/dev/null)
  [[ -n $note && -d /proc/$note ]] && echo "$note"
}

# samples_for SECONDS: of which each of 4 parts of a 96x96 image takes about so long here.
samples_for() {
  local start=$EPOCHREALTIME
  lanelight render "$scene" --quiet --resolution 96x96 --spp 512 --threads 1 \
    -o "$folder/timed.exr" 2>/dev/null
  bc <<<"n = 2048 * $1 / ($EPOCHREALTIME - $start); n - n % 64 + 64"
}

# same_as_whole IMAGE FLAGS...: its pixels are those of one render with these flags.
same_as_whole() {
  local image=$1
  shift
  lanelight render "$scene" --quiet "$@" -o "$folder/whole.exr" || fail "the whole render"
  if PYTHONPATH=$root/tests/failures python3 - "$image" "$folder/whole.exr" <<'PYTHON'
import pathlib
import sys
from harness import pixels
sys.exit(pixels(pathlib.Path(sys.argv[1])) != pixels(pathlib.Path(sys.argv[2])))
PYTHON
  then
    say "the image has the bits of an undivided render"
  else
    fail "$image differs from an undivided render"
  fi
}
