#!/usr/bin/env python3
"""Functions with more than five parameters stay few: parameters_test.py

What a function takes is read from the text: a name and a list in parentheses of which every
part is a type and a name, followed by what may follow a parameter list. First of all
functions with five and six parameters are planted, and a call with six arguments.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("src", "kernels")
MOST_PARAMETERS = 5
MOST_FUNCTIONS = 6  # lower it where there are fewer, and never raise it

DROPPED = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\])*\"|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*",
                     re.S | re.M)
BEGINS = re.compile(r"\b(?!(?:for|if|while|switch|catch)\b)(\w+)\s*\(")
FOLLOWS = re.compile(r"\s*(?:\{|;|:|->|const\b|noexcept\b|override\b|HWY_)")
PARAMETER = re.compile(r"(?:const\s+)?[\w:]+(?:\s+const)?\s*(?:[*&]+|(?:\s|[*&]+\s*)"
                       r"(?:const\s+)?\w+\s*(?:=.*)?)", re.S)


def parts(text, begin):
    """The parts between commas of a list that begins there, and where it ends."""
    found, at, depth = [""], begin, 0
    while at < len(text):
        c = text[at]
        if c == ")" and depth == 0:
            return found, at + 1
        depth += (c in "([{<") - (c in ")]}") - (c == ">" and text[at - 1] != "-" and depth > 0)
        if c == "," and depth == 0:
            found.append("")
        elif depth == 0:
            found[-1] += " " if c in ")]}>" else c
        at += 1
    return [], at


def wide_functions(text):
    """Names and numbers of parameters of functions that have too many."""
    text = DROPPED.sub(" ", text)
    for match in BEGINS.finditer(text):
        found, end = parts(text, match.end())
        if len(found) <= MOST_PARAMETERS or not FOLLOWS.match(text, end):
            continue
        if all(PARAMETER.fullmatch(part.strip()) for part in found):
            yield match[1], len(found)


def main():
    six = "int Six(const A& a, std::map<int, B> b, float c[3], int d = F(1, 2), V3 e, X* f) {"
    assert list(wide_functions(six)) == [("Six", 6)]
    assert list(wide_functions(six.replace("V3 e, ", ""))) == []
    assert list(wide_functions("void F() { return Call(a, b.c, &d, e + f, g(h), i); }")) == []

    found, files = {}, 0
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix not in (".h", ".cc"):
                continue
            files += 1
            for name, count in wide_functions(path.read_text(encoding="utf-8")):
                found.setdefault((name, count), str(path.relative_to(ROOT)))
    for (name, count), where in sorted(found.items()):
        print(f"{where}: {name} has {count} parameters")
    print(f"{len(found)} functions of {files} files have more than {MOST_PARAMETERS}")
    return 1 if len(found) > MOST_FUNCTIONS or files < 500 else 0


if __name__ == "__main__":
    sys.exit(main())
