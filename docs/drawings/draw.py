#!/usr/bin/env python3
"""Draws docs/drawings/*.svg from the code: draw.py [--check] [--program PROGRAM]

queues    stages and the queues between them: what a kernel reads, and what it pushes to
streams   the ways that rays take through trees of triangles: which file goes on to which
calls     from main to a kernel and back to the file: which function calls which
samples   from a number of samples to a kernel: which type hands on which

Edges of `queues` are found in the kernels. Those of the others are named below, and each is
looked for: an include for `streams`, a call for `calls`, functions and types for `samples`;
one that the code does not have (any more) is an error. --check says whether the drawings are those of this code, and
needs no Graphviz (`dot`, which draws them). --program: `lanelight`, to see whether the stages
of `queues` are those that it plans.
"""
import argparse
import hashlib
import json
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
NEW_LINE = "\\n"  # in DOT
HEAD = """digraph {
  graph [rankdir=%s, bgcolor="white", fontname="sans-serif", nodesep=0.25, ranksep=0.4];
  node [fontname="sans-serif", fontsize=11, shape=box, style="filled,rounded",
        fillcolor="#eef3fa", color="#5b7aa6", margin="0.12,0.05"];
  edge [fontname="sans-serif", fontsize=10, color="#555555", arrowsize=0.7];
"""

# The stages of the scene in their order: name, queues that it reads, queues
# that it pushes to.
SCENE = "scenes/cornell-box.pbrt"
STAGES = [
    ("generate", "Free", "Camera"),
    ("points_camera_sobol", "Camera", ""),
    ("camera_perspective", "Camera", "Active"),
    ("intersect_triangles", "Active", ""),
    ("hits", "Active", "Hit Done"),
    ("emission_rectangle", "Hit", ""),
    ("max_depth", "Hit", "Surface Done"),
    ("surface_triangle", "Surface", ""),
    ("points_bounce_sobol", "Vertex", ""),
    ("route", "Vertex", "Lit Shade"),
    ("light_rectangle", "Lit", ""),
    ("shade_diffuse", "Shade", "Shadow Scattered Done"),
    ("shadow_triangles", "Shadow", ""),
    ("connect", "Shadow", ""),
    ("roulette_throughput", "Scattered", "Done"),
    ("accumulate", "Done", "Free"),
    ("compact", "Scattered", ""),
]
# The driver (src/render/wave/phase_driver.cc) moves these between stages.
DRIVER = [("Scattered", "Active", "the next wave"),
          ("Surface", "Vertex", "the same, unless media scatter as well")]

# Ways through trees: (from, to, when). Nodes are headers of kernels/intersect.
STREAMS = [
    ("triangles.cc", "few-inl.h", "few triangles"),
    ("triangles.cc", "packet-inl.h", "alike: one frustum"),
    ("triangles.cc", "packet_instances-inl.h", "alike, instances"),
    ("triangles.cc", "stream-inl.h", "all others"),
    ("shadow_triangles.cc", "few-inl.h", ""),
    ("shadow_triangles.cc", "packet-inl.h", ""),
    ("shadow_triangles.cc", "stream-inl.h", ""),
    ("packet_instances-inl.h", "packet-inl.h", "in each space"),
    ("packet-inl.h", "packet_leaf-inl.h", "at leaves"),
    ("packet_leaf-inl.h", "beam-inl.h", "alike still"),
    ("beam-inl.h", "leaf-inl.h", "what is left"),
    ("stream-inl.h", "stream_packet-inl.h", "first"),
    ("stream-inl.h", "stream_single-inl.h", "then"),
    ("stream_packet-inl.h", "packet_shadows-inl.h", "shadow rays"),
    ("stream_packet-inl.h", "stream_spaces-inl.h", "too few: later"),
    ("stream_single-inl.h", "stream_lists-inl.h", "what each is at"),
    ("stream_single-inl.h", "stream_stacks-inl.h", "what comes next"),
    ("stream_stacks-inl.h", "leaf-inl.h", "at leaves"),
    ("stream_stacks-inl.h", "child_order-inl.h", "nearest first"),
    ("stream_lists-inl.h", "stream_spaces-inl.h", "at instances"),
    ("stream_spaces-inl.h", "instance-inl.h", "into its space"),
    ("leaf-inl.h", "triangle-inl.h", "a ray, sixteen triangles"),
]

