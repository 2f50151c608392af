"use strict";
// Ranking table: efficiency and the numbers behind it, one row for each strategy.

function rankingSection(view) {
  const baseline = view.baseline ? view.baseline.name : null;
  return section("ranking", "Ranking",
    el("p.lead",
      "Efficiency is 1 / (relative MSE × seconds of processor time)",
      baseline ? [", relative to ", el("b", baseline)] : null,
      ". Twice the efficiency means the same error in half the time. Brackets: " +
        `${confidenceText() ? `${confidenceText()} ` : ""}confidence intervals. ` +
        "A rank range such as 2–4 means that the order of these ranks is not significant.",
    ),
    rankingTables(view),
  );
}

// The columns that answer, or all of them across the whole window.
function rankingTables(view) {
  const host = el("div.ranking-host");
  const show = (which) => {
    host.classList.toggle("wide", which === "all");
    host.replaceChildren(rankingTable(view, which === "all"));
  };
  show("main");
  const choices = [["main", "Main columns"], ["all", "All columns"]];
  return [el("div.toolbar", choiceButtons("Columns", choices, "main", show)), host];
}

function rankingTable(view, all) {
  const scale = whiskerScale(view.ranked.map((s) => s.efficiency), true, [1]);
  const columns = rankingColumns(view, scale).filter(
    (column) => all || MAIN_COLUMNS.has(column.key),
  );
  return sortableTable({
    caption: "Ranking of the strategies by efficiency",
    columns,
    rows: view.ranked,
    fixed: otherRows(view, columns.length),
    sortedBy: "rank",
    rowClass: (s) => (s.rank && s.rank[0] === 1 ? "best" : null),
  });
}

// A row beside the ranking: why a strategy has no numbers of its own.
function otherRow(mark, strategy, why, count) {
  return el("tr.not-run",
    el("td.text", mark),
    el("th.text", { scope: "row" }, strategyLabel(strategy)),
    el("td.text", { colspan: count - 2 }, el("span.why", why)),
  );
}

// Those that do exactly the same here were rendered once.
function otherRows(view, count) {
  const twins = view.ran.map((s) => [s, twinsOf(view, s).map((twin) => twin.name)]);
  const same = twins.filter(([, names]) => names.length > 0);
  const others = view.strategies.filter((s) => !view.ran.includes(s) && s.status !== "same");
  const once = "Identical on this scene, rendered once: ";
  return [
    ...same.map(([s, names]) => otherRow("=", s, once + names.join(", "), count)),
    ...others.map((s) => otherRow(UNKNOWN, s, whyMissing(s), count)),
  ];
}

function rankText(rank) {
  if (!rank) return UNKNOWN;
  return rank[0] === rank[1] ? String(rank[0]) : `${rank[0]}–${rank[1]}`;
}

// The strategies whose rank ranges overlap that of s.
function rivals(view, s) {
  if (!s.rank) return [];
  return view.ranked.filter(
    (o) => o !== s && o.rank && o.rank[0] <= s.rank[1] && s.rank[0] <= o.rank[1],
  );
}

function rankCell(view, s) {
  const others = rivals(view, s);
  const title = `Not significantly different from ${others.map((o) => o.name).join(", ")}`;
  return el("span.rank", { title: others.length > 0 && title }, rankText(s.rank));
}
