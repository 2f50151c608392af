#!/usr/bin/env python3
"""Every test case of the binary is in exactly one ctest entry.

usage: cases_run_once.py BINARY SPECS

SPECS has one test specification per line, those of the ctest entries: [#FILE]~[slow] and
[#FILE][slow], of which a file whose cases are all of the other kind lacks one. Each case
has one tag of its file (main.cc), so three questions to the binary are enough.
"""
import collections
import re
import subprocess
import sys

KINDS = ("~[slow]", "[slow]")


def ask(binary, *arguments):
    """Lines of what Catch lists; it exits with their number."""
    run = subprocess.run([binary, *arguments], capture_output=True, text=True, check=False)
    return run.stdout.splitlines()


def main():
    binary, specs = sys.argv[1:]
    with open(specs, encoding="utf-8") as lines:
        runs = collections.Counter(lines.read().splitlines())
    tags = [re.fullmatch(r" *(\d+)  (\[#.*\])", line) for line in ask(binary, "--list-tags")]
    counts = {tag[2]: int(tag[1]) for tag in tags if tag}
    known = {tag + kind for tag in counts for kind in KINDS}

    everything = ask(binary, "--list-test-names-only")
    wrong = [f"{count} times: {spec}" for spec, count in runs.items() if count != 1]
    wrong += [f"no such file: {spec}" for spec in runs if spec not in known]
    # Every case has an entry. (An empty specification would select all.)
    left_out = ",".join(sorted(known - set(runs)))
    if left_out:
        wrong += [f"0 times: {name}"
                  for name in ask(binary, "--list-test-names-only", left_out)]
    if sum(counts.values()) != len(everything):
        wrong.append(f"{sum(counts.values())} tags of files")
    print(f"{len(everything)} test cases, {len(runs)} entries")
    print("\n".join(wrong))
    return 1 if wrong or not everything else 0


if __name__ == "__main__":
    sys.exit(main())
