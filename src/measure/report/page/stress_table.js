"use strict";
// All cases in a table, by group and verdict.

const ORDER = { failed: 0, unfinished: 1, weak: 2, good: 3 };

function worstOf(aCase) {
  return aCase.worst === null ? null : aCase.points[aCase.worst];
}

function nameCell(aCase, onChoose) {
  const name = maps.includes(aCase)
    ? el("button.link", { onclick: () => onChoose(aCase.name) }, aCase.name)
    : aCase.name;
  return [name, el("span.full-text", aCase.extreme)];
}

function outcomeCell(aCase) {
  return [
    el("span.verdict-word", { "data-outcome": aCase.outcome }, WORDS[aCase.outcome]),
    aCase.why && el("span.bounds.why", aCase.why),
    aCase.outcome === "weak" &&
      el("span.bounds", `${aCase.weak} of ${aCase.promised} points`),
  ];
}

function measuredCell(aCase) {
  const point = worstOf(aCase);
  if (!point || !hasNumber(point)) return UNKNOWN;
  const half = (point.verdict.allowance || 0) - point.tolerance;
  const bounds = half > 0 ? `± ${fmt(half, 2)}` : "";
  return twoLines({ value: fmt(point.measured, 5), bounds });
}

function zCell(aCase) {
  const point = worstOf(aCase);
  if (!point || !hasNumber(point)) return UNKNOWN;
  return point.verdict.z === null ? "∞" : fmt(point.verdict.z, 2);
}

function breakCell(aCase) {
  return firstBreaks(aCase).map((b) => el("span.value", breakText(aCase, b)));
}

function raysOf(aCase) {
  const samples = sumPoints(aCase, "samples");
  return samples > 0 ? sumPoints(aCase, "rays") / samples : null;
}

function invalidOf(aCase) {
  return aCase.points.reduce((sum, p) => sum + (p.promised ? p.invalid : 0), 0);
}

function caseColumns(onChoose) {
  const expected = (c) => worstOf(c) && worstOf(c).expected;
  const silent = { sort: null }; // does not sort
  return [
    textColumn("name", "Case", (c) => nameCell(c, onChoose), {
      rowHead: true, sort: (c) => c.name,
    }),
    textColumn("group", "Group", (c) => c.group),
    textColumn("outcome", "Verdict", outcomeCell, { sort: (c) => ORDER[c.outcome] }),
    textColumn("must", "Expected result", (c) => el("span.must", c.must), silent),
    numberColumn("expected", "Expected", expected, (x) => fmtShort(x, 5)),
    {
      key: "measured", title: "Measured", cell: measuredCell,
      hint: "The point of the supported range nearest to failing, with its noise",
    },
    { key: "z", title: "z", hint: "Standard errors beyond the tolerance", cell: zCell },
    numberColumn("detectable", "Detectable", (c) => c.detectable, fmtFound, {
      hint: "Relative error that every point of the supported range detects with 90 % probability",
    }),
    numberColumn("invalid", "Invalid samples", invalidOf, fmtCount),
    numberColumn("seconds", "Time", (c) => sumPoints(c, "total_seconds"), fmtSeconds),
    numberColumn("rays", "Rays / sample", raysOf, (x) => fmt(x, 3)),
    textColumn("breaks", "First failures at", breakCell, silent),
  ];
}

function tableSection(onChoose) {
  const chosen = { group: "", outcome: "" };
  const host = el("div");
  const fill = () => {
    const rows = study.cases.filter((c) =>
      Object.entries(chosen).every(([key, value]) => !value || c[key] === value),
    );
    host.replaceChildren(
      sortableTable({
        columns: caseColumns(onChoose),
        rows,
        caption: `${rows.length} cases`,
        rowClass: (c) => `case-${c.outcome}`,
      }),
    );
  };
  const filter = (label, key, options) =>
    menu(label, { "data-filter": key }, [["", "all"], ...options], "", (value) => {
      chosen[key] = value;
      fill();
    });
  fill();
  const groups = [...new Set(study.cases.map((c) => c.group))].map((g) => [g, g]);
  const outcomes = Object.keys(ORDER)
    .filter((outcome) => study.outcomes[outcome] > 0)
    .map((outcome) => [outcome, WORDS[outcome]]);
  return section("cases", "All cases",
    el("div.menus",
      filter("Group", "group", groups),
      filter("Verdict", "outcome", outcomes),
    ),
    host,
  );
}
