#!/usr/bin/env python3
"""SIGKILL at random moments, and at every single change of a file: a resumed render is
bit-identical to an undisturbed one, and so is merging."""
import collections
import signal
import time

from harness import KINDS, Test, outputs, pixels, render, result

test = Test(__doc__)
counts = collections.Counter()


def phase(folder, state, process):
    """Where a render was killed, by what it has left."""
    lock = folder / f"{state}.lock"
    if list(folder.glob(f"{state}.{process}.*.tmp")):
        return "writing a state"
    if list(folder.glob(f"out.*.{process}.*.tmp")):
        return "writing results"
    if not lock.exists():
        return "loading or results"
    return "rendering" if f"process {process} " in lock.read_text() else "loading"


def undisturbed(kind, spp):
    """The result, and how long it took."""
    folder = test.fresh("undisturbed")
    start = time.monotonic()
    test.good(*render(kind, spp, *outputs(folder)))
    return result(folder), time.monotonic() - start


def equal(what, good):
    counts[f"{what}: {'equal' if good else 'DIFFERENT'}"] += 1
    test.expect(good, what, "differs")


def kill_renders(kind, spp, kills):
    """Until so many kills have happened, over as many renders as it takes."""
    wanted, seconds = undisturbed(kind, spp)
    done = 0
    while done < kills:
        folder = test.fresh()
        command = render(kind, spp, *outputs(folder), "--checkpoint", folder / "s",
                         "--resume", "--every", 0.05)
        while True:
            # Some kills in a render, and every render comes to its end.
            moment = test.random.uniform(0, max(0.1, 0.4 * seconds)) if done < kills else 600
            killed, process = test.run_and_kill(moment, *command)
            if not killed:
                break
            done += 1
            counts[f"killed {phase(folder, 's', process)}"] += 1
        equal("render", result(folder) == wanted)
        left = sorted(p.name for p in folder.iterdir() if ".tmp" not in p.name)
        test.expect(left == ["out.exr", "out.json", "s"], "left behind:", left)
        test.expect(not list(folder.glob("s.*.tmp")), "temporary files of states stay")


def kill_merges(kills):
    """Output files are whole or not there at any moment."""
    parts = test.fresh("parts")
    states = [parts / f"{i}.state" for i in (1, 2, 3, 4)]
    for i, state in enumerate(states, 1):
        test.good(*render("plain", 16, "--part", f"{i}/4", "--checkpoint", state))
    folder = test.fresh("undisturbed")
    start = time.monotonic()
    test.good("merge", *states, *outputs(folder), "--state", folder / "s")
    seconds = time.monotonic() - start
    wanted, wanted_state = result(folder), (folder / "s").read_bytes()
    for _ in range(kills):
        folder = test.fresh()
        command = ["merge", *states, *outputs(folder), "--state", folder / "s"]
        killed, _ = test.run_and_kill(test.random.uniform(0, 1.1 * seconds), *command)
        counts["killed merging" if killed else "merged before the kill"] += 1
        whole = [p.name for p in folder.iterdir() if p.suffix in ("", ".exr")]
        if "out.exr" in whole:
            equal("image of a killed merge", pixels(folder / "out.exr") == wanted[0])
        if "s" in whole:
            same = (folder / "s").read_bytes() == wanted_state
            equal("state of a killed merge", same)
        test.good(*command)
        equal("merge", result(folder) == wanted)



def kill_at_each_call(kind):
    """At every change of a file that a render of a few states makes, one after another."""
    wanted, _ = undisturbed(kind, 64)
    folder = test.fresh()
    command = render(kind, 64, *outputs(folder), "--checkpoint", folder / "s", "--resume",
                     "--every", 0.01)
    log = test.folder / "calls"
    at = 0
    while True:
        at += 1
        if not test.full and at > 8 and at % 5:
            continue
        folder = test.fresh()
        log.unlink(missing_ok=True)
        code, errors = test.run(*command, faults={"FOLDER": folder, "AT": at, "KIND": 0,
                                                  "LOG": log})
        if code == 0:  # there were fewer calls
            break
        test.expect(code == -signal.SIGKILL, "exit code", code, errors)
        call, path = log.read_text().splitlines()[-1].split()
        counts[f"killed at {call} of {describe(path)}"] += 1
        test.good(*command)
        equal("render", result(folder) == wanted)


def describe(path):
    name = path.rsplit("/", 1)[1]
    for end, what in ((".lock", "the lock"), ("out.exr", "the image"),
                      ("out.json", "the report")):
        if end in name:
            return what
    return "a state" if name.startswith("s") else "the folder"


each = 25 if test.full else 2
for name in KINDS:
    kill_renders(name, 768 if test.full else 256, each)
kill_merges(100 if test.full else 4)
for name in KINDS if test.full else ["plain"]:
    kill_at_each_call(name)
for line in sorted(counts):
    print(f"{counts[line]:6d}  {line}")
test.end()
