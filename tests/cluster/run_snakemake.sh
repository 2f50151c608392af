#!/usr/bin/env bash
# docs/cluster/Snakefile: run_snakemake.sh LANELIGHT. A job is killed and tried again, then
# Snakemake itself is killed, and the same command goes on.
set -uo pipefail
# shellcheck source=tests/cluster/common.sh
. "$(dirname "${BASH_SOURCE[0]}")/common.sh"
needs snakemake bc python3
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
export XDG_CACHE_HOME=$folder/cache
flags=(--resolution 96x96 --spp "$(samples_for 12)")
make=(snakemake --snakefile "$scripts/Snakefile" --cores 2 --retries 3 --rerun-incomplete
  --config "scene=$scene" parts=4 out=out "flags=${flags[*]} --every 0.2")

say "starts: 4 parts, 2 at a time, ${flags[*]}"
"${make[@]}" 2>first.log &
running=$!
wait_for 120 test -e out/part-2.kept || fail "no state of part 2"
process=$(render_process out/part-2.kept) || fail "part 2 runs no more"
kill -KILL "$process" && say "killed process $process of part 2"
retried() { grep -qs 'Trying to restart job' first.log; }
wait_for 120 retried || fail "Snakemake has not tried again"
wait_for 300 test -e out/part-1.state || fail "part 1 is not done"
kill -KILL "$running"
wait "$running" 2>/dev/null
say "killed Snakemake: $(ls out | xargs)"
# Renders that have lost their Snakemake go on to their ends. (A killed one's lock file may
# be there, and means nothing.)
nobody_renders() {
  local i
  for i in 1 2 3 4; do render_process "out/part-$i.kept" >/dev/null && return 1; done
  return 0
}
wait_for 600 nobody_renders || fail "renders never end"

"${make[@]}" 2>second.log && fail "went on although Snakemake's folder was locked"
grep -q 'unlock' second.log || fail "no word of --unlock: $(tail -n 5 second.log)"
"${make[@]}" --unlock 2>>second.log || fail "not unlocked"
"${make[@]}" 2>third.log || { fail "exit code $?"; tail -n 20 third.log; }
say "the same command again: $(grep -c '^rule part' third.log) parts gone on with"
same_as_whole out/image.exr "${flags[@]}"
exit "$failed"