# From the command to a kernel, and back: (file, function, calls, of file).
CALLS = [
    ("src/main.cc", "main", "AddRenderCommand", "src/cli/render_command.cc"),
    ("src/cli/render_command.cc", "AddRenderCommand", "Render", "src/cli/render_command.cc"),
    ("src/cli/render_command.cc", "Render", "PrepareJob", "src/render/job/job.cc"),
    ("src/render/job/job.cc", "PrepareJob", "PrepareScene", "src/scene/prepare/prepared_scene.cc"),
    ("src/scene/prepare/prepared_scene.cc", "PrepareScene", "CompileScene", "src/scene/compile/compile.cc"),
    ("src/render/job/job.cc", "PrepareJob", "MakePlan", "src/render/plan/plan.cc"),
    ("src/cli/render_command.cc", "Render", "RenderToFiles", "src/render/job/render.cc"),
    ("src/render/job/render.cc", "RenderToFiles", "Run", "src/render/run/run.cc"),
    ("src/render/run/run.cc", "Run", "RunRound", "src/render/schedule/thread_work.cc"),
    ("src/render/schedule/thread_work.cc", "RunRound", "TaskRunner::Run", "src/render/wave/task_runner.cc"),
    ("src/render/wave/task_runner.cc", "TaskRunner::Run", "RunPhase", "src/render/wave/phase_driver.cc"),
    ("src/render/wave/phase_driver.cc", "RunPhase", "kernel", "kernels/"),
    ("src/render/schedule/thread_work.cc", "RunRound", "TaskRunner::Merge", "src/render/wave/task_runner.cc"),
    ("src/render/wave/task_runner.cc", "TaskRunner::Merge", "films.Add", "src/render/wave/films.cc"),
    ("src/render/job/render.cc", "RenderToFiles", "WriteRendering", "src/render/job/render.cc"),
    ("src/render/job/render.cc", "WriteRendering", "WriteExr", "src/base/image/exr_write.cc"),
]

# How a number of samples becomes work of a kernel: (file, function, what it hands on).
SAMPLES = [
    ("src/render/run/run_schedule.cc", "RunSchedule::Next", "Round"),
    ("src/render/schedule/scheduler.cc", "Scheduler::Next", "SampleRange"),
    ("src/render/wave/task_runner.cc", "TaskRunner::Run", "TileWork"),
    ("kernels/generate/generate.cc", "Start", ""),
]


def text_of(path):
    return (ROOT / path).read_text(encoding="utf-8")


def quoted(name):
    return '"' + name.replace('"', "'") + '"'


def code_of(path, seen):
    """A kernel file's text, with that of the headers of kernels/ that it includes."""
    if path in seen or not (ROOT / path).exists():
        return ""
    seen.add(path)
    text = text_of(path)
    return text + "".join(code_of(p, seen)
                          for p in re.findall(r'#include "(kernels/[^"]+)"', text))


def file_of(stage):
    """The kernel's file that names it."""
    found = [str(file.relative_to(ROOT)) for file in ROOT.glob("kernels/*/*.cc")
             if f'"{stage}"' in text_of(file)]
    if len(found) != 1:
        sys.exit(f"draw: {len(found)} kernels have a stage {stage}")
    return found[0]


