#!/usr/bin/env python3
"""Time and efficiency of renders on 10 to 10 000 nodes, from measured constants.

    bench/simulate_cluster.py [--constants FILE] [--hours CORE_HOURS] [--seeds N]
                              [--nodes 10,100,...] [--cores 16,64] [--failures 0,...]
                              [--set NAME=VALUE]...
    bench/simulate_cluster.py --test

Efficiency is the processor time that the render needs on one core over that of all cores
until the image is there. In brackets the least and the largest of the seeds.
"""

import argparse
import json
import math
import pathlib
import statistics
import sys
import unittest

from cluster_model import Machine, Scene, fixed_parts, ranks

HERE = pathlib.Path(__file__).parent


def read_constants(path):
    """Scenes and numbers of a file like constants.json."""
    data = json.loads(pathlib.Path(path).read_text())
    k = {}
    for group in ("measured", "assumed"):
        for name, entry in data[group].items():
            k[name] = entry["value"]
    scenes = [
        Scene(s["name"], 1920, 1080, s["columns"], s["tile_microseconds"])
        for s in data["scenes"]
    ]
    return scenes, k


def duration(seconds):
    if not math.isfinite(seconds):
        return "never"
    for unit, length in (("d", 86400), ("h", 3600), ("min", 60)):
        if seconds >= 2 * length:
            return f"{seconds / length:.1f} {unit}"
    return f"{seconds:.1f} s"


def row(scene, k, core_hours, nodes, cores, failures, seeds):
    """Both ways: medians of time and efficiency, and the spread of the latter."""
    work = 3600 * core_hours
    shares = scene.parts(nodes)
    ways = {
        "parts": lambda m: fixed_parts(m, scene, work, shares),
        "ranks": lambda m: ranks(m, scene, work, shares),
    }
    out = {}
    for name, way in ways.items():
        times = [
            way(Machine(k, nodes, cores, failures, seed))[0]
            for seed in range(seeds if failures > 0 else 1)
        ]
        efficiency = sorted(work / (t * nodes * cores) for t in times)
        out[name] = (statistics.median(times), efficiency)
    return out


def cell(time, efficiency):
    text = f"{duration(time):>9} {100 * statistics.median(efficiency):5.1f} %"
    spread = f"[{100 * efficiency[0]:.0f}, {100 * efficiency[-1]:.0f}]"
    return f"{text} {spread if len(efficiency) > 1 else '':>9}"


def print_table(scenes, k, options):
    print(f"{options.hours:g} core-hours, {options.seeds} seeds")
    print(f"{'scene':8} {'failures':>9} {'nodes':>6} {'cores':>6}  "
          f"{'jobs of a part':>28}  {'ranks of one job':>28}")
    for scene in scenes:
        for failures in options.failures:
            for cores in options.cores:
                for nodes in options.nodes:
                    result = row(scene, k, options.hours, nodes, cores, failures,
                                 options.seeds)
                    print(f"{scene.name:8} {failures:>7g}/h {nodes:>6} {cores:>6}  "
                          f"{cell(*result['parts']):>28}  "
                          f"{cell(*result['ranks']):>28}")
                    sys.stdout.flush()


