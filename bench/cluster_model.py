"""How long a render takes on a cluster, by the two ways of sharing it out.

Times are in seconds. A scene is a grid of costs: processor seconds per pixel and sample
in relative units, row by row, of square regions of the image (bench_tail measures them).
Nothing here knows of Lanelight's code; docs/scale.md says what was measured and assumed.
"""

import functools
import heapq
import math
import random

TILE = 16  # pixels on a side, of an ordinary tile
TILES_PER_PART = 64  # wanted by src/render/parts.cc


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
        """Share of the work of each of `count` parts: TilesOfPart of
        src/render/parts.cc."""
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


def deal_round(cost, nodes, cores, k, per_range):
    """How long a round of tiles lasts that rank 0 hands out, as src/wavefront/hand_out.cc
    does. `cost`: seconds of work of each range; `per_range`: seconds that each takes of
    rank 0, for the pixels there and back."""
    ranges, threads = len(cost), nodes * cores
    mean = sum(cost) / ranges
    wanted = cores * int(min(max(k["batch"] / mean, 1), 1e6))
    # Who asks next: when, free when, who. A node asks for a second batch ahead.
    asking = [(0.0, 0.0, n) for n in range(min(nodes, ranges))]
    leader, last, at = 0.0, 0.0, 0
    while at < ranges:
        asked, free, node = heapq.heappop(asking)
        left = ranges - at
        count = min(wanted, max(left * cores // (2 * threads), cores), left)
        batch = cost[at : at + count]
        at += count
        leader = max(leader, asked) + k["message"] + count * per_range
        begin = max(free, leader + k["latency"])
        # Of the node's threads: no faster than the longest range.
        end = begin + max(sum(batch) / cores, max(batch))
        last = max(last, end)
        ahead = ranges - at >= 2 * threads
        heapq.heappush(asking, (begin if ahead else end, end, node))
    return last + k["latency"]


def handed_out(machine, scene, core_seconds, side=TILE):
    """One MPI job on all nodes: any failure ends it. Returns what fixed_parts does."""
    k, nodes, cores = machine.k, machine.nodes, machine.cores
    tiles = scene.tiles(side)
    total = sum(tiles)
    # A round is as long as src/ranks/mpi_crew.cc makes it, unless a range would be too long.
    mean = min(k["longest_range"] * total / len(tiles) / max(tiles),
               k["round"] * nodes * cores / len(tiles), core_seconds / len(tiles))
    cost = [t / total * mean * len(tiles) for t in tiles]
    per_range = 2 * k["film_bytes"] / len(tiles) / k["network_bytes_per_second"]
    work = core_seconds / sum(cost) * deal_round(cost, nodes, cores, k, per_range)
    # Everybody has the scene; what a training says goes down a tree.
    work += math.ceil(math.log2(max(2, nodes))) * k["latency"]
    end, _ = machine.finish(work, nodes, pause_seconds(k, cores))
    return end, end * nodes
