"use strict";
// Making elements. Data only ever becomes text nodes and attributes, never markup, so
// that the name of a strategy cannot do anything.

function setAttributes(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) {
      node.addEventListener(name.slice(2), value);
    } else if (name === "class") {
      node.classList.add(...value.split(" ").filter(Boolean));
    } else if (name === "style") {
      for (const [key, text] of Object.entries(value)) node.style.setProperty(key, text);
    } else {
      node.setAttribute(name, value === true ? "" : String(value));
    }
  }
  return node;
}

function appendAll(node, children) {
  for (const child of children.flat(Infinity)) {
    if (child === null || child === undefined || child === false) continue;
    node.append(child); // strings become text nodes
  }
  return node;
}

function made(create, selector, attributes, children) {
  const [tag, ...marks] = selector.split(/(?=[.#])/);
  const node = create(tag);
  if (tag === "button") node.type = "button";
  for (const mark of marks) {
    if (mark[0] === "#") node.id = mark.slice(1);
    else node.classList.add(mark.slice(1));
  }
  const given = attributes && Object.getPrototypeOf(attributes) === Object.prototype;
  if (!given) return appendAll(node, [attributes, children]);
  return appendAll(setAttributes(node, attributes), children);
}

// el("p#id.class", { attributes, which may be left out }, children, ...)
function el(selector, attributes, ...children) {
  return made((tag) => document.createElement(tag), selector, attributes, children);
}

function svg(selector, attributes, ...children) {
  const space = "http://www.w3.org/2000/svg";
  return made((tag) => document.createElementNS(space, tag), selector, attributes, children);
}

// A part of the page with a heading that the navigation can point to.
function section(id, title, ...children) {
  return el("section", { id, "aria-labelledby": `${id}-title` },
    el("h2", { id: `${id}-title` }, title),
    children,
  );
}

// Fills the navigation: [[id, title], ...] of sections.
function linkSections(sections, hash = (id) => `#${id}`) {
  document
    .getElementById("sections")
    .replaceChildren(
      ...sections.map(([id, title]) => el("a", { href: hash(id) }, title)),
    );
}

// A choice of many. options: [[value, text], ...]; data: attributes of the selection.
function menu(label, data, options, value, onChoose) {
  const select = el("select", { ...data, onchange: () => onChoose(select.value) },
    options.map(([key, text]) =>
      el("option", { value: key, selected: key === value }, text),
    ),
  );
  return el("label.menu", el("span", label), select);
}

// A pair of a list of facts; none if the value is not known.
function fact(term, value, note, attributes = {}) {
  if (!value) return null;
  return el("div",
    attributes,
    el("dt", term),
    el("dd", value, note && el("span.note", note)),
  );
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

// Calls draw once the element comes near the screen, or when the page is printed.
function whenVisible(view, node, draw) {
  let drawn = false;
  const once = () => {
    if (drawn) return;
    drawn = true;
    observer.disconnect();
    draw();
  };
  const observer = new IntersectionObserver(
    (entries) => {
      if (entries.some((entry) => entry.isIntersecting)) once();
    },
    { rootMargin: "400px" },
  );
  observer.observe(node);
  addEventListener("beforeprint", once, { signal: view.signal });
  view.signal.addEventListener("abort", () => observer.disconnect());
}

// The floating note. content: strings or nodes; null hides it.
const tip = {
  show(content, x, y) {
    const node = document.getElementById("tip");
    node.replaceChildren();
    appendAll(node, [content]);
    node.hidden = false;
    const box = node.getBoundingClientRect();
    const left = Math.max(6, Math.min(x + 14, innerWidth - box.width - 6));
    const above = y - box.height - 12;
    node.style.left = `${left}px`;
    node.style.top = `${above > 4 ? above : y + 18}px`;
  },
  hide() {
    document.getElementById("tip").hidden = true;
  },
};

// A note for the pointer and for the keyboard's focus.
function withTip(node, content) {
  node.addEventListener("pointermove", (event) =>
    tip.show(content(), event.clientX, event.clientY),
  );
  node.addEventListener("pointerleave", tip.hide);
  node.addEventListener("focus", () => {
    const box = node.getBoundingClientRect();
    tip.show(content(), box.left, box.top);
  });
  node.addEventListener("blur", tip.hide);
  return node;
}