class Test(unittest.TestCase):
    """Answers that are known without a simulation."""

    K = {
        "film_bytes": 2e8, "merge_bytes_per_second": 1e9, "merge_per_part": 0.0,
        "start": 0.0, "requeue": 100.0, "checkpoint_interval": 60.0, "node_tail": 0.0,
        "pause_cpu": 0.0, "pause_scales_to": 16, "latency": 0.0, "message": 0.0,
        "network_bytes_per_second": 1e30,
    }
    EVEN = Scene("even", 1920, 1080, 2, [1, 1, 1, 1])
    UNEVEN = Scene("uneven", 1920, 1080, 2, [1, 9, 1, 1])

    def machine(self, nodes=10, failures=0.0, seed=1, **changed):
        return Machine({**self.K, **changed}, nodes, 16, failures, seed)

    def test_the_constants_can_be_read(self):
        scenes, constants = read_constants(pathlib.Path(__file__).with_name("constants.json"))
        self.assertEqual(len(scenes) >= 2, True)
        self.assertLessEqual(set(self.K), set(constants))

    def test_parts_cover_everything_evenly(self):
        for scene in (self.EVEN, self.UNEVEN):
            for count in (1, 7, 100):
                shares = scene.parts(count)
                self.assertAlmostEqual(sum(shares), 1, places=9)
                self.assertLess(max(shares) * count, 1.1)
        with self.assertRaises(ValueError):
            Scene("tiny", 4, 4, 1, [1]).parts(17)

    def test_tiles_weigh_what_the_map_says(self):
        self.assertAlmostEqual(sum(self.UNEVEN.tiles(16)) / (1920 * 1080), 1, places=2)
        self.assertAlmostEqual(max(self.UNEVEN.tiles(16)), 256 * 9 / 3, places=6)

    def test_without_losses_time_is_work_over_cores(self):
        work = 3600 * 160.0
        time, _ = fixed_parts(self.machine(), self.EVEN, work, [0.1] * 10)
        self.assertAlmostEqual(time, 3600 + 0.2, places=6)
        time, _ = ranks(self.machine(), self.EVEN, work, [0.1] * 10)
        self.assertAlmostEqual(time, 3600, places=6)

    def test_pauses_add_up(self):
        end, failures = self.machine().finish(600.0, 1, 1.5)
        self.assertEqual((end, failures), (600 + 9 * 1.5, 0))

    def test_failures_cost_what_theory_says(self):
        """Restarts from states: each failure loses half an interval and the queue."""
        work, rate = 36000.0, 3.0
        ends, fails = [], 0
        for seed in range(400):
            end, failures = self.machine(failures=rate, seed=seed).finish(work, 1, 0.0)
            ends.append(end)
            fails += failures
        # In the queue a job cannot fail; 0.2 s are for reading the state.
        lost = fails / 400 * (30 + 100 + 0.2)
        self.assertLess(abs(statistics.mean(ends) - work - lost) / lost, 0.02)
        self.assertLess(abs(fails / 400 / (rate * statistics.mean(ends) / 3600)
                            / (1 - lost * 100 / 130.2 / statistics.mean(ends)) - 1), 0.03)

    def test_one_job_fails_as_often_as_all_its_nodes(self):
        runs = [self.machine(failures=0.01, seed=s).until_failure(500) for s in range(4000)]
        self.assertLess(abs(statistics.mean(runs) / 720 - 1), 0.05)

    def test_ranks_wait_for_the_slowest_and_for_the_film(self):
        work = 3600 * 160.0
        time, _ = ranks(self.machine(), self.EVEN, work, [0.2] + [0.8 / 9] * 9)
        self.assertAlmostEqual(time, 7200, places=6)
        # The film goes to rank 0 at each of 59 states, and at the end.
        slow = self.machine(network_bytes_per_second=2e8)
        time, _ = ranks(slow, self.EVEN, work, [0.1] * 10)
        self.assertAlmostEqual(time, 3660, places=6)
        # Of 1000 nodes each says its word to rank 0, by way of ten others.
        busy = self.machine(nodes=1000, message=0.001, latency=0.01)
        time, _ = ranks(busy, self.EVEN, work * 100, [0.001] * 1000)
        self.assertAlmostEqual(time, 3660 + 60 * 4 * 0.1, places=6)

    def test_seeds_repeat(self):
        a = [self.machine(failures=5, seed=3).finish(1e4, 1, 0.1) for _ in range(2)]
        self.assertEqual(a[0], a[1])


def numbers(kind):
    return lambda text: [kind(part) for part in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--constants", default=HERE / "constants.json")
    parser.add_argument("--hours", type=float, default=10000, help="of one core")
    parser.add_argument("--seeds", type=int, default=9)
    parser.add_argument("--nodes", type=numbers(int), default=[10, 100, 1000, 10000])
    parser.add_argument("--cores", type=numbers(int), default=[16, 64])
    parser.add_argument("--failures", type=numbers(float), default=[0, 1e-4, 1e-2],
                        help="of a node, per hour")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE",
                        help="another value of a constant: what if")
    parser.add_argument("--test", action="store_true", help="test the model itself")
    options = parser.parse_args()
    if options.test:
        suite = unittest.defaultTestLoader.loadTestsFromTestCase(Test)
        return 0 if unittest.TextTestRunner().run(suite).wasSuccessful() else 1
    scenes, k = read_constants(options.constants)
    for change in options.set:
        name, value = change.split("=")
        if name not in k:
            parser.error(f"--set {name}: not one of {', '.join(k)}")
        k[name] = float(value)
    print_table(scenes, k, options)
    return 0


if __name__ == "__main__":
    sys.exit(main())
