#!/usr/bin/env python3
"""A disk that is full at any write, or takes nothing, or is gone: the render goes on, the
image is not lost, what stands on the disk is whole, and what failed is said."""
import collections
import errno
import shutil
import subprocess

from harness import Test, outputs, pixels, render, result, wait_for

test = Test(__doc__)
counts = collections.Counter()
SPP = 64


def command(folder):
    return render("plain", SPP, *outputs(folder), "--checkpoint", folder / "s", "--every",
                  0.01, "--resume")


def elsewhere():
    """Images and states that were kept in the temporary directory; they go away."""
    found = {}
    for path in test.folder.glob("lanelight-*-*"):
        name = path.name.split("-", 2)[2]
        found[name] = pixels(path) if name == "out.exr" else path.read_bytes()
        path.unlink()
    return found


def check(folder, code, errors, wanted, what):
    """After a render on a bad disk: nothing is lost, and all is said."""
    counts[f"{what}: exit code {code}"] += 1
    kept = elsewhere()
    image = pixels(folder / "out.exr") if (folder / "out.exr").exists() else None
    if code == 1 and image is None and not kept:
        # Refused before it began: that is all it says.
        named = str(folder) in errors and "cannot" in errors
        test.expect(named and len(errors.splitlines()) == 1, what, "message:", errors)
        counts[f"{what}: of these refused at the start"] += 1
    else:
        test.expect(wanted[0] in (image, kept.get("out.exr")), what, "lost the image", errors)
    test.expect(code in (0, 1), what, "exit code", code, errors)
    test.expect(code == 0 or "error" in errors, what, "says nothing of exit code 1")
    test.expect("internal" not in errors, what, errors)
    temporary = [p.name for p in folder.glob("*.tmp")]
    test.expect(not temporary, what, "leaves", temporary)


def at_every_call(kind, number, wanted):
    """Calls fail one by one (the disk has room again at once), and from each on for good."""
    for how_many in (1, 0):
        at, step = 0, 1 if test.full else 7
        while True:
            at += step
            folder = test.fresh()
            log = test.folder / "calls"
            log.unlink(missing_ok=True)
            faults = {"FOLDER": folder, "AT": at, "KIND": number, "COUNT": how_many,
                      "LOG": log}
            code, errors = test.run(*command(folder), faults=faults)
            if len(log.read_text().splitlines()) < at:
                break
            check(folder, code, errors, wanted, f"{kind}, {'one call' if how_many else 'all'}")
            code, errors = test.run(*command(folder))
            test.expect(code == 0, "afterwards", code, errors)
            test.expect(result(folder) == wanted, kind, at, "differs afterwards")


def on_a_small_disk(wanted):
    """A real file system with room for less than it takes, for more, for all."""
    folder = test.fresh("disk")
    for size in (["4k", "64k", "128k", "192k", "256k", "512k"] if test.full else ["128k"]):
        mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder]
        if subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            print("left out: no right to mount a small disk")
            return
        try:
            code, errors = test.run(*command(folder))
            check(folder, code, errors, wanted, f"disk of {size}")
        finally:
            subprocess.run(["umount", folder], check=True)


def with_size_limit(wanted):
    """`ulimit -f` sends a signal, which must not kill."""
    folder = test.fresh()
    shell = f'ulimit -f 8; trap "" XFSZ; exec "$0" "$@"'
    for script in (shell, shell.replace('trap "" XFSZ; ', "")):
        process = subprocess.run(["bash", "-c", script, test.lanelight,
                                  *map(str, command(folder))], env={"TMPDIR": "/nowhere"},
                                 capture_output=True, text=True, check=False)
        test.expect(process.returncode == 1 and "File too large" in process.stderr,
                    "ulimit -f:", process.returncode, process.stderr)
        counts["limit of a file's size: exit code 1"] += 1
    code, _ = test.run(*command(folder))
    test.expect(code == 0 and result(folder) == wanted, "after ulimit -f")


def vanishing_folder():
    """The state's folder goes away in the middle, and comes back, or not."""
    for comes_back in (True, False):
        folder = test.fresh()
        states = folder / "states"
        states.mkdir()
        long = render("plain", 8192 if test.full else 2048, *outputs(folder), "--checkpoint",
                      states / "s", "--every", 0.05)
        process = test.start(*long)
        test.expect(wait_for((states / "s").exists), "no state")
        while states.exists():  # the next state may be written meanwhile
            shutil.rmtree(states, ignore_errors=True)
        line = process.stderr.readline()
        test.expect("warning: " in line and "No such file" in line, "warning:", line)
        if comes_back:
            states.mkdir()
            test.expect(wait_for((states / "s").exists), "no state in the new folder")
        errors = process.communicate()[1]
        code = process.returncode
        counts[f"folder {'vanishes, is back' if comes_back else 'vanishes'}: "
               f"exit code {code}"] += 1
        kept = elsewhere()
        if comes_back:
            test.expect(code == 0 and not kept, "exit code", code, errors)
        else:
            test.expect(code == 1 and "s" in kept, "exit code", code, errors, list(kept))
            test.expect("could not be written" in errors, "message:", errors)
        test.expect((folder / "out.exr").exists(), "no image")


def read_only_folder():
    """Refused before anything is rendered."""
    folder = test.fresh("disk")
    subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", folder], check=False,
                   capture_output=True)
    mounted = subprocess.run(["umount", folder], capture_output=True, check=False)
    if mounted.returncode != 0:
        print("left out: no right to mount a read-only disk")
        return
    subprocess.run(["mount", "-t", "tmpfs", "-o", "ro", "tmpfs", folder], check=True)
    try:
        good = test.fresh()
        code, errors = test.run(*render("plain", 8, *outputs(good), "--checkpoint",
                                        folder / "s"))
        test.expect(code == 1 and "Read-only file system" in errors, code, errors)
        test.expect(not (good / "out.exr").exists(), "rendered even so")
        counts["read-only folder: exit code 1"] += 1
    finally:
        subprocess.run(["umount", folder], check=True)


undisturbed = test.fresh("undisturbed")
test.good(*render("plain", SPP, *outputs(undisturbed)))
expected = result(undisturbed)
at_every_call("full disk", errno.ENOSPC, expected)
if test.full:
    at_every_call("disk takes nothing", errno.EROFS, expected)
    at_every_call("disk fails", errno.EIO, expected)
on_a_small_disk(expected)
with_size_limit(expected)
vanishing_folder()
read_only_folder()
for name in sorted(counts):
    print(f"{counts[name]:6d}  {name}")
test.end()
