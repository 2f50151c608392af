#!/usr/bin/env python3
"""What ranks gain and cost: `./run bench mpi [SCENE] [--rounds N] [--json FILE]`.

Renders in turns, medians over the rounds:

  alone      one process, one thread
  ranks 1    the program with MPI, one rank of one thread
  ranks 2    two ranks of one thread each: the speed-up over `alone`
  threads 2  one process, two threads
  ranks 8    eight ranks of one thread each, on two cores: what they cost over `threads 2`

`seconds` is wall clock of the render as the report says it; `cpu` is processor time of all
processes, starting and waiting included. On a machine with other work wall clocks say
little; `cpu` then tells the overhead, and `rank 0 cpu / seconds` is not below the core's
share. All images must have the same pixels.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(FOLDER, "tests", "ranks"))
from ranks_test import pixels  # noqa: E402

# name: ranks (0: the program without MPI), threads of each
KINDS = {"alone": (0, 1), "ranks 1": (1, 1), "ranks 2": (2, 1), "threads 2": (0, 2),
         "ranks 8": (8, 1)}


def measure(options, ranks, threads):
    build = options.build
    command = [os.path.join(build, "lanelight")]
    if ranks:
        command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks),
                   os.path.join(build, "mpi", "lanelight")]
        if os.getuid() == 0:
            command.insert(1, "--allow-run-as-root")
    command += ["render", options.scene, "-o", "image.exr", "--json", "report.json",
                "--quiet", "--threads", str(threads), "--spp", str(options.spp),
                "--resolution", options.resolution]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    report = json.load(open("report.json"))
    return {"seconds": report["seconds"]["render"], "render_cpu": report["cpu_seconds"],
            "cpu": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            "samples": report["samples"], "bytes": report["bytes_between_ranks"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", nargs="?",
                        default=os.path.join(FOLDER, "scenes", "cornell-box.pbrt"))
    parser.add_argument("--build", default=os.path.join(FOLDER, "build", "release"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--resolution", default="320x320")
    parser.add_argument("--json")
    options = parser.parse_args()
    options.scene, options.build = map(os.path.abspath, (options.scene, options.build))
    out = options.json and os.path.abspath(options.json)
    runs = {kind: [] for kind in KINDS}
    machine = json.loads(subprocess.check_output(
        [os.path.join(options.build, "lanelight"), "info", "--json"]))["machine"]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        image = None
        for _ in range(options.rounds):
            for kind, (ranks, threads) in KINDS.items():
                runs[kind].append(measure(options, ranks, threads))
                image = image or pixels("image.exr")
                if pixels("image.exr") != image:
                    sys.exit(f"{kind} has other pixels")
        os.chdir("/")
    medians = {kind: {name: statistics.median(run[name] for run in of) for name in of[0]}
               for kind, of in runs.items()}
    print(machine["text"])
    print(f"{'':10} {'seconds':>8} {'render cpu':>10} {'all cpu':>8} {'bytes/sample':>12}")
    for kind, m in medians.items():
        print(f"{kind:10} {m['seconds']:8.2f} {m['render_cpu']:10.2f} {m['cpu']:8.2f} "
              f"{m['bytes'] / m['samples']:12.2f}")
    m = medians
    # The result on two idle cores, as far as processor time tells.
    for name in "seconds", "render_cpu":
        two = m["alone"][name] / m["ranks 2"][name] * (2 if name == "render_cpu" else 1)
        eight = m["ranks 8"][name] / m["threads 2"][name] - 1
        print(f"by {name}: speed-up of 2 ranks {two:.2f}, overhead of 8 ranks {eight:+.1%}")
    if out:
        json.dump({"machine": machine, "runs": runs, "medians": medians}, open(out, "w"),
                  indent=1)


if __name__ == "__main__":
    main()
