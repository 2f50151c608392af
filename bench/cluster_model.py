"""How long a render takes on a cluster, by the two ways of sharing it out.

Times are in seconds. A scene is a grid of costs: processor seconds per pixel and sample
in relative units, row by row, of square regions of the image (bench_tail measures them).
Nothing here knows of Lanelight's code; docs/scale.md says what was measured and assumed.
"""

import functools
import math
import random

TILE = 16  # pixels on a side, of an ordinary tile
TILES_PER_PART = 64  # wanted by src/render/wave/tiles.cc


class Scene:
    """Relative costs over a film of width x height pixels."""

    def __init__(self, name, width, height, columns, costs):
        self.name, self.width, self.height = name, width, height
        self.columns, self.rows = columns, len(costs) // columns
        mean = sum(costs) / len(costs)
        self.costs = [c / mean for c in costs]

    def at(self, x, y):
        """Cost of a pixel, 1 on average."""
        column = x * self.columns // self.width
        return self.costs[y * self.rows // self.height * self.columns + column]

    def number(self, side):
        """Of tiles."""
        return -(-self.width // side) * -(-self.height // side)

    @functools.lru_cache(maxsize=None)
    def tiles(self, side):
        """Costs of the tiles of `side`, in pixels of average cost, along a Z-order curve."""
        found = []
        for y in range(0, self.height, side):
            for x in range(0, self.width, side):
                w, h = min(side, self.width - x), min(side, self.height - y)
                key = spread(x // side) | spread(y // side) << 1
                found.append((key, w * h * self.at(x + w // 2, y + h // 2)))
        found.sort()
        return [cost for _, cost in found]

    @functools.lru_cache(maxsize=None)
    def parts(self, count):
        """Share of the work of each of `count` parts: DistributeTiles of
        src/render/wave/tiles.cc."""
        side = TILE
        while count > 1 and side > 1 and self.number(side) < TILES_PER_PART * count:
            side //= 2
        if self.number(side) < count:
            raise ValueError(f"{count} parts of {self.number(side)} tiles")
        costs = self.tiles(side)
        total = sum(costs)
        return [sum(costs[i::count]) / total for i in range(count)]


def spread(v):
    """The bits of v < 65536, with a zero before each."""
    v = (v | v << 8) & 0x00FF00FF
    v = (v | v << 4) & 0x0F0F0F0F
    v = (v | v << 2) & 0x33333333
    return (v | v << 1) & 0x55555555


class Machine:
    """A cluster: `k` are the constants, measured and assumed."""

    def __init__(self, k, nodes, cores, failures_per_hour, seed):
        self.k, self.nodes, self.cores = k, nodes, cores
        self.rate = failures_per_hour / 3600
        self.random = random.Random(seed)

    def until_failure(self, nodes):
        """Seconds until the first of so many nodes fails."""
        rate = self.rate * nodes
        return self.random.expovariate(rate) if rate > 0 else math.inf

    def film_seconds(self, bytes_per_second):
        return self.k["film_bytes"] / bytes_per_second

    def finish(self, work, nodes, pause):
        """When a job that works for `work` seconds is done: it keeps its state every so
        often, which takes `pause`, and each failure of one of its nodes throws it back to
        the last state. Also how often it has failed."""
        k, clock, failures, kept = self.k, 0.0, 0, 0.0
        interval = k["checkpoint_interval"]
        while True:
            begin = clock + k["start"]
            # The state of the whole film is read before the job goes on.
            if failures > 0:
                begin += self.film_seconds(k["merge_bytes_per_second"])
            left = work - kept
            states = max(0, math.ceil(left / interval) - 1)
            end = begin + left + states * pause
            fails = clock + self.until_failure(nodes)
            if fails >= end:
                return end, failures
            done = max(0.0, fails - begin)
            kept += min(states, int(done / (interval + pause))) * interval
            failures += 1
            clock = fails + k["requeue"]
            if clock > 1000 * (work + k["start"]) + 1e7:
                return math.inf, failures


def pause_seconds(k, cores):
    """Of a checkpoint of the whole film: compression takes all threads, up to a number."""
    return k["pause_cpu"] / min(cores, k["pause_scales_to"])


def fixed_parts(machine, scene, core_seconds, shares):
    """A job per node and part; merged when the last one is done. Returns the seconds until
    the image is there, and those that all nodes together were taken for."""
    k, cores = machine.k, machine.cores
    ends = []
    for share in shares:
        work = share * core_seconds / cores + k["node_tail"]
        ends.append(machine.finish(work, 1, share * pause_seconds(k, cores))[0])
    merge = max(
        machine.film_seconds(k["merge_bytes_per_second"]),
        len(shares) * k["merge_per_part"],
    )
    return max(ends) + merge, sum(ends) + merge


def ranks(machine, scene, core_seconds, shares):
    """One MPI job on all nodes, each with its part of the tiles from the first sample to
    the last: any failure ends it. All wait for the slowest part, and at every state until
    rank 0 has the parts of all. Returns what fixed_parts does."""
    k, nodes, cores = machine.k, machine.nodes, machine.cores
    # A reduction of all goes through a tree.
    sums = math.ceil(math.log2(max(2, nodes))) * k["latency"]
    gather = sums + machine.film_seconds(k["network_bytes_per_second"])
    gather += nodes * k["message"]
    # A state ends a round: threads wait for the tasks in flight, everybody for the last
    # sum and the next order.
    pause = k["node_tail"] + 3 * sums + gather + pause_seconds(k, cores)
    work = max(shares) * core_seconds / cores + k["node_tail"]
    end, _ = machine.finish(work, nodes, pause)
    end += 3 * sums + gather
    return end, end * nodes
