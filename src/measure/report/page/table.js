"use strict";
// Tables that sort by column and scroll sideways in a box of their own.

// columns: [{key, title, unit, cell(row), sort(row) or null, text, hint, axis}].
// rows: any; fixed: rows at the end that never move, as elements; most: rows shown.
function sortableTable({ columns, rows, caption, sortedBy, fixed = [], rowClass, most }) {
  const body = el("tbody");
  const state = { key: sortedBy, descending: false };
  const headers = new Map();
  const fill = () => {
    const column = columns.find((c) => c.key === state.key);
    const ordered = column ? sortRows(rows, column.sort, state.descending) : rows;
    const shown = ordered.slice(0, most);
    body.replaceChildren(...shown.map((row) => tableRow(row, columns, rowClass)), ...fixed);
    for (const [key, header] of headers) {
      const order = state.descending ? "descending" : "ascending";
      header.setAttribute("aria-sort", key === state.key ? order : "none");
    }
  };
  const choose = ({ key, descendingFirst }) => {
    state.descending = state.key === key ? !state.descending : Boolean(descendingFirst);
    state.key = key;
    fill();
  };
  const head = el("tr", columns.map((c) => headerCell(c, headers, choose)));
  fill();
  return scrollingTable(caption, el("thead", head), body);
}

// A column of texts; of numbers; of intervals. of(row) may be unknown.
function textColumn(key, title, of, more) {
  return { key, title, text: true, cell: of, sort: of, ...more };
}

function numberColumn(key, title, of, format, more) {
  const sort = (row) => (known(of(row)) ? of(row) : null);
  return { key, title, cell: (row) => format(of(row)), sort, ...more };
}

function intervalColumn(key, title, of, texts = intervalTexts, more = {}) {
  const cell = (row) => twoLines(texts(of(row)));
  return { key, title, cell, sort: (row) => valueOf(of(row)), ...more };
}

// A table in a box of its own, which scrolls sideways.
function scrollingTable(caption, head, body, kind = "data") {
  return el("div.scroll", { tabindex: 0, role: "region", "aria-label": caption },
    el("table", { class: kind }, el("caption.hidden", caption), head, body),
  );
}

function headerCell(column, headers, choose) {
  const { key, title, unit, text, rowHead, hint, sort, axis } = column;
  const content = [title, unit && el("span.unit", unit)];
  const sorter = sort && el("button", { "data-key": key, onclick: () => choose(column) });
  const header = el("th",
    {
      scope: "col",
      class: [text && "text", rowHead && "row-head"].filter(Boolean).join(" "),
      title: hint,
    },
    sort ? appendAll(sorter, content) : content,
    axis,
  );
  if (sort) headers.set(key, header);
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
    el("tbody", rows.map((cells) => el("tr", cells.map(cell)))),
  );
}
