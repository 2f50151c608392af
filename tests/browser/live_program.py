"""A `lanelight live` that runs for the checks of its page."""

import contextlib
import pathlib
import signal
import subprocess

SCENES = pathlib.Path(__file__).parents[2] / "scenes"
THE_ONE = []  # that runs


class Program:
    def __init__(self, binary, scene, flags):
        self.process = subprocess.Popen(
            [binary, "live", str(scene), *flags], stdout=subprocess.PIPE,
            stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()

    def memory(self):
        """Bytes that are in memory."""
        status = pathlib.Path(f"/proc/{self.process.pid}/status").read_text()
        line = next(line for line in status.splitlines() if line.startswith("VmRSS"))
        return int(line.split()[1]) * 1024

    def interrupt(self):
        """Ctrl-C; what it says until it ends, and its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        out, err = self.process.communicate(timeout=60)
        return out, err, self.process.returncode


@contextlib.contextmanager
def running(binary, *flags, scene=SCENES / "cornell-box.pbrt"):
    program = Program(binary, scene, flags)
    THE_ONE[:] = [program]
    try:
        yield program
    finally:
        if program.process.poll() is None:
            program.interrupt()