def queues():
    """The stages of a diffuse scene and their queues. Those that only fill columns stand
    together beside the queue."""
    fillers, lines = {}, [HEAD % "TB"]
    for stage, reads, pushes in STAGES:
        code = code_of(file_of(stage), set())
        for queue in reads.split() + pushes.split():
            if f"QueueId::k{queue}" not in code and queue != "Shade":
                sys.exit(f"draw: {stage} has no queue {queue}")
        if not pushes:
            fillers.setdefault(reads, []).append(stage)
            continue
        lines += [f"  {quoted(q)} -> {quoted(stage)};" for q in reads.split()]
        lines += [f"  {quoted(stage)} -> {quoted(q)};" for q in pushes.split()]
    for queue, stages in fillers.items():
        box = quoted("\\n".join(stages))
        lines += [f'  {box} [fillcolor="#f4f4f4", color="#999999"];',
                  f"  {quoted(queue)} -> {box} [dir=none, style=dashed];"]
    lines += [f"  {quoted(a)} -> {quoted(b)} [label={quoted(' ' + why)}, style=bold];"
              for a, b, why in DRIVER]
    names = {q for _, reads, pushes in STAGES for q in (reads + " " + pushes).split()}
    lines += [f'  {quoted(q)} [shape=ellipse, style=filled, fillcolor="#fdf1d8", '
              f'color="#a8842c"];' for q in sorted(names)]
    return "\n".join(lines) + "\n}\n"


def streams():
    lines = [HEAD % "TB"]
    for a, b, when in STREAMS:
        if f'#include "kernels/intersect/{b}"' not in code_of(f"kernels/intersect/{a}", set()):
            sys.exit(f"draw: kernels/intersect/{a} does not include {b}")
        lines.append(f"  {quoted(a)} -> {quoted(b)} [label={quoted(' ' + when)}];")
    return "\n".join(lines) + "\n}\n"


def calls():
    lines = [HEAD % "TB"]
    for file, function, callee, of in CALLS:
        if not re.search(rf"\b{re.split(r'::|[.]', callee)[-1]}\b", text_of(file)):
            sys.exit(f"draw: {file} does not call {callee}")
        lines.append(f"  {quoted(f'{function}{NEW_LINE}{file}')} -> "
                     f"{quoted(f'{callee}{NEW_LINE}{of}')};")
    return "\n".join(lines) + "\n}\n"


def samples():
    lines = [HEAD % "LR", '  "--spp" [style=rounded];']
    before, handed = '"--spp"', "RunOptions"
    for file, function, hands_on in SAMPLES:
        text = text_of(file)
        for name in (function, hands_on):
            if not re.search(rf"\b{name}\b", text):
                sys.exit(f"draw: {file} has no {name}")
        node = quoted(f"{function}{NEW_LINE}{file}")
        lines.append(f"  {before} -> {node} [label={quoted(handed)}];")
        before, handed = node, hands_on
    return "\n".join(lines) + "\n}\n"


def check_plan(program):
    done = subprocess.run([program, "plan", str(ROOT / SCENE), "--json"], check=True,
                          capture_output=True, text=True)
    plan = json.loads(done.stdout)["plan"]
    planned = [stage["name"] for stage in plan["stages"]]
    if planned != [stage for stage, _, _ in STAGES]:
        sys.exit(f"draw: the plan of {SCENE} has other stages: {' '.join(planned)}")


DRAWINGS = (("queues", queues), ("streams", streams), ("calls", calls), ("samples", samples))


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--program")
    options, stale = parser.parse_args(), []
    if options.program:
        check_plan(options.program)
    for name, drawing in DRAWINGS:
        dot, file = drawing(), HERE / f"{name}.svg"
        mark = f"<!-- {hashlib.sha256(dot.encode()).hexdigest()} -->"
        if file.exists() and mark in file.read_text(encoding="utf-8"):
            continue
        stale.append(file.name)
        if not options.check:
            done = subprocess.run(["dot", "-Tsvg"], input=dot, capture_output=True,
                                  text=True, check=True)
            svg = re.sub(r"<!--.*?-->\n?", "", done.stdout, flags=re.S)
            file.write_text(svg.rstrip() + f"\n{mark}\n", encoding="utf-8")
    if options.check and stale:
        sys.exit(f"draw: {', '.join(stale)}: not of this code; run docs/drawings/draw.py")


if __name__ == "__main__":
    main()
