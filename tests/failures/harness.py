"""What the failure tests share: renders, what of them must be equal, and faults.

usage of every script here: SCRIPT LANELIGHT FAULTS_LIBRARY [--full] [--seed N]
"""
import argparse
import atexit
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
BOX = SCENES / "cornell-box.pbrt"

# Of each kind of thing that a state keeps: sums, a control's sums, what a training has
# learned, further channels.
KINDS = {
    "plain": [],
    "control": ["--strategy", "control=regression"],
    "training": ["--strategy", "roulette=adjoint"],
    "channels": ["--aov", "--strategy", "points=independent"],
}
LIMIT = 600  # seconds for a render, on a loaded machine


class Test:
    """A script's arguments, a folder that goes away, and what has failed."""

    def __init__(self, about):
        parser = argparse.ArgumentParser(description=about)
        parser.add_argument("lanelight", type=os.path.abspath)
        parser.add_argument("faults", type=os.path.abspath)
        parser.add_argument("--full", action="store_true", help="all, not a few")
        parser.add_argument("--seed", type=int, default=1, help="of random moments")
        options = parser.parse_args()
        self.lanelight, self.faults = options.lanelight, options.faults
        self.full = options.full
        self.random = random.Random(options.seed)
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lanelight-failures-"))
        atexit.register(shutil.rmtree, self.folder, ignore_errors=True)
        self.failures = []

    def expect(self, good, *what):
        """Notes a failure; nothing ends by it."""
        if not good:
            self.failures.append(" ".join(map(str, what)))
            print("FAILED:", *what, flush=True)

    def end(self):
        """Exits."""
        print(f"{len(self.failures)} failures")
        sys.exit(1 if self.failures else 0)

    def fresh(self, name="run"):
        """An empty folder."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        return folder

    def start(self, *args, faults=None):
        """Starts the program with some of FAULTS_* in its environment."""
        environment = dict(os.environ, TMPDIR=str(self.folder))
        if faults:
            environment["LD_PRELOAD"] = self.faults
            environment.update({f"FAULTS_{k}": str(v) for k, v in faults.items()})
        return subprocess.Popen([self.lanelight, *map(str, args)], env=environment,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                text=True)

    def run(self, *args, faults=None, seconds=LIMIT):
        """Its exit code and standard error; killed after so long."""
        process = self.start(*args, faults=faults)
        try:
            errors = process.communicate(timeout=seconds)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            errors = f"still running after {seconds} s: " + process.communicate()[1]
        return process.returncode, errors

    def good(self, *args):
        """Runs what must end well."""
        code, errors = self.run(*args)
        self.expect(code == 0, f"exit code {code} of", *args, errors)

    def run_and_kill(self, seconds, *args):
        """SIGKILL after so long. True if it came before the end, and the process number."""
        process = self.start(*args)
        try:
            process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.communicate()
        if process.returncode != -signal.SIGKILL:
            self.expect(process.returncode == 0, "exit code", process.returncode)
        return process.returncode == -signal.SIGKILL, process.pid


def render(kind, spp, *more, size="48x48"):
    """Arguments of a small render of this kind."""
    return ["render", BOX, "--resolution", size, "--spp", spp, "--quiet", *KINDS[kind],
            *more]


def outputs(folder):
    """Arguments for an image and a report in the folder."""
    return ["-o", folder / "out.exr", "--json", folder / "out.json"]


def pixels(path):
    """An OpenEXR file without its header, which tells of times, and without the table of
    places behind it, which depends on the header's length."""
    data = path.read_bytes()
    at = 8
    while data[at]:
        for _ in range(2):  # name and type of an attribute
            at = data.index(b"\0", at) + 1
        at += 4 + int.from_bytes(data[at:at + 4], "little")
    first_block = int.from_bytes(data[at + 1:at + 9], "little")
    assert at < first_block < len(data) and (first_block - at - 1) % 8 == 0
    return data[first_block:]


def result(folder):
    """What must not depend on how often a render was killed; None if there is none."""
    if not (folder / "out.exr").exists() or not (folder / "out.json").exists():
        return None
    report = json.loads((folder / "out.json").read_text())
    names = ("samples", "rays", "error", "control", "health", "stop_reason", "strategy",
             "pilot")
    members = {name: report.get(name) for name in names}
    if members["pilot"]:
        members["pilot"].pop("seconds", None)
    return pixels(folder / "out.exr"), members


def wait_for(condition, seconds=60):
    """Waits until something is so; false if it never was."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.005)
    return True
