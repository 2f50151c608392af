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
  if (aCase.truth === "rate") return `${point.failures} of ${fmtCount(point.trials)}`;
  const half = (point.verdict.allowance || 0) - point.tolerance;
  return twoLines({
    value: fmt(point.measured, 5),
    bounds: half > 0 ? `± ${fmt(half, 2)}` : "",
  });
}

function zCell(aCase) {
  const point = worstOf(aCase);
  if (!point || !hasNumber(point)) return UNKNOWN;
  return point.verdict.z === null ? "∞" : fmt(point.verdict.z, 2);
}

function breakCell(aCase) {
  const places = firstBreaks(aCase);
  return places.map((b) => el("span.value", breakText(aCase, b)));
}

function raysOf(aCase) {
  const samples = sumPoints(aCase, "samples");
  return samples > 0 ? sumPoints(aCase, "rays") / samples : null;
}

function invalidOf(aCase) {
  return aCase.points.reduce((sum, p) => sum + (p.promised ? p.invalid : 0), 0);
}

function caseColumns(onChoose) {
  const number = (key, title, of, format, hint) => ({
    key,
    title,
    hint,
    cell: (c) => format(of(c)),
    sort: of,
  });
  const worst = (key) => (c) => (worstOf(c) ? worstOf(c)[key] : null);
  return [
    {
      key: "name",
      title: "Case",
      text: true,
      rowHead: true,
      cell: (c) => nameCell(c, onChoose),
      sort: (c) => c.name,
    },
    {
      key: "group",
      title: "Group",
      text: true,
      cell: (c) => c.group,
      sort: (c) => c.group,
    },
    {
      key: "outcome",
      title: "Verdict",
      text: true,
      cell: outcomeCell,
      sort: (c) => ORDER[c.outcome],
    },
    {
      key: "must",
      title: "Must be true",
      text: true,
      cell: (c) => el("span.must", c.must),
    },
    number("expected", "Expected", worst("expected"), (x) => fmtShort(x, 5)),
    {
      key: "measured",
      title: "Measured",
      hint: "The promised point that is nearest to failing, with its noise",
      cell: measuredCell,
    },
    {
      key: "z",
      title: "z",
      hint: "Standard errors beyond the tolerance",
      cell: zCell,
    },
    number(
      "detectable",
      "Finds",
      (c) => c.detectable,
      fmtFound,
      "The error that every promised point would find with a probability of 90 %",
    ),
    number("invalid", "Invalid", invalidOf, fmtCount),
    number("seconds", "Time", (c) => sumPoints(c, "total_seconds"), fmtSeconds),
    number("rays", "Rays", raysOf, (x) => fmt(x, 3), "Per sample"),
    { key: "breaks", title: "First breaks at", text: true, cell: breakCell },
  ];
}

function filterMenu(label, key, options, onChange) {
  return menu(label, { "data-filter": key }, [["", "all"], ...options], "", onChange);
}

function tableSection(onChoose) {
  const chosen = { group: "", outcome: "" };
  const host = el("div");
  const fill = () => {
    const rows = study.cases.filter(
      (c) =>
        (!chosen.group || c.group === chosen.group) &&
        (!chosen.outcome || c.outcome === chosen.outcome),
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
  const set = (key) => (value) => {
    chosen[key] = value;
    fill();
  };
  fill();
  const groups = [...new Set(study.cases.map((c) => c.group))].map((g) => [g, g]);
  const outcomes = Object.keys(ORDER)
    .filter((outcome) => study.outcomes[outcome] > 0)
    .map((outcome) => [outcome, WORDS[outcome]]);
  return section("cases", "All cases",
    el("div.menus",
      filterMenu("Group", "group", groups, set("group")),
      filterMenu("Verdict", "outcome", outcomes, set("outcome")),
    ),
    host,
  );
}
