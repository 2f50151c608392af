"use strict";
// What the sweep is, and how much of it there is.

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
      `${cellsThat(countOf("failed"), "has", "have")} failed; the table says why.`,
    );
  }
  if (countOf("missing") > 0) {
    texts.push(
      `${cellsThat(countOf("missing"), "is", "are")} missing; the same command goes on.`,
    );
  }
  if (machines.length > 1) {
    texts.push(
      `The cells come from ${machines.length} machines (${machines.slice(0, 4).join(", ")}` +
        `${machines.length > 4 ? ", ..." : ""}): times may not be comparable.`,
    );
  }
  if (programs.length > 1) {
    texts.push(
      `The cells come from ${programs.length} programs: ${programs.join("; ")}.`,
    );
  }
  if (invalid > 0) texts.push(`${fmtCount(invalid)} samples were invalid.`);
  return texts;
}

function sweepSummary() {
  return firstSection(study.file,
    el("p.lead.headline", headlineText()),
    warningBox(null, warnings()),
    el("dl.facts",
      fact("Cells",
        `${fmtCount(doneCells.length)} of ${fmtCount(study.cells.length)} done`,
        study.excluded > 0 ? `${fmtCount(study.excluded)} combinations excluded` : null,
      ),
      fact("Samples", fmtCount(sumOf("samples"))),
      study.seeds > 1 && fact("Seeds", fmtCount(study.seeds), "repetitions, not lines"),
      fact("Processor time", fmtSeconds(sumOf("cpu_seconds"))),
      varyingAxes.map(axisFact),
      fact("Machine", machinesText(study.machines), null, { class: "wide" }),
    ),
  );
}
