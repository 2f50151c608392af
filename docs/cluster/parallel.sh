#!/usr/bin/env bash
# The parts of a render as jobs of GNU parallel, and the image of them:
#
#   JOBS=4 parallel.sh 16 scene.pbrt out --spp 4096
#
# After a failure, an interruption or a kill the same command goes on: parts that are done
# stay done, others go on from their states. $PARALLEL holds further options of parallel;
# "--sshloginfile hosts --workdir ." has the parts rendered on other machines, which need
# to see the same folder under the same path.
set -euo pipefail
parts=$1 scene=$2 folder=$3
shift 3

mkdir -p "$folder"
# On SIGTERM parallel asks the renders to stop, and gives them two minutes for their states.
parallel --quote --will-cite --jobs "${JOBS:-1}" --retries 3 --termseq TERM,120000,KILL \
  --joblog "$folder/parts.log" --resume-failed \
  lanelight render "$scene" --quiet "$@" --part "{}/$parts" \
  --checkpoint "$folder/part-{}.state" --resume ::: $(seq "$parts")

states=()
for ((i = 1; i <= parts; ++i)); do states+=("$folder/part-$i.state"); done
lanelight merge "${states[@]}" -o "$folder/image.exr" --json "$folder/image.json"
