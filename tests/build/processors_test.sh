#!/usr/bin/env bash
# The program on processors other than this one: processors_test.sh LANELIGHT SCENE. QEMU
# plays them: Haswell (2013) has AVX2, Westmere (2010) SSE4, core2duo (2006) neither; it has
# no AVX-512 to play. Of AVX2 only the choice is tested: QEMU 7.2 ends in a segmentation
# fault in code that real processors run.
set -euo pipefail
lanelight=$1 scene=$2
command -v qemu-x86_64 >/dev/null || { echo "skipped: no qemu-x86_64 here (qemu-user)"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { cat "$folder/log"; echo "FAILED: $*"; exit 1; }

# What this program has, as far as this machine runs it.
available=$("$lanelight" info | sed -n 's/^available *//p')

# on CPU ARGUMENTS: runs the program there; its exit code in $code.
on() {
  code=0
  qemu-x86_64 -cpu "$1" "$lanelight" "${@:2}" >"$folder/log" 2>/dev/null || code=$?
}

render() { echo render "$scene" --spp 1 --resolution 24x20 --threads 1 --quiet; }

# expect CPU BEST TARGET: it chooses BEST and renders with TARGET, with the bits of this
# machine; a program that has none of these says what it needs.
expect() {
  if [[ ", $available," != *", $2,"* ]]; then
    # shellcheck disable=SC2046
    qemu-x86_64 -cpu "$1" "$lanelight" $(render) -o "$folder/there.exr" \
      >"$folder/log" 2>&1 && fail "$1 renders without its targets"
    grep -q "runs none of the SIMD targets" "$folder/log" || fail "$1: says not what it needs"
    grep -q "LANELIGHT_TARGETS=EMU128" "$folder/log" || fail "$1: says not what would run"
    return
  fi
  on "$1" info
  [[ $(sed -n 's/^target *//p' "$folder/log") == "$2" ]] || fail "$1 does not choose $2"
  # shellcheck disable=SC2046
  on "$1" $(render) -o "$folder/there.exr" --simd "$3"
  [[ $code -eq 0 ]] || fail "$1: exit code $code with $3"
  # shellcheck disable=SC2046
  "$lanelight" $(render) -o "$folder/here.exr" --simd "$3" 2>/dev/null
  "$lanelight" compare "$folder/there.exr" "$folder/here.exr" --max-relmse 0 >"$folder/log" ||
    fail "$1 has other bits than this machine with $3"
}

if [[ ", $available," == *", SSE4,"* ]]; then expect Haswell AVX2 SSE4; fi
expect Westmere SSE4 SSE4
expect core2duo EMU128 EMU128
