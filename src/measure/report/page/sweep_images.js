"use strict";
// Small pictures of the chosen groups, with a slider over the amount of samples.

const MOST_PICTURES = 200;

function groupPicture(view, group, label) {
  const { name } = study.cells[group.cells[0]];
  const image = findImage(name);
  return el("figure.thumbnail",
    image ? tonedPicture(view, image, label) : missingPicture("no image"),
    el("figcaption", label),
  );
}

// Those of one value of `amount`, if there is such an axis.
function chosenPictures(view, choice, amount, value) {
  const at = (group) => !amount || valueOn(group, amount) === value;
  const fixed = new Map(choice.fixed);
  fixed.delete(amount);
  const shown = { ...choice, fixed };
  const groups = study.groups.filter((group) => at(group) && isChosen(group, shown));
  const labelAxes = varyingAxes.filter(
    (axis) =>
      axis !== amount && !fixed.has(axis) && !axis.parameter && axis.name !== "strategy",
  );
  const labelOf = (group) =>
    [...labelAxes.map((axis) => valueLabel(axis, valueOn(group, axis))), group.strategy]
      .filter(Boolean)
      .join(", ");
  const figures = groups
    .slice(0, MOST_PICTURES)
    .map((group) => groupPicture(view, group, labelOf(group)));
  const cut = groups.length - figures.length;
  return [
    el("div.thumbnails", figures),
    cut > 0 && el("p.hint", `${cut} more images are not shown.`),
  ];
}

function imagesSection(view, choice) {
  if (imageBlocks.size === 0) return null;
  const amount = varyingAxes.find((axis) => AMOUNTS.includes(axis.name)) || null;
  const values = amount ? amount.values : [null];
  const host = el("div");
  const show = (i) => {
    host.replaceChildren();
    appendAll(host, chosenPictures(view, choice, amount, values[i]));
  };
  const last = values.length - 1;
  show(last);
  const amounts =
    amount &&
    slider(amount.title, {
      min: 0, max: last, value: last, "data-control": "amount",
      text: (i) => valueLabel(amount, values[i]), onInput: show,
    }).node;
  return section("images", "Images", amounts, host);
}
