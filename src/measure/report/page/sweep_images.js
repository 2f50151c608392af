"use strict";
// Small pictures of the chosen groups, with a slider over the amount of samples.

const MOST_PICTURES = 200;

function groupPicture(view, group, label) {
  const { name } = study.cells[group.cells[0]];
  const image = findImage(name);
  return el("figure.thumbnail",
    image
      ? picture(view, {
          label,
          width: image.width,
          height: image.height,
          makePixels: () => tonedPixels(image, view.tone.value),
        })
      : missingPicture("no picture of it"),
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
    cut > 0 && el("p.hint", `${cut} more are not shown.`),
  ];
}

function imagesSection(view, choice) {
  if (imageBlocks.size === 0) return null;
  const amount = varyingAxes.find((axis) => AMOUNTS.includes(axis.name)) || null;
  const values = amount ? amount.values : [null];
  const output = el("output");
  const host = el("div");
  const show = (i) => {
    if (amount) output.textContent = valueLabel(amount, values[i]);
    host.replaceChildren();
    appendAll(host, [chosenPictures(view, choice, amount, values[i])]);
  };
  const slider = el("input", {
    type: "range", min: 0, max: values.length - 1, value: values.length - 1,
    "data-control": "amount", "aria-label": amount && amount.title,
    oninput: () => show(Number(slider.value)),
  });
  show(values.length - 1);
  return section("images", "Pictures",
    amount &&
      el("label.labelled", el("span", amount.title), slider, output),
    host,
  );
}
