#!/usr/bin/env python3
"""Whether advice holds: what `lanelight advise` says, beside long renders.

    ./run bench advice [SCENE...] [--time S] [--pilot S] [--seeds N] [--spp N] [--rounds N]
                       [--resolution WxH] [--reference-time S] [--truth FILE] [--json FILE]

For each scene every strategy that advice has tried is rendered as `bench efficiency` does
it, and its efficiency relative to the default measured; then advice of each seed is held
against that:

  advised    efficiency of what was advised over the default's, what the trial takes of the
             time included: least, median over the seeds
  best       of the candidate that is best by the long renders
  claims     efficiencies that advice stated, and how many of their 90 % intervals hold:
             the long renders' own interval is allowed for

--truth FILE keeps the long renders' figures, and uses those that are there. Exit status 3
if what was advised has less than 0.95 of the default's efficiency, clearly.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

import efficiency

FOLDER = pathlib.Path(__file__).resolve().parent.parent
LEAST = 0.95  # of the default's efficiency, with the trial
Z90, Z95 = 1.645, 1.96


def advise(options, scene, seed):
    command = [options.program, "advise", scene, "--time", options.time, "--seed",
               str(seed), "--threads", "1", "--json", "-"]
    if options.pilot:
        command += ["--pilot", options.pilot]
    if options.resolution:
        command += ["--resolution", options.resolution]
    done = subprocess.run(command, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, text=True, check=True)
    return json.loads(done.stdout)["advice"]


def long_renders(options, scene, strategies):
    """{strategy: (gain, low, high)} relative to the first."""
    who = [(s, options.program, s) for s in strategies]
    runs, size = efficiency.render_all(options, scene, who, ["--spp", options.spp])
    mean = efficiency.reference(options, scene, who, [runs])
    rows = efficiency.compare(runs, mean, size, who)
    return {row["candidate"]: row.get("gain", (1, 1, 1)) for row in rows}


def holds(claim, truth):
    """The claim's interval holds the truth, whose own interval is added in squares."""
    value, low, high = (math.log(claim[k]) for k in ("value", "low", "high"))
    log = math.log(truth[0])
    own = (math.log(truth[2]) - math.log(truth[1])) / 2 * Z90 / Z95
    middle = (low + high) / 2
    half = (high - low) / 2
    return abs(log - middle) <= math.hypot(half, own), log - value


def look(options, scene, truths):
    advices = [advise(options, scene, seed) for seed in range(options.seeds)]
    usual = advices[0]["candidates"][0]["strategy"]
    tried = [usual] + sorted({c["strategy"] for a in advices for c in a["candidates"]
                              if c["samples"] and c["strategy"] != usual})
    known = truths.setdefault(scene, {})
    known[usual] = (1, 1, 1)
    if missing := [s for s in tried if s not in known]:
        known.update(long_renders(options, scene, [usual] + missing))
    share = float(options.pilot or 0.03 * float(options.time)) / float(options.time)
    advised = sorted((known[a["chosen"]][0] * (1 - share), known[a["chosen"]], a["chosen"])
                     for a in advices)
    claims = [(scene, c["changes"], c["efficiency"], known[c["strategy"]],
               *holds(c["efficiency"], known[c["strategy"]]))
              for a in advices for c in a["candidates"]
              if c["changes"] and c["efficiency"] and all(c["efficiency"].values())]
    best = max(known, key=lambda s: known[s][0])
    return {"scene": scene, "least": advised[0][0], "least_high": advised[0][1][2],
            "median": statistics.median(a[0] for a in advised), "best": known[best][0],
            "chosen": sorted({a["chosen"] for a in advices}), "claims": claims,
            "names": {c["strategy"]: c["changes"] for a in advices
                      for c in a["candidates"]}, "best_strategy": best}


def print_row(row):
    held = sum(c[4] for c in row["claims"])
    names = row["names"]
    chosen = " | ".join(names[c] or "default" for c in row["chosen"])
    print(f"{row['scene'][-36:]:36} {row['least']:6.2f} {row['median']:6.2f} "
          f"{row['best']:6.2f} {held:4}/{len(row['claims']):<4} {chosen}"
          f"   (best: {names[row['best_strategy']] or 'default'})", flush=True)


def read_options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--program", default=str(FOLDER / "build/release/lanelight"))
    parser.add_argument("--time", default="40")
    parser.add_argument("--pilot")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--spp", default="256")
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--resolution")
    parser.add_argument("--reference-time", metavar="S")
    parser.add_argument("--truth", metavar="FILE")
    parser.add_argument("--json", help="write all rows to this file")
    parser.set_defaults(seed=1)
    options = parser.parse_args()
    if not options.scenes:
        options.scenes = [str(p) for p in sorted((FOLDER / "scenes").glob("*.pbrt"))]
    return options


def main():
    options = read_options()
    file = pathlib.Path(options.truth) if options.truth else None
    truths = json.loads(file.read_text()) if file and file.exists() else {}
    print(efficiency.machine(options.program)["text"])
    print(f"{'scene':36} {'least':>6} {'median':>6} {'best':>6} {'claims':>9} advised")
    rows = []
    for scene in options.scenes:
        rows.append(look(options, scene, truths))
        print_row(rows[-1])
        if file:
            file.write_text(json.dumps(truths, indent=1))
    claims = [c for row in rows for c in row["claims"]]
    print(f"{sum(c[4] for c in claims)} of {len(claims)} stated intervals (90 %) hold")
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(rows, indent=1))
    return 3 if any(r["least_high"] < LEAST for r in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
