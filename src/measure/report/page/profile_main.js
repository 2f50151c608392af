"use strict";
// Page of a profile: where the time of a render goes.

// Columns without data are not shown.
function stageTable() {
  const number = (key, title, of, format, hint) =>
    numberColumn(key, title, of, format, { descendingFirst: true, hint });
  const counter = (name) => (row) => row.counters && row.counters[name];
  const columns = [
    { ...textColumn("name", "Stage", (row) => row.name), rowHead: true },
    textColumn("group", "Group", (row) => row.group),
    number("share", "Share", (row) => row.share, fmtPercent),
    { ...intervalColumn("ns", "ns per sample", (row) => row.ns_per_sample),
      descendingFirst: true },
    number("lanes", "Lanes filled", (row) => row.occupancy, fmtPercent),
    number("item", "ns per path", (row) => row.ns_per_item, fmt),
    number("items", "Paths", (row) => row.items || null, fmtCount),
    number("calls", "Calls", (row) => row.calls || null, fmtCount),
    number("read", "Bytes read", (row) => row.bytes_read_per_item, fmtCount, "per path"),
    number("written", "Bytes written", (row) => row.bytes_written_per_item, fmtCount, "per path"),
    number("gbs", "GB/s", (row) => row.bytes_per_second && row.bytes_per_second * 1e-9, fmt),
    number("peak", `of ${study.wavefront.level}`, (row) => row.of_peak_bandwidth, fmtPercent),
    number("ipc", "Instructions per cycle", counter("instructions_per_cycle"), fmt),
    number("l1", "L1 misses", counter("l1_misses_per_item"), fmt, "per path"),
    number("llc", "LLC misses", counter("llc_misses_per_item"), fmt, "per path"),
    textColumn("bound", "Bound", (row) => row.bound),
  ];
  const { rows } = study;
  const has = (column) => rows.some((row) => (column.sort(row) ?? null) !== null);
  return sortableTable({
    caption: "All stages", columns: columns.filter(has), rows, sortedBy: null,
  });
}

function summarySection() {
  const { target, threads, repeats, resolution, spp, samples, rays_per_sample: rays } = study;
  const wide = { class: "wide" };
  return firstSection(page.scene,
    el("p.verdict", page.answer),
    warningBox(null, [
      ...(study.busy.length > 0 ? [`The machine was busy: ${study.busy.join("; ")}.`] : []),
      ...(study.stopped_early ? ["The render was stopped early."] : []),
    ]),
    el("dl.facts",
      fact("Image", `${resolution[0]} × ${resolution[1]} pixels`,
        spp > 0 && `${fmtCount(spp)} samples per pixel`),
      fact("Render", fmtSeconds(study.seconds.render),
        `${fmtSeconds(study.seconds.cpu)} of processor time`),
      fact("Samples", fmtCount(samples), `${fmt(rays)} rays per sample`),
      fact("Threads", fmtCount(threads), `${instructionSet(target.name)}, ${target.lanes} lanes`),
      fact("Repeats", fmtCount(repeats),
        repeats > 5 ? `${fmtShortPercent(study.confidence)} intervals`
          : `${repeats > 1 ? "in brackets: their range; " : ""}6 give intervals`),
      fact("Machine", study.machine.text, null, wide),
      fact("Program", study.program, null, wide),
    ),
    el("p.hint", `Strategy: ${study.strategy_in_force.replaceAll(",", ", ")}`),
  );
}

function startProfile() {
  const sections = [
    ["against", "Difference", changesSection()],
    ["costs", "Stages", costsSection()],
    ["bounces", "Bounces", bouncesSection()],
    ["materials", "Materials", materialsSection()],
    ["memory", "Memory", memorySection()],
    ["queues", "Queues", queuesSection()],
    ["map", "Image", mapSection()],
    ["rows", "Table", section("rows", "All stages", stageTable())],
  ].filter(([, , node]) => node);
  startPage({
    title: `${page.scene} – Lanelight profile`,
    footer:
      "Written by lanelight profile. This page holds all its numbers and needs no network.",
    sections: sections.map(([id, title]) => [id, title]),
  });
  showContent(summarySection(), sections.map(([, , node]) => node));
}

startProfile();
