#!/usr/bin/env python3
"""Reports text that is hard to read: style_test.py [FILE...]

Checks pages and comments: sentences of more than 30 words, comments that are fragments without
a verb, and words that have a plain equivalent. Without files it reads the whole tree. Planted
errors are tested first. Exceptions are listed below, each with its reason.
"""
import pathlib
import re
import subprocess
import sys

import texts

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAX_WORDS = 30
# Words of the glossary in CONTRIBUTING.md, as patterns: what is found, what to write.
WORDS = {
    r"nobody|somebody": "name who or what acts",
    r"what pays|it pays|does not pay|did not pay": "is more efficient, efficiency gain",
    r"(?:put|puts|putting) down|(?:pick|picks|picked) up": "checkpoint, resume",
    r"(?:hang|hangs|hung) on": "depends on",
    r"is spared|are spared": "omitted",
    r"without a word": "without a message",
    r"gone on from|go on from there": "resumed",
    r"trees over shapes": "BVH",
    r"lights? seen|seen lights?|lights? that the camera sees (?:itself|themselves)":
        "directly visible lights",
    r"serve (?:their|its) block|serves (?:their|its) block": "path reuse",
    r"contenders?|laborator(?:y|ies)|attendants?": "candidate, live server, worker",
    r"say as much as|says as much as": "is worth as much as",
}
# A comment that begins so and has no comma is a fragment.
FRAGMENT = re.compile(r"(?:Of|What|Where|Whether|By|With|Whose|How|From where) [^,?:]*[.;]?$")
# (file, text) that may stay, with the reason.
EXCEPTIONS = {}

BULLET = re.compile(r"^(?:[-*]|\d+\.) +")


def sentences(text):
    return [s for s in re.split(r"(?<=[.!?:;])\s+", text.strip()) if s]


def paragraphs(page):
    """(line number, text) of paragraphs and list items; tables and headings are left out."""
    start, lines = 0, []
    for number, line in enumerate(page.prose.split("\n") + [""], 1):
        line = line.strip()
        ends = not line or line[0] in "|#" or line.startswith("<")
        if (ends or BULLET.match(line)) and lines:
            yield start, " ".join(lines)
            lines = []
        if not ends:
            start = start if lines else number
            lines.append(BULLET.sub("", line))


def comment_blocks(path, text):
    """(line number, text) of comments; those behind code stand alone."""
    lines = text.split("\n")
    block, last = [], None
    for number, line in (texts.comments(path, text) or []) + [(None, "")]:
        behind = number is not None and not re.match(r"\s*(//|/?\*|#|\"|')", lines[number - 1])
        table = re.search(r"\S {2,}\S|^/? {3,}\S", line)
        line = re.sub(r"^[/!#]*<?\s*", "", line.strip()).strip()
        if block and (last is None or number != last + 1 or not line or behind or table):
            yield block[0][0], " ".join(part for _, part in block)
            block = []
        if line and number is not None and not table:
            block.append((number, line))
        last = None if behind else number


def long_sentences(text):
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", re.sub(r"`[^`]*`", "x", text))
    for sentence in sentences(plain):
        count = len(re.findall(r"[\w'][\w'.-]*", sentence))
        if count > MAX_WORDS and " = " not in sentence:
            yield f"sentence of {count} words: {sentence[:60]}..."


def words(text):
    for pattern, plain in WORDS.items():
        if match := re.search(rf"\b(?:{pattern})\b", text, re.I):
            yield f'"{match[0]}": write {plain}'


def fragment(text):
    first = sentences(text)
    if first and FRAGMENT.match(first[0]):
        yield f"fragment without a verb: {first[0][:60]}"


def check(path, text):
    """[(line number, what is wrong)] of a page or a source."""
    found = []
    if path.endswith(".md"):
        for number, block in paragraphs(texts.Page(text)):
            found += [(number, what) for what in (*long_sentences(block), *words(block))]
        return found
    for number, block in comment_blocks(path, text):
        found += [(number, what)
                  for what in (*long_sentences(block), *words(block), *fragment(block))]
    return [f for f in found if (path, f[1]) not in EXCEPTIONS]


GOOD = [("a.md", "Renders resume from a checkpoint. " * 9),
        ("a.md", "| What pays | nobody |\n"),
        ("a.h", "/// Returns the tiles of this rank.\n// With a target, renders stop early.\n")]
PLANTED = [("a.md", "word " * 31 + ".", "sentence of 31 words"),
           ("a.md", "- nobody knows\n", '"nobody"'),
           ("a.md", "It depends\nand hangs\non this.", '"hangs on"'),
           ("a.h", "/// Of this rank.\nint x;", "fragment"),
           ("a.h", "int x;  // What has been merged.\n", "fragment"),
           ("a.py", "# Whether it is done\n", "fragment"),
           ("a.cc", "// Where it is put down,\n// then read.\n", '"put down"')]


def test_of_itself():
    for path, text in GOOD:
        assert check(path, text) == [], (text, check(path, text))
    for path, text, what in PLANTED:
        found = check(path, text)
        assert any(f[1].startswith(what) for f in found), (text, found)


def main():
    test_of_itself()
    files = sys.argv[1:] or subprocess.run(
        ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
    total = 0
    for path in files:
        if not re.search(r"\.(md|h|cc|py|sh|cmake)$|^run$", path) or path.startswith("tests/docs/"):
            continue
        for number, what in check(path, (ROOT / path).read_text(encoding="utf-8")):
            print(f"{path}:{number}: {what}")
            total += 1
    print(f"{total} passages to rewrite")
    sys.exit(1 if total else 0)


if __name__ == "__main__":
    main()
