#!/usr/bin/env python3
"""Which strategy, or which program, has the least error for the time.

    ./run bench efficiency [SCENE...] [--strategies 'A;B;...'] [--programs P,Q,...]
                           [--times 2,10,60 | --spp N,...] [--rounds N]
                           [--resolution WxH] [--filter N] [--reference-time S]
                           [--json FILE]

Candidates are all strategies with all programs ('default' is a strategy; a program may also
be named with its own strategies, 'P:A'); the first is the baseline. All render in turns,
one thread, every render with a seed of its own, the order reversed every other round. Each
line has, at that time:

  error      variance of a render over mean^2 + 0.01, mean over pixels and colours; the mean
             is that of all renders of the scene, or of one of --reference-time seconds
  worst      the share of the error in the worst 1 % of a render's pixels
  gain       (baseline's error times its time) / (error times time), and 95 % interval
  trimmed    the same without the worst 1 % of each render's pixels
  filtered   the same of means over squares of --filter pixels (8): what is left of errors
             once neighbours are averaged
  means      p-value for equal expectations; below 0.001 the line is marked BIASED?

Time is the processor time that the render reports, pilots and training included. Exit
status 3 if a candidate's mean differs from the baseline's.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

import efficiency_statistics as statistics

FOLDER = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(FOLDER / "python"))

FALSE_ALARM = 0.001  # of each comparison of means


def candidates(options):
    """[(label, program, strategy)]: labels say what differs."""
    found = []
    for program in options.programs.split(","):
        path, _, own = program.partition(":")
        for strategy in own.split(";") if own else options.strategies.split(";"):
            label = strategy if "," not in options.programs else f"{path}:{strategy}"
            found.append((label, path, strategy))
    if len(found) < 2:
        sys.exit("efficiency: name at least two strategies or programs to compare")
    return found


def machine(program):
    """What the program says of this machine; older ones say nothing."""
    done = subprocess.run([program, "info", "--json"], stdout=subprocess.PIPE, check=True)
    return json.loads(done.stdout).get("machine", {"text": "machine unknown"})


def render(options, scene, candidate, length, seed, threads=1):
    """Colours, processor seconds, width and height of one render."""
    import lanelight  # needs numpy, which the statistics do not
    _, program, strategy = candidate
    image = lanelight.render(
        scene, strategy=None if strategy == "default" else strategy, depth="float", seed=seed,
        threads=threads, resolution=options.resolution, program=program, progress=False,
        **{length[0].strip("-"): length[1]})
    values = image.rgb.ravel().tolist()
    if not all(map(math.isfinite, values)) or any(image.report["health"].values()):
        sys.exit(f"efficiency: {scene} {candidate}: invalid samples")
    return values, image.report["cpu_seconds"], image.width, image.height


def render_all(options, scene, who, length):
    """runs[k] = [(colours, seconds)] of candidate k, and the size of the image."""
    runs = [[] for _ in who]
    for i in range(options.rounds):
        order = list(range(len(who)))
        for k in order if i % 2 == 0 else reversed(order):
            seed = options.seed + i * len(who) + k
            values, seconds, *size = render(options, scene, who[k], length, seed)
            runs[k].append((values, seconds))
    return runs, size


def blocks_of_errors(run, mean, of, blocks):
    """Of a candidate: error times seconds by round and block, all and trimmed; the mean
    error; and the block means of the renders, by which expectations are compared."""
    images = [values for values, _ in run]
    total = [sum(v) for v in zip(*images)]
    everything, trimmed, errors, levels = [], [], [], []
    for image, seconds in run:
        e = statistics.pixel_errors(image, total, len(run), mean)
        errors.append(sum(e) / len(e))
        for out, kept in (everything, e), (trimmed, statistics.without_worst(e)):
            out.append([seconds * x for x in statistics.block_sums(kept, of, blocks)])
        # Plain sums: weights made of the same renders would bias the comparison.
        level = [image[k] + image[k + 1] + image[k + 2] for k in range(0, len(image), 3)]
        levels.append(statistics.block_sums(level, of, blocks))
    return everything, trimmed, sum(errors) / len(errors), levels


def reference(options, scene, who, everything):
    """What errors are relative to. Noise in it makes bright outliers look small, so the
    renders count by their seconds, and one long render is better."""
    if options.reference_time:
        return render(options, scene, who[0], ["--time", options.reference_time], 0,
                      threads=0)[0]
    renders = [r for runs in everything for run in runs for r in run]
    return statistics.mean_image([v for v, _ in renders], [s for _, s in renders])


def filtered_gains(runs, mean, size, side):
    """The gain of each candidate but the first once squares of pixels are averaged."""
    boxed = [[(statistics.box_means(image, *size, side)[0], seconds)
              for image, seconds in run] for run in runs]
    mean, *small = statistics.box_means(mean, *size, side)
    of, blocks = statistics.block_of(*small)
    errors = [blocks_of_errors(run, mean, of, blocks)[0] for run in boxed]
    return [statistics.efficiency(errors[0], e) for e in errors[1:]]


def compare(runs, mean, size, who, side=8):
    """One row for each candidate; errors are relative to `mean`."""
    of, blocks = statistics.block_of(*size)
    parts = [blocks_of_errors(run, mean, of, blocks) for run in runs]
    rows = []
    for k, (label, _, _) in enumerate(who):
        whole, kept = (sum(map(sum, part)) for part in parts[k][:2])
        row = {"candidate": label, "error": parts[k][2],
               "worst": 1 - kept / whole if whole else math.nan,
               "seconds": sum(seconds for _, seconds in runs[k]) / len(runs[k])}
        if k:
            row["gain"] = statistics.efficiency(parts[0][0], parts[k][0])
            row["trimmed"] = statistics.efficiency(parts[0][1], parts[k][1])
            row["means"] = statistics.means_differ(parts[0][3], parts[k][3])
        rows.append(row)
    for row, gain in zip(rows[1:], filtered_gains(runs, mean, size, side)):
        row["filtered"] = gain
    return rows


def interval(values):
    return "{:6.2f} [{:.2f}, {:.2f}]".format(*values)


def print_rows(scene, length, rows):
    print(f"\n{scene} {' '.join(length)}")
    print(f"  {'candidate':40} {'seconds':>8} {'error':>10} {'worst':>6} "
          f"{'gain':>22} {'trimmed':>22} {'filtered':>22} {'means':>7}")
    for row in rows:
        line = f"  {row['candidate']:40} {row['seconds']:8.2f} {row['error']:10.4g}"
        line += f" {row['worst']:6.0%}"
        if "gain" in row:
            line += f" {interval(row['gain']):>22} {interval(row['trimmed']):>22}"
            line += f" {interval(row['filtered']):>22}"
            line += f" {row['means']:7.2g}"
            line += " BIASED?" if row["means"] < FALSE_ALARM else ""
        print(line, flush=True)


def read_options():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="*", metavar="SCENE")
    parser.add_argument("--strategies", default="default;roulette=adjoint")
    parser.add_argument("--programs", default=str(FOLDER / "build/release/lanelight"))
    length = parser.add_mutually_exclusive_group()
    length.add_argument("--times", default="2,10,60", help="seconds of each render")
    length.add_argument("--spp", help="samples per pixel instead")
    parser.add_argument("--rounds", type=int, default=8, help="renders of each, at least 3")
    parser.add_argument("--resolution")
    parser.add_argument("--filter", type=int, default=8, metavar="N",
                        help="side of the squares whose means are compared as well")
    parser.add_argument("--reference-time", metavar="S",
                        help="errors relative to a render of the baseline, all cores")
    parser.add_argument("--seed", type=int, default=1, help="the first one")
    parser.add_argument("--json", help="write all rows to this file")
    options = parser.parse_args()
    if options.rounds < 3:
        parser.error("--rounds: 3 at least; the scatter of fewer says nothing")
    if not options.scenes:
        options.scenes = [str(FOLDER / f"scenes/{name}.pbrt") for name in
                          ("shaded-lamp", "blinds", "corridor", "mirror-wall")]
    return options


def main():
    options = read_options()
    who = candidates(options)
    lengths = [["--spp", n] for n in options.spp.split(",")] if options.spp else [
        ["--time", t] for t in options.times.split(",")]
    table, biased, here = [], False, machine(who[0][1])
    print(here["text"])
    for scene in options.scenes:
        rendered = [render_all(options, scene, who, length) for length in lengths]
        mean = reference(options, scene, who, [runs for runs, _ in rendered])
        for length, (runs, size) in zip(lengths, rendered):
            rows = compare(runs, mean, size, who, options.filter)
            print_rows(scene, length, rows)
            table.append({"scene": scene, "machine": here, "length": length,
                          "rows": rows})
            biased |= any(row.get("means", 1) < FALSE_ALARM for row in rows)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(table, indent=1))
    return 3 if biased else 0


if __name__ == "__main__":
    sys.exit(main())
