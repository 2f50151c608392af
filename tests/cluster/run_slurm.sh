#!/usr/bin/env bash
# docs/cluster/*.sbatch on a Slurm of this machine: run_slurm.sh LANELIGHT. A task is killed,
# all reach their time limit, the merge waits for all of it; the bits are those of a render
# that was never cut.
set -uo pipefail
# shellcheck source=tests/cluster/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs munged slurmctld slurmd sbatch bc python3
# shellcheck source=tests/cluster/slurm_cluster.sh
. "$root/tests/cluster/slurm_cluster.sh"
trap 'stop_slurm; rm -rf "$folder"' EXIT
start_slurm || { tail -n 20 "$cluster"/*.log; fail "Slurm did not start"; exit 1; }
say "Slurm $(sinfo --version | cut -d ' ' -f 2) runs"
cd "$folder" || exit 1

# submit OUT FLAGS_OF_SBATCH... -- FLAGS_OF_RENDER...: sets $array and $merge.
submit() {
  local out=$1 sbatch_flags=() id
  shift
  while [[ $1 != -- ]]; do sbatch_flags+=("$1"); shift; done
  shift
  id=$(sbatch --parsable --array=1-4 --cpus-per-task=1 --output="$out-%a.log" \
    "${sbatch_flags[@]}" "$scripts/render-array.sbatch" 4 "$scene" "$out" "$@") || return 1
  array=$id
  merge=$(sbatch --parsable --dependency="afterok:$array" --cpus-per-task=1 --time=10 \
    --output="$out-merge.log" "$scripts/merge.sbatch" 4 "$out") || return 1
}

restarts() { scontrol -o show job "$array" | grep -o 'Restarts=[0-9]*' | tr -dc '0-9\n'; }

finish() {
  if wait_for "$1" is_in_state "$merge" COMPLETED; then
    say "merged; restarts of the tasks: $(restarts | xargs)"
  else
    fail "the merge is $(state_of "$merge")"
    tail -n 5 "$2"-*.log
  fi
}

# One task is killed by SIGKILL in the middle.
flags=(--resolution 96x96 --spp "$(samples_for 12)")
say "each part of ${flags[*]} takes about 12 s, of the next render a minute"
submit killed --time=30 -- "${flags[@]}" --every 0.2 || fail "not submitted"
state=killed/part-2.state
wait_for 120 test -e "$state" || fail "no state of task 2"
process=$(render_process "$state") || fail "task 2 runs no more"
kill -KILL "$process" && say "killed process $process of task 2"
wait_for 60 grep -qs 'exit code 137' killed-2.log || fail "task 2 has not noticed"
is_in_state "$merge" PENDING || fail "the merge is $(state_of "$merge")"
finish 600 killed
[[ $(restarts | sort -n | tail -1) -eq 1 ]] || fail "restarts: $(restarts)"
same_as_whole killed/image.exr "${flags[@]}"

# The time limit of a minute, SIGTERM well before it: every task needs more than one turn.
flags=(--resolution 96x96 --spp "$(samples_for 60)")
submit limit --time=1 --signal=TERM@45 -- "${flags[@]}" || fail "not submitted"
wait_for 300 grep -qs 'exit code 6' limit-1.log || fail "no task came to its limit"
say "the first task came to its limit"
finish 1800 limit
[[ $(restarts | sort -n | tail -1) -ge 1 ]] || fail "nothing was requeued: $(restarts)"
same_as_whole limit/image.exr "${flags[@]}"

# A cancelled job stays cancelled, and its state is kept.
submit cancelled --time=30 -- "${flags[@]}" --every 0.2 || fail "not submitted"
wait_for 120 test -e cancelled/part-1.state || fail "no state of task 1"
scancel "$array"
wait_for 60 is_idle || fail "still busy after scancel"
sleep 10
is_idle || fail "a cancelled task came back"
states=$(scontrol -o show job "$array" | grep -o 'JobState=[A-Z]*' | sort | uniq)
[[ $states == JobState=CANCELLED ]] || fail "after scancel: $states"
test -e cancelled/part-1.state || fail "the state is lost"
say "cancelled, and stays so"
exit "$failed"
