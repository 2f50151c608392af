"use strict";
// Choosing the strategies of A and B from the lists that the program has.

const STYLES = [strategyStyle(0), strategyStyle(1)];

// "key=value,..." as an object.
function choicesOf(text) {
  return Object.fromEntries(text.split(",").map((part) => part.split("=")));
}

class StrategyCard {
  constructor(page, slot, name) {
    Object.assign(this, { page, slot, name });
    const lists = page.hello.strategies;
    this.texts = new Map([
      ["default", lists.default],
      ["scene", page.hello.scene_strategy],
      ...lists.presets.map((p) => [p.name, p.strategy]),
    ]);
    this.status = el("div.card-status", { "aria-live": "off" });
    this.axes = el("div.axes");
    this.select = el("select", { onchange: () => this.choose(this.select.value) });
    this.node = el(`div#card-${slot}.card`,
      el("div.card-head",
        el("label.menu", el("span", swatch(STYLES[slot]), ` ${"AB"[slot]}`), this.select),
        slot === 1 && this.offButton()),
      el("details", el("summary", "Choose each key"), this.axes),
      this.status,
    );
    this.fill();
  }

  offButton() {
    const button = el("button#off.button", "None");
    button.addEventListener("click", () => this.choose(""));
    return button;
  }

  // name: of the lists, a strategy's text, or empty.
  choose(name) {
    this.name = name;
    this.fill();
    this.page.onStrategy(this.slot, name);
  }

  fill() {
    const names = [...this.texts.keys()];
    const own = this.name !== "" && !this.texts.has(this.name);
    this.select.replaceChildren(
      ...(this.slot === 1 ? [el("option", { value: "" }, "none")] : []),
      ...names.map((name) => el("option", { value: name }, name)),
      ...(own ? [el("option", { value: this.name }, "custom")] : []),
    );
    this.select.value = this.name;
    this.fillAxes(this.texts.get(this.name) || this.name || this.texts.get("default"));
  }

  fillAxes(text) {
    const { choices } = this.page.hello.strategies;
    const now = choicesOf(text);
    const axes = [...new Set(choices.map((c) => c.axis))];
    this.axes.replaceChildren(
      ...axes.map((axis) => {
        const of = choices.filter((c) => c.axis === axis);
        const value = (now[axis] || of[0].name).split(":")[0];
        const meaning = of.find((c) => c.name === value);
        const node = menu(
          axis, { "data-axis": axis }, of.map((c) => [c.name, c.name]), value,
          (name) => this.change(now, axis, name),
        );
        node.title = meaning ? `${meaning.meaning}: ${meaning.formula}` : "";
        return node;
      }),
    );
  }

  change(now, axis, name) {
    const text = Object.entries({ ...now, [axis]: name })
      .map(([key, value]) => `${key}=${value}`)
      .join(",");
    const known = [...this.texts].find(([, t]) => t === text);
    this.choose(known ? known[0] : text);
  }

  show(state) {
    this.node.classList.toggle("empty", state.name === "");
    if (state.refused) {
      this.status.replaceChildren(el("p.refused", state.refused));
      return;
    }
    if (state.name === "" || state.spp === undefined) {
      this.status.replaceChildren(state.name === "" ? "" : "Starting …");
      return;
    }
    const look = state.looks[state.looks.length - 1];
    const error = look
      ? joined(percentTexts(rmseOf(look)))
      : "available from 8 samples per pixel";
    const notes = look && [
      `relative MSE ${joined(intervalTexts({ value: look.relmse, low: look.low, high: look.high }))}`,
      look.why,
    ];
    this.status.replaceChildren(
      el("dl.facts.live-facts", fact("Samples per pixel", fmtCount(state.spp)),
        fact("Processor time", fmtSeconds(state.seconds)),
        fact("Relative RMSE", error,
          notes && notes.filter(Boolean).join("; "), { class: "wide", "data-fact": "relmse" }),
        state.training && fact("Training", state.training, null, { class: "wide" }),
        state.invalid > 0 && fact("Invalid samples", fmtCount(state.invalid)),
        fact("Notes", state.notes.join("; "), null, { class: "wide" })),
    );
  }
}
