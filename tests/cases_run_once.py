#!/usr/bin/env python3
"""Every test case of the binary is in exactly one ctest entry.

usage: cases_run_once.py BINARY SPECS

SPECS has one test specification per line, those of the ctest entries.
"""
import collections
import subprocess
import sys


def cases(binary, *spec):
    """Names of the test cases that a specification selects; Catch exits with their number."""
    run = subprocess.run([binary, "--list-test-names-only", *spec],
                         capture_output=True, text=True, check=False)
    return run.stdout.splitlines()


def main():
    binary, specs = sys.argv[1:]
    everything = cases(binary)
    runs = collections.Counter()
    with open(specs, encoding="utf-8") as lines:
        for spec in lines.read().splitlines():
            runs.update(cases(binary, spec))
    wrong = [f"{runs[name]} times: {name}" for name in everything if runs[name] != 1]
    wrong += [f"unknown: {name}" for name in runs if name not in everything]
    print(f"{len(everything)} test cases, {sum(runs.values())} runs")
    print("\n".join(wrong))
    return 1 if wrong or not everything else 0


if __name__ == "__main__":
    sys.exit(main())
