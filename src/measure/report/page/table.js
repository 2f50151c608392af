"use strict";
// Tables that sort by column and scroll sideways in a box of their own.

// columns: [{key, title, unit, cell(row), sort(row) or null, text, hint, axis}].
// rows: any; fixed: rows at the end that never move, as elements; most: rows shown.
function sortableTable({
  columns,
  rows,
  fixed = [],
  caption,
  sortedBy,
  rowClass,
  most = Infinity,
}) {
  const body = el("tbody");
  const state = { key: sortedBy, descending: false };
  const headers = new Map();
  const fill = () => {
    const column = columns.find((c) => c.key === state.key);
    const ordered = column ? sortRows(rows, column.sort, state.descending) : rows;
    body.replaceChildren(
      ...ordered.slice(0, most).map((row) => tableRow(row, columns, rowClass)),
      ...fixed,
    );
    for (const [key, header] of headers) {
      const mine = key === state.key;
      header.setAttribute(
        "aria-sort",
        mine ? (state.descending ? "descending" : "ascending") : "none",
      );
    }
  };
  const choose = (column) => {
    state.descending =
      state.key === column.key ? !state.descending : Boolean(column.descendingFirst);
    state.key = column.key;
    fill();
  };
  const head = el("tr",
    columns.map((c) => headerCell(c, headers, choose)),
  );
  fill();
  return scrollingTable(caption, el("thead", head), body);
}

// A table in a box of its own, which scrolls sideways.
function scrollingTable(caption, head, body, kind = "data") {
  return el("div.scroll", { tabindex: 0, role: "region", "aria-label": caption },
    el("table", { class: kind }, el("caption.hidden", caption), head, body),
  );
}

function headerCell(column, headers, choose) {
  const title = [column.title, column.unit && el("span.unit", column.unit)];
  const kind = [column.text && "text", column.rowHead && "row-head"].filter(Boolean);
  const header = el("th", {
    scope: "col",
    class: kind.join(" ") || null,
    title: column.hint,
  });
  if (column.sort) {
    header.append(
      appendAll(
        el("button", { "data-key": column.key, onclick: () => choose(column) }),
        title,
      ),
    );
    headers.set(column.key, header);
  } else {
    appendAll(header, title);
  }
  if (column.axis) header.append(column.axis);
  return header;
}

function tableRow(row, columns, rowClass) {
  return el("tr", { class: rowClass ? rowClass(row) : null },
    columns.map((column) =>
      column.rowHead
        ? el("th.text", { scope: "row" }, column.cell(row))
        : el("td", { class: column.text ? "text" : null }, column.cell(row)),
    ),
  );
}

// What is not known goes to the end in either direction.
function sortRows(rows, key, descending) {
  const sign = descending ? -1 : 1;
  const compare = (a, b) => {
    const x = key(a),
      y = key(b);
    const missingX = x === null || x === undefined,
      missingY = y === null || y === undefined;
    if (missingX || missingY) return Number(missingX) - Number(missingY);
    if (typeof x === "string") return sign * x.localeCompare(y);
    return sign * (x - y);
  };
  return rows
    .map((row, i) => [row, i])
    .sort((a, b) => compare(a[0], b[0]) || a[1] - b[1])
    .map(([row]) => row);
}

// The value with its bounds below in small print.
function twoLines({ value, bounds }, note) {
  return [
    el("span.value", value),
    (bounds || note) && el("span.bounds", [bounds, note].filter(Boolean).join(" ")),
  ];
}

// A plain table of texts. head: titles; rows: arrays of cells, the first names the row.
function plainTable(caption, head, rows) {
  const title = (text, i) =>
    el("th", { scope: "col", class: i === 0 ? "text" : null }, text);
  const cell = (content, i) =>
    i === 0 ? el("th.text", { scope: "row" }, content) : el("td", content);
  return scrollingTable(
    caption,
    el("thead", el("tr", head.map(title))),
    el("tbody",
      rows.map((cells) => el("tr", cells.map(cell))),
    ),
  );
}
