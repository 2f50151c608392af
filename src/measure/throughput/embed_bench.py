"""Writes scenes and results of `lanelight bench` as C++: embed_bench.py SCENES RESULTS OUT.cc."""
import pathlib
import re
import sys

# Name, samples per pixel of a render (about half a second on one thread), and what the scene
# stresses.
SCENES = [
    ("cornell-box", 16, "few triangles, diffuse: queues, shading, light samples"),
    ("glass", 32, "smooth and rough glass: long paths that part, textures"),
    ("instances", 16, "trees in trees: closest hits that share little"),
    ("many-lights", 8, "hundreds of lamps: choosing lights, shadow rays"),
    ("media", 16, "fog: distances, phase functions, rays through boundaries"),
]
# Longer literals than this are not portable.
MOST = 15000


def whole(path):
    """The text of a scene, with what it includes in its place and without comments."""
    lines = []
    for line in path.read_text().splitlines():
        include = re.match(r'\s*Include\s+"([^"]+)"', line)
        if include:
            lines.append(whole(path.parent / include[1]))
        elif line.strip() and not line.lstrip().startswith("#"):
            lines.append(line)
    return "\n".join(lines)


def literal(text):
    parts = [text[i:i + MOST] for i in range(0, len(text), MOST)]
    return "\n".join(f'R"pbrt({part})pbrt"' for part in parts)


def main():
    folder, results, out = map(pathlib.Path, sys.argv[1:])
    rows = ",\n".join(f'{{"{name}", {spp}, "{stresses}",\n{literal(whole(folder / f"{name}.pbrt"))}}}'
                      for name, spp, stresses in SCENES)
    stored = ",\n".join(f'{{"{path.stem}",\n{literal(path.read_text())}}}'
                        for path in sorted(results.glob("*.json")))
    out.write_text("// Written by src/measure/throughput/embed_bench.py.\n"
                   '#include "src/measure/throughput/throughput.h"\n\nnamespace lanelight {\n\n'
                   "const std::vector<BenchScene>& BenchScenes() {\n"
                   f"static const std::vector<BenchScene> scenes = {{\n{rows}}};\n"
                   "return scenes;\n}\n\n"
                   "const std::vector<StoredResult>& StoredResults() {\n"
                   f"static const std::vector<StoredResult> results = {{\n{stored}}};\n"
                   "return results;\n}\n\n}  // namespace lanelight\n")


main()
