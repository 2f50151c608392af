#!/usr/bin/env python3
"""Finds what pages and comments name and is not there: links_test.py LANELIGHT

In the pages (README.md, CONTRIBUTING.md, docs/, ...): links to pages and headings that do not
exist, commands that the program has not, flags that their command has not. There and in the
comments of all sources: files that do not exist, and flags that nothing here has.

A flag of another program is listed below with the reason; so is a file of one. First of all
the test plants one mistake of each kind into a small tree and has to find each.
"""
import fnmatch
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unicodedata

import texts

# --flags of other programs that pages and comments speak of.
OTHER_FLAGS = {
    "array": "Slurm's sbatch", "signal": "Slurm's sbatch", "kill-on-bad-exit": "Slurm's srun",
    "joblog": "GNU parallel", "resume-failed": "GNU parallel", "retries": "GNU parallel",
    "termseq": "GNU parallel", "mca": "Open MPI's mpirun", "install": "cmake",
    "component": "cmake --install", "flag": "stands for any (src/cli/completion_bash.cc)"}
# Files that are not of this tree.
OTHER_FILES = {}
# "lanelight WORD" that is no command.
NO_COMMANDS = {"state": "the first bytes of a state file (docs/state.md)"}

OWN = "tests/docs/links_test.py"
PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "*/README.md", "docs/*.md")
FOLDERS = ("src", "kernels", "tests", "bench", "scenes", "docs", "cmake", "packaging")
SUFFIXES = "h|cc|md|py|sh|cmake|sbatch"
FLAG = re.compile(r"(?<![\w-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)(?![\w-])")
NAME = re.compile(r"(?<![\w./<>{}$~@=-])((?:[\w.*-]+/)*[\w.*-]*[\w*]\.(?:" + SUFFIXES +
                  r"))(?![\w/<-])")
PLACE = re.compile(r"(?<![\w./<>{}$~@=-])((?:" + "|".join(FOLDERS) +
                   r")/[\w.*/-]*[\w*])(?![\w<{*])")
LINK = re.compile(r"\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^()\s]+)\)")
ATTRIBUTE = re.compile(r'<[^>]*\b(?:src|href)="([^"]+)"')


def slugs(heading):
    """The anchors of a heading: on the repository's pages, and in the site of mkdocs."""
    plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "")
    there = re.sub(r"[^\w\s-]", "", plain.lower()).strip().replace(" ", "-")
    ascii_only = unicodedata.normalize("NFKD", plain).encode("ascii", "ignore").decode()
    site = re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", ascii_only).strip().lower())
    return there, site


class Tree:
    """The files of a checkout, without what was built."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.files, self.folders = set(), set()
        for folder, folders, files in os.walk(root):
            here = pathlib.Path(folder).relative_to(root)
            folders[:] = [f for f in folders if f not in (".git", "__pycache__") and
                          not (folder == str(root) and f in ("build", "out"))]
            self.folders.update(str(here / f) for f in folders)
            self.files.update(str(here / f) for f in files)
        self.names = {}
        for path in self.files:
            self.names.setdefault(path.rsplit("/", 1)[-1], []).append("/" + path)

    def read(self, path):
        return (self.root / path).read_text(encoding="utf-8", errors="replace")

    def pages(self):
        return sorted(f for f in self.files if any(
            fnmatch.fnmatchcase(f, p) and f.count("/") == p.count("/") for p in PAGES))

    def has(self, name):
        """A file whose path ends so; * stands for anything within a name."""
        last = name.rsplit("/", 1)[-1]
        if "*" not in name:
            return any(p.endswith("/" + name) for p in self.names.get(last, ()))
        return any(fnmatch.fnmatchcase(p, "*/" + name)
                   for paths in self.names.values() for p in paths)

    def has_place(self, path):
        """This file or folder; tests may go by their name without an ending."""
        if "*" in path:
            return any(fnmatch.fnmatchcase(f, path) for f in self.files | self.folders)
        return path in self.folders or any(
            above + path + end in self.files
            for above in ("", "tests/") for end in ("", ".cc", ".py", ".h"))


class Words:
    """What can be said on the command lines of this tree's programs."""

    def __init__(self, commands, run, tools):
        self.commands = commands  # of lanelight: {name: flags}
        self.run = run            # of ./run: names
        self.flags = set(tools).union(*commands.values())


def ask(binary, *arguments):
    return subprocess.run([binary, *arguments], capture_output=True, text=True,
                          timeout=60, check=False)


def flags_of(text):
    return set(re.findall(r"^ +(?:-\w,)?--([a-z0-9-]+)", text, re.M))


def commands_of(binary):
    listing = ask(binary, "--help").stdout
    listing = listing[listing.index("Subcommands:"):].split("\n\n")[0]
    names = re.findall(r"^  ([a-z]+) ", listing, re.M)
    commands = {name: flags_of(ask(binary, name, "--help").stdout) for name in names}
    if ask(binary, "help").returncode == 0:
        commands["help"] = {"help"}
    return commands


