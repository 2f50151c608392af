"""Renders a scene with the program and returns the image."""
import json
import os
import pathlib
import shutil
import tempfile
import typing
import warnings

from .exr import Image, read_exr
from .program import Interrupted, Outcome, execute, flags_of, shows

# With these exit codes the image is complete, and a message says what is wrong with it:
# invalid samples, a missed target, parts of the scene that were left out.
IMAGE_CODES = (0, 3, 5, 8)


def render(scene: str | os.PathLike, *, spp: int | str | None = None,
           strategy: str | None = None, output: str | os.PathLike | None = None,
           profile: bool = False, program: str | os.PathLike | None = None,
           progress: bool | None = None, **flags: typing.Any) -> Image:
    """Renders a scene and returns its Image.

    scene: name of a pbrt-v4 file, or the text of one (then with absolute file names).
    output: name of the EXR to write; by default, no file is kept.
    profile: whether image.profile has the cost of each stage.
    program: name of the program, see find_program. progress: whether to show it.
    flags: those of `lanelight render --help`: time="1m", max_depth=3, aov=True.

    Raises Error with the program's message. If the image is complete but the program has an
    objection, such as a missed target, that is a warning. Ctrl-C raises Interrupted with the
    image so far, whose file is kept.
    """
    if "json" in flags:
        raise TypeError("render() has no json=: image.report is that report")
    folder = pathlib.Path(tempfile.mkdtemp(prefix="lanelight-"))
    kept = False
    try:
        if isinstance(scene, str) and ("\n" in scene or "WorldBegin" in scene):
            (folder / "scene.pbrt").write_text(scene, encoding="utf-8")
            scene = folder / "scene.pbrt"
        settings = {"spp": spp, "strategy": strategy, "png": folder / "image.png",
                    "quiet": not shows(progress), **flags,
                    "output": output or folder / "image.exr", "json": "-"}
        done = execute(["render", scene, *flags_of(settings)], program, progress)
        image = _image(done, profile)
        if done.interrupted:
            kept = image is not None and output is None
            raise _interrupted(image)
        if image is None or done.code not in IMAGE_CODES:
            raise done.error()
        for line in done.messages:
            if line.startswith(("error: ", "warning: ")):
                warnings.warn(line, stacklevel=2)
        return image
    finally:
        if not kept:
            shutil.rmtree(folder, ignore_errors=True)


def _image(done: Outcome, profile: bool) -> Image | None:
    """Returns the image that the report names, if one was written."""
    if not done.output.startswith("{"):
        return None
    report = json.loads(done.output)
    files = report["output"]
    if not files["exr"]:
        return None
    image = read_exr(files["exr"])
    image.report = report
    if files["png"]:
        image.png = pathlib.Path(files["png"]).read_bytes()
    if profile:
        image.profile = {stage["name"]: stage for stage in report["stages"]}
    return image


def _interrupted(image: Image | None) -> Interrupted:
    if image is None:
        return Interrupted("stopped before the first sample: there is no image")
    path = pathlib.Path(image.report["output"]["exr"])
    return Interrupted(f"stopped after {image.attributes['spp']:.3g} samples per pixel; the "
                       f"image so far is '{path}'", path, image)
