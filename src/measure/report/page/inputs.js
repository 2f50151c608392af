"use strict";
// What a reader chooses with: menus, buttons, sliders.

// A choice of many. options: [[value, text], ...]; data: attributes of the selection.
function menu(label, data, options, value, onChoose) {
  const select = el("select", { ...data, onchange: () => onChoose(select.value) },
    options.map(([key, text]) =>
      el("option", { value: key, selected: key === value }, text),
    ),
  );
  return el("label.menu", el("span", label), select);
}

// Buttons of which exactly one is pressed. options: [[value, label], ...].
function choiceButtons(label, options, value, onChoose) {
  const buttons = options.map(([key, text]) =>
    el("button.button", { "data-value": key, "aria-pressed": String(key === value) },
      text,
    ),
  );
  const group = el("div.choices", { role: "group", "aria-label": label }, buttons);
  group.addEventListener("click", (event) => {
    const chosen = event.target.closest("button");
    if (!chosen) return;
    for (const button of buttons) {
      button.setAttribute("aria-pressed", String(button === chosen));
    }
    onChoose(chosen.dataset.value);
  });
  return group;
}

// Text before a control, and what is known of it behind.
function labelled(text, control, extra) {
  return el("label.labelled", el("span", text), control, extra);
}

// A slider with its value beside it, {node, set(x)}. text(x): of the value; onInput(x);
// attributes: of the slider.
function slider(label, { value, text, onInput, ...attributes }) {
  const shown = el("output", text(value));
  const input = el("input", { type: "range", value, ...attributes });
  const set = (x) => {
    input.value = x;
    shown.textContent = text(x);
  };
  input.addEventListener("input", () => {
    set(Number(input.value));
    onInput(Number(input.value));
  });
  input.value = value; // once its range is known
  return { node: labelled(label, input, shown), set };
}
