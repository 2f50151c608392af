"""The command `lanelight plot`, which runs the modules of plots in one piece."""
import json
import os
import sys

from .draw import picture
from .plot import csv_text, figures, make
from .results import FormatError


def _write(path, content):
    """Writes a file whole or not at all; devices as they are."""
    path = os.path.realpath(path)
    if os.path.exists(path) and not os.path.isfile(path):
        with open(path, "wb") as file:
            file.write(content)
        return
    temporary = f"{path}.{os.getpid()}.0.tmp"
    try:
        with open(temporary, "xb") as file:
            file.write(content)
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)


def _run(file, figure, out, scene, everything):
    with open(file, encoding="utf-8") as stream:
        data = json.load(stream)
    if not figure:
        known = figures(data)
        widest = max(map(len, known))
        return "".join(f"{name:{widest}}  {shows}\n" for name, shows in known.items())
    plot = make(data, figure, scene, bool(everything))
    ending = os.path.splitext(out)[1][1:]
    _write(out, csv_text(plot).encode() if ending == "csv" else picture(plot, ending))
    return ""


def main(file, figure, out, scene, everything):
    """What `lanelight plot` does: without a figure, prints which there are."""
    try:
        os.write(1, _run(file, figure, out, scene, everything).encode())
    except BrokenPipeError:
        pass
    except ImportError as error:
        # The python3 of PATH may be another one than the system's, which has its packages.
        system = "/usr/bin/python3"
        if (os.path.exists(system)
                and os.path.realpath(system) != os.path.realpath(sys.executable)):
            os.execv(system, [system, *sys.orig_argv[1:]])
        return (f"error: {error}: drawing needs matplotlib; install python3-matplotlib "
                "(Debian), or write .csv")
    except FormatError as error:
        return f"error: '{file}' {error}"
    except OSError as error:
        return f"error: cannot write '{out}': {error.strerror}"
    except UnicodeDecodeError:
        return f"error: '{file}' is not JSON: it is not a text file"
    except json.JSONDecodeError as error:
        return f"error: '{file}' is not JSON: {error}"
    except KeyError as error:
        return f"error: '{file}' is damaged: it has no member {error}"
    except IndexError:
        return f"error: '{file}' is damaged: a list in it is empty"
    except (TypeError, ValueError, AttributeError) as error:
        return f"error: '{file}' is damaged: {type(error).__name__}: {error}"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
