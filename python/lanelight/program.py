"""Runs the program `lanelight`, shows its progress, and turns its errors into exceptions."""
import codecs
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import typing

ERASE = "\r\x1b[K"  # the program writes this before each drawing of its bar


class Error(RuntimeError):
    """The message of the program. exit_code: see docs/output.md; None if it did not start."""

    def __init__(self, message: str, exit_code: int | None = None) -> None:
        super().__init__(message)
        self.exit_code = exit_code


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped the program. path: the image so far; image: its content. Both are None
    without samples."""

    def __init__(self, message: str, path: pathlib.Path | None = None,
                 image: typing.Any = None) -> None:
        super().__init__(message)
        self.path, self.image = path, image


class Outcome(typing.NamedTuple):
    """What a run of the program left."""
    code: int
    output: str  # standard output
    messages: list  # lines of standard error, without the progress
    interrupted: bool

    def error(self) -> Error:
        """Returns the exception for this outcome."""
        lines = [line for line in self.messages if "note: " not in line]
        return Error("\n".join(lines) or f"lanelight ended with code {self.code}", self.code)


def find_program(program: str | os.PathLike | None = None) -> str:
    """Returns `program`, else the environment variable LANELIGHT, else the program beside this
    package (built in the same checkout, or installed with the same prefix), else that of PATH.
    Raises Error if there is none."""
    folder = pathlib.Path(__file__).resolve().parent
    beside = (os.path.normpath(folder / place)
              for place in ("../../build/release/lanelight", "../../../../bin/lanelight"))
    found = (program or os.environ.get("LANELIGHT")
             or next(filter(os.path.isfile, beside), None) or shutil.which("lanelight"))
    if not found:
        raise Error("the program 'lanelight' was not found: build it with `./run build`, or "
                    "name it with program= or the environment variable LANELIGHT")
    return os.fspath(found)


def flags_of(settings: dict) -> list:
    """Returns the flags for keywords: max_depth=3 is --max-depth=3, True a flag without a
    value, a list its values with commas. None and False leave the flag out."""
    flags = []
    for name, value in settings.items():
        flag = "--" + name.replace("_", "-")
        if isinstance(value, (list, tuple)):
            value = ",".join(map(str, value))
        if value is not None and value is not False:
            flags.append(flag if value is True else f"{flag}={value}")
    return flags


def shows(progress: bool | None) -> bool:
    """Returns whether progress is shown: None decides for terminals and notebooks."""
    return (sys.stderr.isatty() or _in_notebook()) if progress is None else progress


def _in_notebook() -> bool:
    return "ipykernel" in sys.modules


class _Screen:
    """Splits the program's standard error into its bar, which is shown, and messages."""

    def __init__(self, is_shown: bool) -> None:
        self.messages: list = []
        self._is_shown, self._line, self._drawn = is_shown, "", 0
        self._cell: typing.Any = None  # the notebook's output that is the bar

    def add(self, text: str) -> None:
        *lines, self._line = (self._line + text).split("\n")
        for line in lines:
            line = line.rsplit(ERASE)[-1].strip("\r")
            if re.match(r"\[[#.]| *\d+ %", line):
                self._draw(line, "\n")
                continue
            self._draw("")
            if line:
                self.messages.append(line)
            # Errors and warnings reach the caller as exceptions and warnings.
            if self._is_shown and re.search("note: |^stopping: ", line):
                print(line, file=sys.stderr)
        if ERASE in self._line:
            self._draw(self._line.rsplit(ERASE)[-1])

    def _draw(self, text: str, end: str = "") -> None:
        if not self._is_shown:
            return
        if not _in_notebook():
            print("\r" + " " * self._drawn + "\r" + text, end=end, file=sys.stderr, flush=True)
            self._drawn = 0 if end else len(text)
        elif self._cell:
            self._cell.update({"text/plain": text}, raw=True)
        elif text:
            from IPython.display import display
            self._cell = display({"text/plain": text}, raw=True, display_id=True)

    def follow(self, process: subprocess.Popen, errors: int) -> bool:
        """Reads until the program has ended, and passes each Ctrl-C on to it: the first one
        stops a render, a second one aborts. Returns whether there was one."""
        decoder, interrupted = codecs.getincrementaldecoder("utf-8")("replace"), False
        while True:
            try:
                try:
                    chunk = os.read(errors, 65536)
                except OSError:  # Linux reports the end of a terminal so.
                    return interrupted
                self.add(decoder.decode(chunk))
            except KeyboardInterrupt:
                interrupted = True
                process.send_signal(signal.SIGINT)


def execute(arguments: list, program: str | os.PathLike | None = None,
            progress: bool | None = None) -> Outcome:
    """Runs the program with these arguments."""
    command = [find_program(program), *map(str, arguments)]
    columns = str(shutil.get_terminal_size().columns)
    environment = {**os.environ, "NO_COLOR": "1", "TERM": "xterm", "COLUMNS": columns}
    screen = _Screen(shows(progress))
    # On a terminal the program draws a bar. It has a session of its own: otherwise the Ctrl-C
    # of a shell would reach it twice, once from the shell and once from here.
    errors, terminal = os.openpty()
    with tempfile.TemporaryFile() as output:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output,
                                       stderr=terminal, env=environment,
                                       start_new_session=True)
        except OSError as error:
            os.close(errors)
            raise Error(f"cannot start '{command[0]}': {error.strerror}") from error
        finally:
            os.close(terminal)
        try:
            interrupted = screen.follow(process, errors)
            code = process.wait()
        finally:
            process.kill()
            os.close(errors)
        output.seek(0)
        return Outcome(code, output.read().decode(errors="replace"), screen.messages,
                       interrupted)


def run(command: str, *arguments: str | os.PathLike,
        program: str | os.PathLike | None = None, progress: bool | None = None,
        **flags: typing.Any) -> str:
    """Runs a command of the program and returns what it prints.

    run("study", "scene.pbrt", out="study", spp=(1, 4, 16)) runs
    `lanelight study scene.pbrt --out=study --spp=1,4,16`. Raises Error with the program's
    message, and Interrupted after Ctrl-C.
    """
    done = execute([command, *arguments, *flags_of(flags)], program, progress)
    if done.interrupted:
        raise Interrupted("\n".join(done.messages))
    if done.code:
        raise done.error()
    return done.output
