"use strict";
// What stands around plots: their frames, and the legend that chooses what they show.

function strategyLegend(view, label = "Strategies shown", filter = true) {
  const listed = view.ranked;
  const buttons = listed.map((s) =>
    el("button.button.legend-item",
      {
        "data-strategy": s.index,
        onclick: () => {
          const shown = new Set(view.shown.value);
          if (!shown.delete(s.index)) shown.add(s.index);
          view.shown.set(shown);
        },
        ondblclick: () => view.shown.set(new Set([s.index])),
        onpointerenter: () => view.focus.set(s.index),
        onpointerleave: () => view.focus.set(null),
        onfocus: () => view.focus.set(s.index),
        onblur: () => view.focus.set(null),
      },
      strategyLabel(s),
    ),
  );
  const show = (shown) =>
    buttons.forEach((button, i) =>
      button.setAttribute("aria-pressed", String(shown.has(listed[i].index))),
    );
  view.shown.listen(show);
  show(view.shown.value);
  const legend = el("div.legend", { role: "group", "aria-label": label }, buttons);
  if (filter && listed.length > MOST_CURVES) legend.prepend(filterBox(view, listed, buttons));
  return legend;
}

// Shows the strategies whose name or text has what is typed.
function filterBox(view, listed, buttons) {
  const box = el("input.filter", {
    type: "search", "data-control": "filter", placeholder: "Filter, e.g. points=",
    "aria-label": "Show strategies whose text contains",
  });
  box.addEventListener("input", () => {
    const wanted = box.value.trim().toLowerCase();
    const has = (s) => `${s.name} ${s.text || ""}`.toLowerCase().includes(wanted);
    const found = listed.filter((s) => has(s));
    buttons.forEach((button, i) => {
      button.hidden = wanted !== "" && !has(listed[i]);
    });
    view.shown.set(
      wanted === ""
        ? leading(view.ranked, view.baseline)
        : new Set(found.map((s) => s.index)),
    );
  });
  return box;
}

function showAllButtons(view) {
  const button = (name, shown) =>
    el("button.button", { "data-show": name, onclick: () => view.shown.set(shown) },
      `Show ${name}`,
    );
  return el("div.choices", { role: "group", "aria-label": "Strategies" },
    view.ran.length > MOST_CURVES &&
      button("leading", leading(view.ranked, view.baseline)),
    button("all", new Set(view.ran.map((s) => s.index))),
    button("none", new Set()),
  );
}

// saved: what files of it are called.
function plotFigure(name, title, saved = title) {
  const host = el("div.plot", { "data-plot": name });
  return {
    host,
    figure: el("figure.plot-figure",
      el("figcaption", title),
      host,
      exportButtons(host, saved),
    ),
  };
}
