"use strict";
// Headline, warnings and facts of the sweep.

function countOf(status) {
  return study.cells.filter((cell) => cell.status === status).length;
}

function sumOf(name) {
  return doneCells.reduce((sum, cell) => sum + (cell.measured[name] || 0), 0);
}

function distinct(name) {
  return [...new Set(doneCells.map((cell) => cell.measured[name]).filter(Boolean))];
}

function axisFact(axis) {
  const values = axis.parameter ? axis.values : axisValues(axis);
  const shown = values.slice(0, 6).map((value) => valueLabel(axis, value));
  const more = values.length > 6 ? ` and ${values.length - 6} more` : "";
  return fact(axis.title, axis.values.length, shown.join(", ") + more);
}

function cellsThat(count, one, many) {
  return count === 1 ? `1 cell ${one}` : `${fmtCount(count)} cells ${many}`;
}

function warnings() {
  const texts = [];
  const machines = distinct("machine"),
    programs = distinct("program");
  const invalid = sumOf("invalid_samples");
  if (countOf("failed") > 0) {
    texts.push(
      `${cellsThat(countOf("failed"), "has", "have")} failed; the table lists the reasons.`,
    );
  }
  if (countOf("missing") > 0) {
    texts.push(
      `${cellsThat(countOf("missing"), "is", "are")} missing; run the same command again to ` +
        `render ${countOf("missing") === 1 ? "it" : "them"}.`,
    );
  }
  if (machines.length > 1) {
    texts.push(
      `The cells come from ${machines.length} machines (${machines.slice(0, 4).join(", ")}` +
        `${machines.length > 4 ? ", ..." : ""}): their times may not be comparable.`,
    );
  }
  if (programs.length > 1) {
    texts.push(
      `The cells were rendered by ${programs.length} versions of the program: ${programs.join("; ")}.`,
    );
  }
  if (invalid > 0) texts.push(`${fmtCount(invalid)} samples were invalid (NaN, infinite or negative).`);
  return texts;
}

function sweepSummary() {
  return firstSection(study.file,
    el("p.lead.headline", headlineText()),
    warningBox(null, warnings()),
    el("dl.facts",
      fact("Cells",
        `${fmtCount(doneCells.length)} of ${fmtCount(study.cells.length)} done`,
        [
          countOf("stopped") > 0 && `${fmtCount(countOf("stopped"))} not needed (--race)`,
          study.excluded > 0 && `${fmtCount(study.excluded)} combinations excluded`,
        ].filter(Boolean).join(", ") || null,
      ),
      fact("Samples", fmtCount(sumOf("samples"))),
      study.seeds > 1 && fact("Seeds", fmtCount(study.seeds), "repetitions of each cell"),
      fact("Processor time", fmtSeconds(sumOf("cpu_seconds"))),
      varyingAxes.map(axisFact),
      fact("Machine", machinesText(study.machines), null, { class: "wide" }),
    ),
  );
}
