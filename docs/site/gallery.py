"""The gallery: a picture of each of our scenes, with what its header says of it.

Pictures are the same bits on one SIMD target, however often they are made: each ends by its
error, which does not depend on the machine's speed. Those that are newer than the program, all
scenes and this file are kept.
"""
import html
import itertools
import pathlib
import re
import shutil
import subprocess

WIDTH = 360  # pixels at most
ERROR = 0.005  # relative MSE at which a render may stop
SAMPLES = 256  # per pixel at most
NOT_REACHED = 5  # exit code: it took SAMPLES


def header(text):
    """Title, purpose and closed form: the first line, and the paragraphs that say these."""
    lines = list(itertools.takewhile(lambda line: line.startswith("#"), text.split("\n")))
    paragraphs, name = {}, None
    for line in lines[1:]:
        if match := re.match(r"# ([A-Z][a-z ]+): (.*)", line):
            name = match[1]
            paragraphs[name] = match[2]
        elif name and line.startswith("#   "):
            paragraphs[name] += " " + line[1:].strip()
        else:
            name = None
    purpose = paragraphs.get("Purpose", "")
    purpose = purpose[:1].upper() + purpose[1:]
    if not (form := paragraphs.get("Closed form", "none")).startswith("none"):
        purpose += " Closed form: " + form
    return lines[0][1:].strip().rstrip("."), html.escape(purpose)


def resolution(text):
    """The film's, made small; [] if the file does not say it."""
    size = [re.search(r'"integer %sresolution" \[? ?(\d+)' % axis, text) for axis in "xy"]
    if None in size:
        return []
    width, height = (int(match[1]) for match in size)
    scale = min(1, WIDTH / width)
    return ["--resolution", f"{round(width * scale)}x{round(height * scale)}"]


def render(lanelight, scene, picture):
    """Why there is no picture; None if there is one."""
    made = subprocess.run(
        [lanelight, "render", scene, "--quiet", "--target-relmse", str(ERROR), "--spp",
         str(SAMPLES), "--png", picture, "-o", picture.with_suffix(".exr"),
         *resolution(scene.read_text(encoding="utf-8"))],
        capture_output=True, text=True, check=False)
    picture.with_suffix(".exr").unlink(missing_ok=True)
    if made.returncode in (0, NOT_REACHED):
        return None
    picture.unlink(missing_ok=True)
    return (made.stderr.strip().split("\n") or [""])[-1]


def make(lanelight, scenes, folder, pictures=True):
    """Writes the page and its pictures into folder/pages; scenes that need data from
    elsewhere are left out."""
    kept = folder / "gallery"
    kept.mkdir(parents=True, exist_ok=True)
    newest = max(f.stat().st_mtime for f in [
        lanelight, pathlib.Path(__file__), *scenes.rglob("*")])
    page = ["# Gallery", "",
            f"Our own scenes, each rendered by `./run docs` until its relative MSE is below "
            f"{ERROR}, with {SAMPLES} samples per pixel at most. Captions are from the scenes' "
            "headers; [another page](scenes/README.md) says more.", "", '<div class="gallery">']
    for scene in sorted(scenes.glob("*.pbrt")) if pictures else []:
        picture = kept / f"{scene.stem}.png"
        if not picture.exists() or picture.stat().st_mtime < newest:
            print(f"== rendering scenes/{scene.name}", flush=True)
            if why := render(lanelight, scene, picture):
                print(f"== left out: {why}")
                continue
        (folder / "pages/gallery").mkdir(exist_ok=True)
        shutil.copy(picture, folder / "pages/gallery")
        title, purpose = header(scene.read_text(encoding="utf-8"))
        page += [f'<figure><img src="gallery/{picture.name}" alt="{title}" loading="lazy">',
                 f"<figcaption><b>{title}</b> <code>{scene.name}</code><br>{purpose}"
                 "</figcaption></figure>"]
    page += ["</div>", ""]
    (folder / "pages/gallery.md").write_text("\n".join(page), encoding="utf-8")
