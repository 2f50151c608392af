#!/usr/bin/env bash
# Builds the program for this machine's best SIMD target alone, as `./run demo` does. Its images
# of all own scenes must be bit-identical to those of LANELIGHT with that target:
# one_target_test.sh CMAKE SOURCE CXX LANELIGHT
set -euo pipefail
cmake=$1 source=$2 cxx=$3 lanelight=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cmake" -S "$source" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_BUILD_TYPE=Release -DLANELIGHT_TARGETS=native >"$folder/log" 2>&1 &&
  "$cmake" --build "$folder/build" --target lanelight >"$folder/log" 2>&1 ||
  { tail -30 "$folder/log"; exit 1; }
alone=$folder/build/lanelight
target=$("$alone" info | sed -n 's/^target *//p')
[[ $("$alone" info | sed -n 's/^available *//p') == "$target" ]] ||
  { echo "FAILED: more than one target"; exit 1; }

cd "$source/scenes"
for scene in *.pbrt stiff/*.pbrt; do
  for program in "$alone" "$lanelight"; do
    "$program" render "$scene" -o "$folder/$(basename "$(dirname "$program")").exr" \
      --resolution 93x71 --spp 8 --simd "$target" --quiet
  done
  # Attributes differ (time, commit); pixels must not.
  "$lanelight" compare "$folder/build.exr" "$folder/$(basename "$(dirname "$lanelight")").exr" \
    --max-relmse 0 >"$folder/log" || { cat "$folder/log"; echo "FAILED: $scene"; exit 1; }
done
