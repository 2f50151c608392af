#!/usr/bin/env bash
# What a build asks of the compiler for one SIMD target: targets_test.sh CMAKE SOURCE CXX
# LANELIGHT. No idea of the compiler's about this processor (-march, which current ones
# refuse on some), no -Werror; the target that LANELIGHT finds best itself, or one that is
# named; and what is said of one that is not there.
set -euo pipefail
cmake=$1 source=$2 cxx=$3 lanelight=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

# configure TARGETS: into $folder/build, anew, with what it says in $folder/log.
configure() {
  "$cmake" -S "$source" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER="$cxx" \
    -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DLANELIGHT_TARGETS="$1" >"$folder/log" 2>&1
}

# expect_options TARGET: all of the last build, and of its kernels.
expect_options() {
  local commands=$folder/build/compile_commands.json
  ! grep -qE -e '-m(arch|cpu|tune)=' "$commands" || fail "$1: -march, -mcpu or -mtune"
  ! grep -q -e '-Werror' "$commands" || fail "$1: -Werror"
  grep -q "LANELIGHT_TARGETS=(HWY_$1)" "$commands" || fail "kernels are not for $1 alone"
  ! grep -o 'LANELIGHT_TARGETS=([^)]*)' "$commands" | grep -qv "(HWY_$1)" ||
    fail "kernels of another target than $1"
}

configure native || { cat "$folder/log"; fail "native"; }
# The best of those that this program was built for; more may be there than that.
best=$(sed -n 's/.*SIMD target of this machine: //p' "$folder/log")
expect_options "$best"
available=$("$lanelight" info | sed -n 's/^available *//p')
[[ ", $available," == ", $best,"* || $available != *,* ]] ||
  fail "cmake finds $best, the program $available"

for target in SSE4 EMU128; do
  [[ $(uname -m) == x86_64 || $target == EMU128 ]] || continue
  if configure $target; then
    expect_options $target
  else
    [[ $target == EMU128 ]] && grep -q 'g++ 12.3' "$folder/log" || { cat "$folder/log"; fail $target; }
  fi
done
! configure AVX9 || fail "AVX9 is no target"
grep -q "'AVX9' is none of" "$folder/log" || { cat "$folder/log"; fail "says not what is legal"; }