def words_of(tree, binary):
    run = tree.read("run")
    usage = run[run.index("usage: ./run"):run.index("\nEND")]
    tools = set(re.findall(r"--([a-z][a-z0-9-]*)", usage))
    for path in tree.files:
        if re.match(r"(bench|scenes|tests|packaging|docs)/", path) and not path.endswith(
                (".md", ".ply", ".tga", ".nvdb", ".png", ".exr")):
            tools.update(re.findall(r"[\"'](?:-\w, ?)?--([a-z][a-z0-9-]*)[\"',= ]",
                                    tree.read(path)))
    names = {"help", *re.findall(r"^  ([a-z0-9]+) ", usage, re.M)}
    return Words(commands_of(binary), names, tools)


class Check:
    """Goes through a tree; `found` are (file, line, what is wrong)."""

    def __init__(self, tree, words, allowed=({}, {}, {})):
        self.tree, self.words = tree, words
        self.flags, self.files, self.no_commands = allowed
        self.used, self.found = set(), []
        self.anchors = {}
        for page in tree.pages():
            self.page(page)
        for path in sorted(tree.files):
            # Not of this test, which names what is not there.
            if path != OWN and (path.startswith(FOLDERS) or path in ("run", "CMakeLists.txt")):
                self.source(path)

    def say(self, path, number, what):
        if (path, number, what) not in self.found:
            self.found.append((path, number, what))

    def allows(self, table, name):
        if name in table:
            self.used.add(name)
        return name in table

    def page(self, path):
        page = texts.Page(self.tree.read(path))
        for number, line in enumerate(page.prose.split("\n"), 1):
            self.names(path, number, re.sub(r"\]\([^()\s]+\)|<[^>]*>", ">", line))
        for number, line in enumerate(page.without_code().split("\n"), 1):
            for target in ATTRIBUTE.findall(line):
                self.link(path, number, target)
        prose = page.without_code()
        for match in LINK.finditer(page.prose):
            # Not within a span, but spans may be within its text.
            if prose[match.end() - 1] == ")":
                self.link(path, prose.count("\n", 0, match.start(1)) + 1, match[1])
        for number, code in page.spans:
            self.command_line(path, number, code)
        for number, line in page.code_lines:
            self.names(path, number, line)
            self.command_line(path, number, line)

    def link(self, path, number, target):
        if re.match(r"[a-z]+:", target):
            return
        place, _, anchor = target.partition("#")
        there = os.path.normpath(os.path.join(os.path.dirname(path), place)) if place else path
        if there not in self.tree.files and there not in self.tree.folders:
            self.say(path, number, f"dead link: {target}")
        elif anchor and there.endswith(".md"):
            if there not in self.anchors:
                headings = texts.Page(self.tree.read(there)).headings
                self.anchors[there] = {s[0] for s in map(slugs, headings) if s[0] == s[1]}
            if anchor not in self.anchors[there]:
                self.say(path, number, f"no such heading: {target}")

    def source(self, path):
        text = self.tree.read(path)
        comments = texts.comments(path, text)
        for number, line in comments or ():
            self.names(path, number, line)
            # Scripts for schedulers speak of the schedulers' flags; tests/cluster/ runs them.
            for flag in FLAG.findall(line) if not path.startswith("docs/cluster/") else ():
                self.flag(path, number, flag)
        if path.startswith("src/") and path.endswith(".cc"):
            for number, string in texts.cpp(text)[1]:
                for name in re.findall(r"docs/[\w/-]+\.md", string):
                    self.names(path, number, name)

    def names(self, path, number, line):
        line = re.sub(r"https?://\S+", "", line)
        for name in NAME.findall(line):
            if re.match(r"[A-Z]+\.", name.rsplit("/", 1)[-1]) and not self.tree.has(name):
                continue  # FILE.h stands for one
            if not self.tree.has(name) and not self.allows(self.files, name):
                self.say(path, number, f"no such file: {name}")
        for place in PLACE.findall(line):
            if not self.tree.has_place(place) and not self.allows(self.files, place) and (
                    not NAME.match(place)):
                self.say(path, number, f"no such file: {place}")

    def flag(self, path, number, flag, command=None):
        known = self.words.commands[command] if command else self.words.flags
        if flag not in known and (command or not self.allows(self.flags, flag)):
            of = f" of lanelight {command}" if command else ""
            self.say(path, number, f"no such flag{of}: --{flag}")

    def command_line(self, path, number, code):
        code = re.split(r"\s#\s", code)[0]
        for part in re.split(r"&&|\|\|| \| |;(?![^']*'(?:[^']*'[^']*')*[^']*$)", code):
            self.one_command(path, number, part.strip())

    def one_command(self, path, number, code):
        commands = self.words.commands
        if match := re.search(r"(?:^|[ /])lanelight ([a-z]+)(?![\w.])(.*)", code):
            command, rest = match[1], match[2]
            if command not in commands:
                if not self.allows(self.no_commands, command):
                    self.say(path, number, f"no such command: lanelight {command}")
                return
        elif match := re.match(r"([a-z]+)( --?\w.*)", code):
            command, rest = match[1], match[2]
            if command not in commands:
                return  # of another program
        elif match := re.match(r"\./run ([a-z]+)(.*)", code):
            if match[1] not in self.words.run:
                self.say(path, number, f"no such command: ./run {match[1]}")
            command, rest = None, match[2]
        elif code.startswith("--"):
            command, rest = None, code
        else:
            return
        for flag in FLAG.findall(rest):
            self.flag(path, number, flag, command)


