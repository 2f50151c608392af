#!/usr/bin/env bash
# A little of everything under a sanitizer: short.sh LANELIGHT, a program built with one.
# Small images, several threads. Fails at the first report or unexpected exit code.
set -uo pipefail
lanelight=$(readlink -f "$1")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../scenes"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# Reports end the program with a code that it does not have itself. Other versions of
# llvm-symbolizer cannot read what clang 19 writes; addr2line comes with every compiler.
common=exitcode=99:external_symbolizer_path=$(command -v llvm-symbolizer-19 ||
  command -v addr2line)
export ASAN_OPTIONS=$common:strict_string_checks=1:detect_stack_use_after_return=1
export UBSAN_OPTIONS=$common:print_stacktrace=1
export TSAN_OPTIONS=$common:second_deadlock_stack=1:atexit_sleep_ms=50
runs=0

# expect CODES ARGUMENTS: runs lanelight; CODES is one exit code, or several in quotes.
expect() {
  local wanted=$1 code=0
  shift
  timeout 300 "$lanelight" "$@" >"$out/log" 2>&1 || code=$?
  check "$wanted" "$code" "$@"
}

# check WANTED CODE ARGUMENTS: fails if the codes differ, or the log has a report.
check() {
  local wanted=$1 code=$2
  shift 2
  if [[ " $wanted " != *" $code "* ]] || grep -qE 'Sanitizer|runtime error:' "$out/log"; then
    cat "$out/log"
    echo "FAILED (exit code $code, not $wanted): lanelight $*"
    exit 1
  fi
  runs=$((runs + 1))
  echo "  ok  lanelight ${*//$out\//}"
}

render() { expect 0 render "$@" -o "$out/image.exr" --threads 4 --quiet; }

