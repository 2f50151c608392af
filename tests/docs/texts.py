"""What a page or a source says in prose and in code: the texts that links_test.py reads."""
import io
import pathlib
import re
import tokenize

# Markdown: fences, blocks indented after an empty line, then spans of code.
FENCE = re.compile(r"^ {0,3}```.*?^ {0,3}```$", re.M | re.S)
SPAN = re.compile(r"(?<!`)`(?!`)((?:[^`\n]|\n(?!\n))+)`(?!`)")


class Page:
    """A page of Markdown, cut into its prose, its spans of code and its lines of code."""

    def __init__(self, text):
        self.headings = []
        self.spans = []       # (line number, code), of one line
        self.code_lines = []  # (line number, code), lines that \\ continues are one
        prose, block = [], []
        fenced, before = False, ""
        for number, line in enumerate(text.split("\n"), 1):
            fence = line.lstrip().startswith("```")
            indented = line.startswith("    ") and not fenced and (
                block and block[-1][0] == number - 1 or not before.strip())
            if fenced and not fence or indented:
                block.append((number, line.strip()))
                line = ""
            elif block:
                self._add(block)
                block = []
            if fence:
                fenced, line = not fenced, ""
            if heading := re.match(r"#+ +(.*)", line):
                self.headings.append(heading[1])
            before = "" if indented else line
            prose.append(line)
        self._add(block)
        self.prose = "\n".join(prose)  # with spans, without blocks of code
        for match in SPAN.finditer(self.prose):
            number = self.prose.count("\n", 0, match.start()) + 1
            self.spans.append((number, " ".join(match[1].split())))

    def _add(self, block):
        whole = ""
        for number, line in block:
            whole = whole[:-1].rstrip() + " " + line if whole.endswith("\\") else line
            if not whole.endswith("\\"):
                self.code_lines.append((number, whole.strip()))

    def without_code(self):
        """The prose with spans of code blanked, where links are looked for."""
        return SPAN.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), self.prose)


CPP = re.compile(
    r'//(?P<line>[^\n]*)|/\*(?P<block>.*?)\*/|R"\((?P<raw>.*?)\)"'
    r'|"(?P<string>(?:\\.|[^"\\\n])*)"' r"|'(?:\\.|[^'\\\n])'", re.S)


def cpp(text):
    """[(line number, comment)], [(line number, string)] of C++."""
    comments, strings = [], []
    for match in CPP.finditer(text):
        number = text.count("\n", 0, match.start()) + 1
        kind = match.lastgroup
        if kind in ("line", "block"):
            lines = match[kind].split("\n")
            comments += [(number + i, line) for i, line in enumerate(lines)]
        elif kind:
            strings.append((number, match[kind]))
    return comments, strings


def python(text):
    """Comments and strings that stand alone, as those that document."""
    comments, fresh, depth = [], True, 0
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            comments.append((token.start[0], token.string))
        elif token.type == tokenize.OP:
            depth += (token.string in "([{") - (token.string in ")]}")
        elif token.type == tokenize.STRING and fresh and depth == 0:
            comments += [(token.start[0] + i, line)
                         for i, line in enumerate(token.string.split("\n"))]
        fresh = token.type in (tokenize.INDENT, tokenize.DEDENT, tokenize.NEWLINE,
                               tokenize.NL, tokenize.ENCODING, tokenize.COMMENT)
    return comments


def hashes(text):
    """Comments of shells, CMake and scenes, which begin with #."""
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        if match := re.search(r"(?:^|\s)#(?!\w+!)(.*)", line):
            found.append((number, match[1]))
    return found


def comments(path, text):
    """[(line number, comment)] of a source; None if it is none that has any."""
    name = pathlib.PurePath(path)
    if name.suffix in (".cc", ".h"):
        return cpp(text)[0]
    if name.suffix == ".py" or text.startswith("#!/usr/bin/env python3"):
        return python(text)
    if name.suffix in (".sh", ".cmake", ".sbatch", ".pbrt", ".toml", ".zsh") or (
            name.name in ("run", "CMakeLists.txt", "Snakefile") or text.startswith("#!")):
        return hashes(text)
    return None
