#!/usr/bin/env python3
"""No two files define a type of one name in one namespace: one_definition_test.py

A linker keeps one of two functions of equal names, so that the destructor of one type would
be called for another (ISO C++ [basic.def.odr]); no compiler sees both. Types in anonymous
namespaces and inside of others cannot clash. First of all a clash is planted and found.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("src", "kernels", "tests", "bench")
OPENS = re.compile(r"\s*namespace\s*([\w:]*)\s*\{")
CLOSES = re.compile(r"\}\s*// namespace")
TYPE = re.compile(r"(?:template\s*<.*>\s*)?(?:struct|class|union|enum(?: class| struct)?)\s+"
                  r"(?:alignas\([^)]*\)\s*)?(\w+)\b(?!\s*<)[^;({:]*(?::[^:;{]*)?\{")


def types(text):
    """Names of the types that a file defines for others, with their namespaces."""
    spaces = []
    for line in text.splitlines():
        if match := OPENS.match(line):
            spaces.append(match[1])
        elif CLOSES.match(line) and spaces:
            spaces.pop()
        elif (match := TYPE.match(line)) and "" not in spaces:
            yield "::".join([*spaces, match[1]])


def clashes(files):
    """files: name -> text. The definitions that are in several, as lines."""
    where = collections.defaultdict(set)
    for name, text in files.items():
        for defined in types(text):
            where[defined].add(name)
    return [f"{name}: {', '.join(sorted(those))}"
            for name, those in sorted(where.items()) if len(those) > 1], len(where)


def main():
    one = "namespace lanelight {\nstruct Pair {\n  int a;\n};\n}  // namespace lanelight\n"
    hidden = one.replace("struct", "namespace {\nclass").replace("};", "};\n}  // namespace")
    assert clashes({"a.h": one, "b.h": one.replace("struct", "class")})[0]
    assert not clashes({"a.h": one, "b.h": hidden, "c.h": one.replace("lanelight", "other")})[0]

    files = {str(path.relative_to(ROOT)): path.read_text(encoding="utf-8")
             for folder in FOLDERS for path in sorted((ROOT / folder).rglob("*"))
             if path.suffix in (".h", ".cc")}
    wrong, count = clashes(files)
    print("\n".join([*wrong, f"{count} types of {len(files)} files"]))
    return 1 if wrong or count < 500 else 0


if __name__ == "__main__":
    sys.exit(main())