def write(root, files):
    for name, text in files.items():
        path = pathlib.Path(root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


# A small tree in which all is well, ...
GOOD = {
    "README.md": "# Top\n\nSee [a page](docs/a.md#its-end), `src/a.h`, `a.h`, `src/*.cc`.\n\n"
                 "    lanelight render x.pbrt --spp 4 \\\n      --png\n\n"
                 "`--spp` and `./run test --full`; `cmake --preset x`, `FILE.h`.\n"
                 "`lanelight state`; `render --spp\n4`. <img src=\"docs/a.md\">\n",
    "docs/a.md": "# A\n\n## Its end\n\n[Up](../README.md) [here](#a)\n\n- item\n\n"
                 "  more of it, not code: `--png`\n",
    "src/a.h": "// See b.cc and docs/a.md; --png.\n",
    "src/b.cc": "const char* kText = \"// not.h a comment; docs/a.md\";  /* a.h */\n",
    "run": "# a.h\nusage: ./run COMMAND\n  test [--full]   tests\nEND\n",
}
# ... and mistakes: the file, the line that is added, what has to be found.
PLANTED = [
    ("README.md", "[x](docs/none.md)", "dead link: docs/none.md"),
    ("README.md", "[`x`\ny](docs/none.md)", "dead link: docs/none.md"),
    ("README.md", '<img src="docs/none.png">', "dead link: docs/none.png"),
    ("README.md", "[x](docs/a.md#none)", "no such heading: docs/a.md#none"),
    ("docs/a.md", "[x](#none)", "no such heading: #none"),
    ("README.md", "see `src/none.h`", "no such file: src/none.h"),
    ("README.md", "see src/none/", "no such file: src/none"),
    ("docs/a.md", "    cat none_*.cc", "no such file: none_*.cc"),
    ("src/a.h", "/* none.h */", "no such file: none.h"),
    ("src/a.h", "// as --none", "no such flag: --none"),
    ("src/b.cc", 'x("docs/none.md");', "no such file: docs/none.md"),
    ("run", "# none.md", "no such file: none.md"),
    ("README.md", "`--none`", "no such flag: --none"),
    ("README.md", "`./run test --none`", "no such flag: --none"),
    ("README.md", "`./run none`", "no such command: ./run none"),
    ("README.md", "`lanelight none`", "no such command: lanelight none"),
    ("README.md", "`plan --spp 3`", "no such flag of lanelight plan: --spp"),
    ("README.md", "`x && lanelight plan\na.pbrt --spp 3`", "no such flag of lanelight plan: --spp"),
    ("docs/a.md", "    lanelight render x \\\n      --none", "no such flag of lanelight render: --none"),
    ("docs/a.md", "```\nlanelight render x --none\n```",
     "no such flag of lanelight render: --none"),
]


def found_in(files):
    words = Words({"render": {"spp", "png"}, "plan": {"help"}}, {"test"}, {"full"})
    with tempfile.TemporaryDirectory() as root:
        write(root, files)
        return [f"{file}: {what}" for file, _, what in
                Check(Tree(root), words, ({}, {}, NO_COMMANDS)).found]


def test_of_itself():
    assert found_in(GOOD) == [], found_in(GOOD)
    for file, line, what in PLANTED:
        found = found_in({**GOOD, file: GOOD[file] + "\n" + line + "\n"})
        assert found == [f"{file}: {what}"], (line, found)
    print(f"{len(PLANTED)} planted mistakes, each was found")


def main():
    test_of_itself()
    tree = Tree(pathlib.Path(__file__).resolve().parents[2])
    allowed = (OTHER_FLAGS, OTHER_FILES, NO_COMMANDS)
    check = Check(tree, words_of(tree, sys.argv[1]), allowed)
    for file, number, what in check.found:
        print(f"{file}:{number}: {what}")
    unused = [name for table in allowed for name in table if name not in check.used]
    for name in unused:
        print(f"{OWN}: {name} is not mentioned any more: remove it")
    sys.exit(1 if check.found or unused else 0)


if __name__ == "__main__":
    main()