# Every material, shape and light of the scenes here; odd sizes leave partial vectors, small
# wavefronts are refilled often.
for scene in *.pbrt stiff/*.pbrt; do
  render "$scene" --resolution 131x97 --spp 5 --wavefront 256
done

# Every kind of sample points, choice of directions, control variate, roulette.
for strategy in points=stratified,pairs=antithetic,directions=light \
  points=independent,light-selection=uniform \
  points=halton,roulette=constant \
  directions=bsdf,roulette=none directions=uniform,light-selection=power \
  control=regression,c=optimal; do
  render cornell-box.pbrt --resolution 81x61 --spp 16 --strategy "$strategy"
done
# Wavelengths where nothing in the scene asks for them, and a film that keeps them.
for scene in media cloud measured subsurface textured-layers image-lights; do
  render "$scene.pbrt" --resolution 41x33 --spp 3 --transport spectral
done
render cornell-box.pbrt --resolution 41x33 --spp 4 --transport spectral \
  --strategy control=regression
sed 's/^Film "rgb"/Film "spectral"/' prism.pbrt > "$out/spectra.pbrt"
render "$out/spectra.pbrt" --resolution 41x33 --spp 4
# Media with what else there is to paths.
render media.pbrt --resolution 40x30 --spp 4 --strategy light-paths=splats
render media.pbrt --resolution 40x30 --spp 4 --strategy roulette=adjoint,pairs=antithetic
# Path reuse: tiles that are cut off, all kinds of materials.
for layout in random compact; do
  render cornell-box.pbrt --resolution 81x61 --spp 5 --strategy "reuse=block:16:$layout"
done
for scene in patterns glass textured-layers relief; do
  render "$scene.pbrt" --resolution 41x33 --spp 3 --strategy reuse=block
done
render cornell-box.pbrt --resolution 41x33 --spp 4 \
  --strategy reuse=block,directions=mis
render cornell-box.pbrt --resolution 41x33 --spp 4 --strategy reuse=block,directions=uniform
# Paths that split into copies, after a pilot of their own.
render veach-mis.pbrt --resolution 81x61 --spp 16 --strategy roulette=adjoint
# Light subpaths.
for scene in cornell-box glass; do
  render "$scene.pbrt" --resolution 81x61 --spp 9 --strategy light-paths=splats:2
done
# Strategies with training.
render corridor.pbrt --resolution 81x61 --spp 40 --strategy roulette=adjoint
render veach-mis.pbrt --resolution 24x18 --spp 16 --strategy decide=pilot
render cornell-box.pbrt --resolution 81x61 --spp 16 --strategy light-points=solid-angle
render cornell-box.pbrt --resolution 81x61 --spp 16 --strategy light-points=projected
render many-lights.pbrt --resolution 81x61 --spp 8 --strategy light-candidates=resampled:3
expect 0 bench cornell-box --resolution 33x31 --spp 2 --threads 1,4 --time 10 --json "$out/bench.json"
# (10: the machine is busy.)
expect "0 10" bench cornell-box --resolution 33x31 --spp 2 --threads 1,4 --time 10 \
  --against "$out/bench.json" --tolerance 1 --html "$out/bench.html"

render glass.pbrt --resolution 64x48 --spp 4 --gbuffer camera --png --crop 3,5,50,40 --depth half \
  --json "$out/report.json" --build fast
render instances.pbrt --resolution 64x48 --spp 2
render many-lights.pbrt --resolution 40x30 --time 1 --strategy light-selection=tree
render cornell-box.pbrt --resolution 40x30 --target-relmse 0.5 --spp 4096
cp "$out/image.exr" "$out/other.exr"
render cornell-box.pbrt --resolution 40x30 --spp 4 --seed 2
expect 0 compare "$out/image.exr" "$out/other.exr"
expect 0 compare "$out/image.exr" "$out/image.exr" "$out/other.exr" --html "$out/c.html" \
  --png "$out/c.png"
expect 0 info "$out/image.exr"
expect 0 plan glass.pbrt
expect 0 profile cornell-box.pbrt --resolution 40x30 --spp 4 --trace "$out/trace.json" \
  --threads 4 --quiet
expect 0 study cornell-box.pbrt --out "$out/study" --resolution 24x18 --spp 4,8 \
  --strategies 'default;points=halton' --repetitions 3 --quiet
expect 0 plot "$out/study/study.json" --figure 8 -o "$out/plot.csv"
# States are written beside the render; parts, and what they are merged into.
render cornell-box.pbrt --resolution 40x30 --spp 256 --checkpoint "$out/whole.state" \
  --every 0.05 --watch "$out/watch.exr" --watch "$out/watch.png" --strategy control=regression
render cornell-box.pbrt --resolution 40x30 --spp 300 --resume "$out/whole.state" \
  --strategy control=regression
for part in 1 2; do
  expect 0 render cornell-box.pbrt --resolution 40x30 --spp 16 --quiet --part $part/2 \
    --checkpoint "$out/part-$part.state" --strategy roulette=adjoint
done
expect 0 merge "$out/part-2.state" "$out/part-1.state" -o "$out/image.exr" --quiet
expect 1 merge "$out/part-1.state" -o "$out/image.exr" --quiet
cat >"$out/sweep.toml" <<END
[grid]
scene = "$PWD/cornell-box.pbrt"
strategy = ["default", "points=halton", "roulette=throughput:{0.1, 0.5}"]
spp = [4, 16]
resolution = "24x18"
END
expect 0 sweep "$out/sweep.toml" --out "$out/sweep" --quiet
expect 1 plan ../tests/scene/broken/error-in-include.pbrt
expect 2 render --nonsense
expect 0 info
expect 0 completion zsh

# A page that comes, looks, and goes, and Ctrl-C.
code=0
timeout 300 ../tests/sanitize/live_client.py "$lanelight" cornell-box.pbrt \
  --resolution 64x48 --threads 4 >"$out/log" 2>&1 || code=$?
check 0 "$code" live cornell-box.pbrt, with a page

# Ctrl-C in the middle of a render: the image is written all the same.
code=0
timeout --foreground --preserve-status --signal INT 3 "$lanelight" render \
  cornell-box.pbrt --resolution 200x150 --spp 1000000 --threads 4 -o "$out/stopped.exr" \
  >"$out/log" 2>&1 || code=$?
grep -q stopping "$out/log" || { echo "FAILED: ended before Ctrl-C"; exit 1; }
check 0 "$code" render cornell-box.pbrt, with Ctrl-C
[[ -f $out/stopped.exr ]] || { echo "FAILED: no image after Ctrl-C"; exit 1; }
echo "$runs runs without a report"
