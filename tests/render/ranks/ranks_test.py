#!/usr/bin/env python3
"""Renders with several ranks, by MPI: the bits of a single process, whatever happens.

usage: ranks_test.py CASE LANELIGHT MPI_LANELIGHT FAILING_RANK MPIRUN SCENES

CASE: the name of a function below, without `test_`. Ranks share the cores of this machine.
"""
import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import uuid

SIZE = ["--resolution", "72x56"]
STRATEGIES = ["points=sobol", "points=independent", "pairs=antithetic",
              "control=regression", "roulette=adjoint", "light-paths=splats:3",
              "light-selection=learned", "decide=pilot"]
INTERRUPTED = 6


def pixels(path):
    """All of an EXR file but its header, which says how long the render took."""
    data = open(path, "rb").read()
    at = 8
    while data[at]:
        at = data.index(b"\0", at) + 1
        at = data.index(b"\0", at) + 1
        at += 4 + struct.unpack_from("<i", data, at)[0]
    return data[struct.unpack_from("<Q", data, at + 1)[0]:]


def check(condition, message):
    if not condition:
        sys.exit("FAILED: " + message)


class Programs:
    def __init__(self, alone, ranks, failing, mpirun, scenes):
        self.alone, self.ranks, self.failing = alone, ranks, failing
        self.scenes = scenes
        self.mpirun = [mpirun, "--oversubscribe", "--bind-to", "none"]
        if os.getuid() == 0:
            self.mpirun.append("--allow-run-as-root")

    def scene(self, name="cornell-box"):
        return os.path.join(self.scenes, name + ".pbrt")

    def single(self, *arguments):
        subprocess.run([self.alone, "render", *arguments, "--quiet"], check=True)

    def command(self, ranks, *arguments, program=None):
        return [*self.mpirun, "-n", str(ranks), program or self.ranks, *arguments]

    def start(self, ranks, *arguments, program=None):
        """mpirun in the background, and a word by which its ranks are found."""
        tag = uuid.uuid4().hex
        process = subprocess.Popen(
            self.command(ranks, *arguments, program=program),
            env=dict(os.environ, LANELIGHT_TEST_TAG=tag), stderr=subprocess.PIPE, text=True)
        return process, tag


def rank_process(tag, rank):
    wanted = {b"LANELIGHT_TEST_TAG=" + tag.encode(), b"OMPI_COMM_WORLD_RANK=%d" % rank}
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            environment = open(f"/proc/{pid}/environ", "rb").read().split(b"\0")
        except OSError:
            continue
        if wanted <= set(environment):
            return int(pid)
    sys.exit(f"FAILED: no process of rank {rank}")


def check_same_bits(p, name, render):
    p.single(*render, "-o", "alone.exr")
    for ranks in 1, 2, 4:
        subprocess.run(p.command(ranks, "render", *render, "-o", "ranks.exr", "--threads",
                                 "1", "--quiet", "--json", "ranks.json"), check=True)
        check(pixels("ranks.exr") == pixels("alone.exr"),
              f"{name}: {ranks} ranks have other pixels")
        check(json.load(open("ranks.json"))["ranks"] == ranks, "ranks of the report")


def test_same_bits(p):
    for strategy in STRATEGIES:
        check_same_bits(p, strategy, [p.scene(), *SIZE, "--spp", "70", "--aov", "--strategy",
                                      strategy])


def test_buckets_of_wavelengths(p):
    scene = open(p.scene("prism")).read()
    check('Film "rgb"' in scene, "the film of prism.pbrt")
    with open("spectra.pbrt", "w") as file:
        file.write(scene.replace('Film "rgb"', 'Film "spectral"'))
    check_same_bits(p, "buckets", ["spectra.pbrt", *SIZE, "--spp", "70"])
    check(b"S0.550,938nm" in open("ranks.exr", "rb").read(), "no bucket in the image")


def test_ends(p):
    """Parts, targets, and a time that is over, with ranks."""
    part = [p.scene(), *SIZE, "--spp", "96", "--part", "2/3"]
    p.single(*part, "--checkpoint", "one.state", "--json", "one.json")
    subprocess.run(p.command(2, "render", *part, "--checkpoint", "two.state", "--json",
                             "two.json", "--quiet"), check=True)
    one, two = (json.load(open(name + ".json")) for name in ("one", "two"))
    check(one["samples"] == two["samples"] and one["rays"] == two["rays"], "part: counts")

    render = [p.scene(), *SIZE, "--target-relmse", "0.02", "-o"]
    p.single(*render, "alone.exr")
    subprocess.run(p.command(3, "render", *render, "ranks.exr", "--quiet"), check=True)
    check(pixels("ranks.exr") == pixels("alone.exr"), "a target was reached otherwise")

    subprocess.run(p.command(2, "render", p.scene(), *SIZE, "--time", "1.5", "-o", "t.exr",
                             "--checkpoint", "t.state", "--every", "0.3", "--watch",
                             "w.exr", "--json", "t.json", "--quiet"), check=True)
    report = json.load(open("t.json"))
    check(report["stop_reason"] == "time", "ended by " + report["stop_reason"])
    check(os.path.exists("w.exr") and os.path.exists("t.state"), "state and watched image")


