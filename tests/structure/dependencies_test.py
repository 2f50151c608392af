#!/usr/bin/env python3
"""What a change of a header compiles again: dependencies_test.py BUILD_FOLDER [--table]

Reads the dependencies that compilers have written for Ninja, for all objects of the
program `lanelight`. Kernels read plain data, and depend on nothing that reads files or
builds tables. No header outside src/base and src/vocabulary is read by more than a third
of the objects. First of all violations are planted and found. --table prints the headers
that most objects read.
"""
import collections
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
KERNEL = re.compile(r"lanelight_kernels\.dir/.*\.o(bj)?$")
NOT_FOR_KERNELS = ("src/scene/description/", "src/scene/parse/", "src/scene/accel/",
                   "src/scene/compile/", "src/base/image/", "src/scene/compiled/scene.h",
                   "src/scene/compiled/view.h", "src/scene/prepare/prepared_scene.h")
ANYWHERE = ("src/base/", "src/vocabulary/")
# Headers that more may read, and why.
WIDE = {"kernels/simd/target.h":
        "plans and jobs name their SIMD target; it includes nothing of the project"}
SKIPPED = 77


def read_dependencies(text, root):
    """The output of `ninja -t deps`: object -> headers of the project."""
    objects, headers = {}, set()
    for line in text.splitlines():
        if line.startswith("    "):
            path = pathlib.PurePosixPath(line.strip())
            if path.is_relative_to(root):
                headers.add(str(path.relative_to(root)))
        elif ": #deps" in line:
            headers = objects.setdefault(line.split(":")[0], set())
    return {name: {h for h in all_of if h.endswith(".h") and h.startswith(("src/", "kernels/"))}
            for name, all_of in objects.items()}


def readers(objects):
    """Headers with the number of objects that read them, most first."""
    return collections.Counter(h for all_of in objects.values() for h in all_of).most_common()


def faults(objects):
    """What is wrong, as lines."""
    wrong = []
    for name, headers in sorted(objects.items()):
        if KERNEL.search(name):
            wrong += [f"{name} depends on {h}: kernels read plain data, of headers in "
                      "src/scene/compiled and src/scene/geometry"
                      for h in sorted(headers) if h.startswith(NOT_FOR_KERNELS)]
    for header, count in readers(objects):
        if 3 * count > len(objects) and not header.startswith(ANYWHERE) and header not in WIDE:
            wrong.append(f"{header} is read by {count} of {len(objects)} objects: more than a "
                         "third; declare types instead, or split it")
    return wrong


def check_planted():
    kernel = "CMakeFiles/lanelight_kernels.dir/generated/kernels_media_1.cc.o"
    text = (f"{kernel}: #deps 3, deps mtime 1 (VALID)\n    /r/kernels/a.h\n    /usr/b.h\n"
            "    /r/src/scene/compiled/media.h\n\nother.o: #deps 0, deps mtime 1 (VALID)\n\n"
            "third.cc.o: #deps 1, deps mtime 1 (VALID)\n    /r/src/base/core/vec.h\n")
    objects = read_dependencies(text, "/r")
    assert objects == {kernel: {"kernels/a.h", "src/scene/compiled/media.h"}, "other.o": set(),
                       "third.cc.o": {"src/base/core/vec.h"}}, objects
    assert not faults(objects)
    for header in ("src/scene/description/description.h", "src/base/image/exr.h",
                   "src/scene/accel/build.h", "src/scene/parse/lex.h"):
        planted = {**objects, kernel: objects[kernel] | {header}}
        assert any(header in line for line in faults(planted)), header
    wide = {**objects, "other.o": {"kernels/a.h"}}
    assert [line.split()[0] for line in faults(wide)] == ["kernels/a.h"], faults(wide)


def ninja(build, *arguments):
    run = subprocess.run(["ninja", "-C", build, *arguments], capture_output=True, text=True)
    return run.stdout if run.returncode == 0 else ""


def skip(why):
    print(f"skipped: {why}")
    return SKIPPED


def main():
    check_planted()
    build = pathlib.Path(sys.argv[1])
    if not (build / "build.ninja").exists() or not shutil.which("ninja"):
        return skip("dependencies are read from builds by Ninja only")
    ours = set(ninja(build, "-t", "inputs", "lanelight").split())
    objects = {name: headers
               for name, headers in read_dependencies(ninja(build, "-t", "deps"), ROOT).items()
               if name in ours and not name.endswith((".pch", ".gch"))}
    if not any(KERNEL.search(name) for name in objects):
        return skip("this version of Ninja does not list the objects of the program")
    if "--table" in sys.argv:
        print("\n".join(f"{count:4} of {len(objects)}  {header}"
                        for header, count in readers(objects)[:40]))
    wrong = faults(objects)
    print("\n".join([*wrong, f"{len(objects)} objects"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
