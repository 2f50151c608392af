#!/usr/bin/env bash
# docs/cluster/parallel.sh: run_parallel.sh LANELIGHT. A job is killed, then everything is
# stopped by SIGTERM, and the same command goes on.
set -uo pipefail
# shellcheck source=tests/cluster/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs parallel bc python3
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
flags=(--resolution 96x96 --spp "$(samples_for 12)")
render=("$scripts/parallel.sh" 4 "$scene" out "${flags[@]}" --threads 1 --every 0.2)
export JOBS=2

say "starts: 4 parts, 2 at a time, ${flags[*]}"
setsid "${render[@]}" 2>first.log &
running=$!
wait_for 120 test -e out/part-2.state || fail "no state of part 2"
process=$(render_process out/part-2.state) || fail "part 2 runs no more"
kill -KILL "$process" && say "killed process $process of part 2"
wait_for 300 test -e out/part-3.state || fail "no state of part 3"
# Of the script's own process group, which setsid has made.
pkill -TERM -g "$running" parallel
wait "$running"
say "stopped by SIGTERM: exit code $?"
[[ ! -e out/image.exr ]] || fail "an image of parts that are not done"
for i in 1 2 3 4; do
  render_process "out/part-$i.state" >/dev/null && fail "part $i still runs"
done

"${render[@]}" 2>second.log || { fail "exit code $?"; cat second.log; }
say "the same command again: $(cut -f 7-8 out/parts.log | tail -n +2 | sort | uniq -c |
  awk '{print $1 " with exit code " $2 ", signal " $3}' | paste -sd ';')"
same_as_whole out/image.exr "${flags[@]}"
exit "$failed"