def interrupted(p, rank, number, ranks=3, to_mpirun=False):
    """A signal to a rank in the middle of a render, which then goes on alone, and with other ranks."""
    render = [p.scene(), *SIZE, "--spp", "1000"]
    if os.path.exists("k.state"):
        os.remove("k.state")
    p.single(*render, "-o", "alone.exr")
    process, tag = p.start(ranks, "render", *render, "-o", "k.exr", "--threads", "1",
                           "--checkpoint", "k.state", "--every", "0.2", "--quiet")
    while not os.path.exists("k.state"):
        check(process.poll() is None, "ended before there was a state")
        time.sleep(0.01)
    os.kill(process.pid if to_mpirun else rank_process(tag, rank), number)
    text = process.communicate()[1]
    shutil.copy("k.state", "copy.state")
    p.single(*render, "-o", "resumed.exr", "--checkpoint", "k.state", "--resume")
    check(pixels("resumed.exr") == pixels("alone.exr"), "resumed: other pixels")
    subprocess.run(p.command(2, "render", *render, "-o", "resumed.exr", "--checkpoint",
                             "copy.state", "--resume", "--quiet", "--threads", "1"),
                   check=True)
    check(pixels("resumed.exr") == pixels("alone.exr"), "resumed by ranks: other pixels")
    return process.returncode, text


def test_killed_rank(p):
    for rank in 1, 0:
        code, _ = interrupted(p, rank, signal.SIGKILL)
        check(code != 0, "the job of a killed rank ended well")


def test_signals(p):
    for rank in 0, 2:
        code, text = interrupted(p, rank, signal.SIGTERM)
        check(code == INTERRUPTED, f"SIGTERM to rank {rank}: exit code {code}")
        check("interrupted: continue with --resume 'k.state'" in text, text)
        check(text.count("continue with --resume") == 1, "several ranks have printed")


def test_signal_to_mpirun(p):
    # What ranks print once mpirun has the signal may be lost: it closes their pipes. The state
    # is what counts.
    code, _ = interrupted(p, 0, signal.SIGINT, to_mpirun=True)
    check(code != 0, "an interrupted job ended well")


def test_failing_rank(p):
    """A rank throws in the middle: the leader says so, and keeps what there is."""
    render = [p.scene(), *SIZE, "--spp", "1000", "--checkpoint", "f.state"]
    p.single(*render[:-2], "-o", "alone.exr")
    result = subprocess.run(p.command(3, p.scene(), "f.state", program=p.failing),
                            stderr=subprocess.PIPE, text=True)
    check(result.returncode == 1, f"exit code {result.returncode}: {result.stderr}")
    check("error: rank 1 on " in result.stderr, result.stderr)
    check("planted failure" in result.stderr, result.stderr)
    check("continue with --resume 'f.state'" in result.stderr, result.stderr)
    p.single(*render, "--resume", "-o", "resumed.exr")
    check(pixels("resumed.exr") == pixels("alone.exr"), "resumed: other pixels")


def on_two_hosts(p, change):
    """Ranks 0 and 1 in folders of their own; change(text) is the scene of rank 1."""
    text = open(p.scene("furnace")).read()
    for host, own in ("here", text), ("there", change(text)):
        os.makedirs(host, exist_ok=True)
        if own is not None:
            open(os.path.join(host, "s.pbrt"), "w").write(own)
    command = p.mpirun[:]
    for host in "here", "there":
        command += ["-n", "1", "-wdir", os.path.abspath(host), p.ranks, "render", "s.pbrt",
                    "--resolution", "32x32", "-o", "image.exr", ":"]
    result = subprocess.run(command[:-1], stderr=subprocess.PIPE, text=True)
    check(result.returncode == 1, f"exit code {result.returncode}")
    check(not os.path.exists("here/image.exr"), "an image was written")
    return result.stderr


def test_other_scene(p):
    text = on_two_hosts(p, lambda scene: scene + "\n# another byte\n")
    check("error: rank 1 on " in text and "scene_hash: rank 0 has" in text, text)
    shutil.rmtree("there")
    text = on_two_hosts(p, lambda scene: None)
    check("error: rank 1 on " in text and "cannot read the scene file" in text, text)


def test_other_commands(p):
    result = subprocess.run(p.command(2, "plan", p.scene()), stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True)
    check(result.returncode == 2 and result.stdout == "", "plan ran with ranks")
    check(result.stderr.count("error: only `render` supports several ranks (2 here)") == 1, result.stderr)
    subprocess.run(p.command(1, "plan", p.scene()), stdout=subprocess.DEVNULL, check=True)


def main():
    case = globals()["test_" + sys.argv[1]]
    programs = Programs(*map(os.path.abspath, sys.argv[2:5]), sys.argv[5],
                        os.path.abspath(sys.argv[6]))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        case(programs)
        os.chdir("/")


if __name__ == "__main__":
    main()
