#!/usr/bin/env python3
"""States that must be refused: damaged ones, and those of other renders; and what must
make no difference: a second process, the clock."""
import collections
import json
import os
import pathlib
import re
import shutil
import signal

from harness import SCENES, Test, outputs, render, result, wait_for

test = Test(__doc__)
counts = collections.Counter()


def refused(what, command, *phrases):
    """Exit code 1, and a message with these words."""
    code, errors = test.run(*command, seconds=60)
    good = code == 1 and all(p in errors for p in phrases) and "internal" not in errors
    test.expect(good, what, code, errors, "lacks", phrases)
    counts[f"refused: {what}"] += good
    return errors


def damaged_states():
    """Cut anywhere, or with a bit flipped."""
    folder = test.fresh()
    state, bad = folder / "s", folder / "bad.state"
    test.good(*render("training", 8, *outputs(folder), "--checkpoint", state))
    (folder / "out.exr").unlink()
    data = state.read_bytes()
    places = 60 if test.full else 1
    resume = render("training", 16, *outputs(folder), "--resume", bad)
    merge = ["merge", bad, "-o", folder / "out.exr"]
    cuts = [0, 1, 511, 512, 513, len(data) - 1]
    cuts += [test.random.randrange(len(data)) for _ in range(places)]
    for cut in cuts:
        bad.write_bytes(data[:cut])
        for command in (resume, merge):
            refused("a state cut short", command, "bad.state")
        test.expect(bad.read_bytes() == data[:cut], "the damaged state was changed")
    bits = [0, 16 * 8, 24 * 8, 32 * 8, 100 * 8, 511 * 8, 512 * 8]
    bits += [test.random.randrange(8 * len(data)) for _ in range(places)]
    for bit in bits:
        flipped = bytearray(data)
        flipped[bit // 8] ^= 1 << bit % 8
        bad.write_bytes(flipped)
        for command in (resume, merge):
            refused("a state with a bit flipped", command, "bad.state")
    bad.write_bytes(data + b"\0")
    refused("a state with a byte more", resume, "bad.state")
    test.expect(not (folder / "out.exr").exists(), "an image of a damaged state")


def other_version(path):
    """A copy of the program that takes itself for another version."""
    text = os.popen(f"'{test.lanelight}' --version").read()
    commit = re.search(r"\(([^,]+),", text).group(1).encode()
    program = pathlib.Path(test.lanelight).read_bytes()
    if program.count(commit) != 1:
        return None
    path.write_bytes(program.replace(commit, commit[::-1].swapcase()))
    path.chmod(0o755)
    return str(path)


def other_renders():
    """Parts of another scene, seed, target or version: refused, with what differs."""
    folder = test.fresh()
    small = ["--crop", "0,0,48,48", "--quiet", "--spp", 8]
    shutil.copytree(SCENES / "parts", folder / "parts")
    scene = folder / "box.pbrt"
    text = (SCENES / "cornell-box.pbrt").read_text()
    scene.write_text(text)

    def part(number, name, *flags, count=2):
        path = folder / name
        path.unlink(missing_ok=True)
        test.good("render", scene, *small, *flags, "--part", f"{number}/{count}",
                  "--checkpoint", path)
        return path

    first = part(1, "first.state")

    def check(what, second, *phrases):
        merge = ["merge", first, second, "-o", folder / "out.exr"]
        refused(f"merging {what}", merge, second.name, *phrases)
        again = ["render", scene, *small, "--part", "2/2", "--resume", second]
        refused(f"going on with {what}", again, second.name, *phrases)

    check("another resolution", part(2, "a.state", "--resolution", "200x200"), "resolution")
    check("another strategy", part(2, "b.state", "--strategy", "points=halton"), "strategy")
    check("another depth", part(2, "c.state", "--max-depth", 3), "max_depth")
    again = ["render", scene, *small, "--part", "2/2", "--resume"]
    refused("going on with another seed", [*again, part(2, "d.state", "--seed", 7)], "seed")
    refused("merging a part of another seed",
            ["merge", first, folder / "d.state", "-o", folder / "out.exr"], "")
    refused("the same part twice", ["merge", first, first, "-o", folder / "out.exr"],
            "both have pixel")
    refused("another part", [*again, first], "another part than 2/2", "--part")
    refused("parts of two cuts", ["merge", first, part(2, "e.state", count=3), "-o",
                                  folder / "out.exr"], "")
    refused("a missing part", ["merge", first, "-o", folder / "out.exr"], "--partial")
    scene.write_text(text + "# another file\n")
    second = part(2, "f.state")
    scene.write_text(text)
    check("another scene", second, "scene_hash")
    version = other_version(folder / "other")
    if version:
        own, test.lanelight = test.lanelight, version
        second = part(2, "g.state")
        test.lanelight = own
        check("another version", second, "version")
    else:
        print("left out: no other version could be made of this program")
    test.good("render", scene, *small, "-o", folder / "t.exr", "--json", folder / "t.json")
    target = json.loads((folder / "t.json").read_text())["target"]
    others = [name for name in target["available"] if name != target["name"]]
    if others:
        check("another target", part(2, "h.state", "--simd", others[0]), "target")
    else:
        print("left out: this program has one SIMD target only")


def two_processes():
    """The second one is refused while the first one lives, however that ends."""
    for number in (signal.SIGKILL, signal.SIGTERM):
        folder = test.fresh()
        command = render("plain", 100000, *outputs(folder), "--checkpoint", folder / "s",
                         "--every", 0.02, "--resume", size="256x256")
        first = test.start(*command)
        test.expect(wait_for((folder / "s").exists), "no state")
        for _ in range(3):
            errors = refused("a second process on a state", command, "is in use by",
                             f"process {first.pid} on ")
        shutil.copyfile(folder / "s", folder / "copy")
        refused("merging into a state that is being kept",
                ["merge", folder / "copy", "--partial", "--state", folder / "s"],
                "is in use by")
        refused("merging a state into itself",
                ["merge", folder / "s", "--partial", "--state", folder / "s"],
                "would overwrite")
        test.expect(first.poll() is None, "the first one has ended:", errors)
        # Who only reads takes no lock.
        for _ in range(100 if test.full else 5):
            test.good("merge", folder / "s", "--partial", "-o", folder / "so-far.exr")
            counts["read while it is being kept"] += 1
        first.send_signal(number)
        errors = first.communicate()[1]
        wanted = 6 if number == signal.SIGTERM else -signal.SIGKILL
        test.expect(first.returncode == wanted, "exit code", first.returncode, errors)
        second = test.start(*command)
        lock = folder / "s.lock"
        mine = lambda: lock.exists() and f"process {second.pid} " in lock.read_text()
        test.expect(wait_for(mine), "the lock outlives its process")
        second.send_signal(signal.SIGTERM)
        second.communicate()
        test.expect(second.returncode in (6, -signal.SIGTERM), "exit code", second.returncode)
        counts["locks freed"] += 1


def clocks():
    """Neither the clock on the wall nor the times of files matter."""
    whole = test.fresh("undisturbed")
    test.good(*render("plain", 512, *outputs(whole)))
    folder = test.fresh()
    command = render("plain", 512, *outputs(folder), "--checkpoint", folder / "s",
                     "--resume", "--every", 0.05)
    for year in (1975, 2100):
        process = test.start(*command, faults={"CLOCK": 1})
        test.expect(wait_for((folder / "s").exists), "no state")
        process.send_signal(signal.SIGKILL)
        process.communicate()
        seconds = (year - 1970) * 365.25 * 86400
        if (folder / "s").exists():
            os.utime(folder / "s", (seconds, seconds))
    code, errors = test.run(*command, faults={"CLOCK": 1})
    test.expect(code == 0, "exit code", code, errors)
    good = result(folder) == result(whole)
    test.expect(good, "a clock that goes back changes the image")
    counts["clock set back: equal"] += good


for run in (damaged_states, other_renders, two_processes, clocks):
    run()
for name in sorted(counts):
    print(f"{counts[name]:6d}  {name}")
test.end()
