"""Reads the JSON that studies, sweeps, benches and profiles write."""
import json
import os
import pathlib

SCHEMAS = {"study": 1, "sweep": 2, "bench": 1, "profile": 1}


class FormatError(ValueError):
    """A file of another kind, or with something that this package does not read."""


def kind_of(data):
    """Returns the command that wrote this JSON, or "" for other content."""
    if not isinstance(data, dict):
        return ""
    kind = str(data.get("kind", "")).removeprefix("lanelight-")
    if kind in SCHEMAS:
        return kind
    return "bench" if "rows" in data and "program" in data else ""


def check_schema(data, kind):
    """Raises FormatError for the JSON of another version of that command."""
    if data["schema"] != SCHEMAS[kind]:
        raise FormatError(f"has schema {data['schema']}; this version reads schema "
                          f"{SCHEMAS[kind]}")


def _read_json(path, kind):
    try:
        data = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        found = kind_of(data)
        if found == kind:
            check_schema(data, kind)
            return data
        reason = f"`lanelight {found}` wrote it" if found else "it is other JSON"
    except (ValueError, KeyError) as error:
        reason = str(error)
    raise FormatError(f"{path}: not the JSON of `lanelight {kind}`: {reason}")


def read_study(path: str | os.PathLike) -> dict:
    """Returns study.json as dictionaries and lists (docs/study.md)."""
    return _read_json(path, "study")


def read_sweep(path: str | os.PathLike) -> dict:
    """Returns sweep.json as dictionaries and lists (docs/sweep.md)."""
    return _read_json(path, "sweep")


def read_bench(path: str | os.PathLike) -> dict:
    """Returns the output of `lanelight bench --json` as dictionaries and lists."""
    return _read_json(path, "bench")


def read_profile(path: str | os.PathLike) -> dict:
    """Returns the output of `lanelight profile --json` (docs/profile.md)."""
    return _read_json(path, "profile")
