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

// What a floating note says: a title, and lines, of which what is false is left out.
function noteOf(title, ...lines) {
  return [el("b", title), lines.filter(Boolean).map((line) => el("div", line))];
}

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
