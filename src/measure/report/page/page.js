"use strict";
// The frame of a page: its start, sections, and what stands in several of them.

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

// A pair of a list of facts; none if the value is not known.
function fact(term, value, note, attributes = {}) {
  if (!value) return null;
  return el("div",
    attributes,
    el("dt", term),
    el("dd", value, note && el("span.note", note)),
  );
}

// The first section, whose title is the page's.
function firstSection(title, ...children) {
  return el("section#summary", { "aria-labelledby": "summary-title" },
    el("h1#summary-title", title),
    children,
  );
}

// Box of warnings: texts, or elements of a list.
function warningBox(title, texts) {
  if (texts.length === 0) return null;
  return el("div.warnings", { role: "note" },
    title && el("h3", title),
    el("ul", texts.map((text) => (typeof text === "string" ? el("li", text) : text))),
  );
}

// terms: {term: what it means}
function readingSection(terms) {
  return section("reading", "How to read this",
    el("dl.glossary",
      Object.entries(terms).map(([term, text]) => el("div", el("dt", term), el("dd", text))),
    ),
  );
}

// Whatever a page is of. sections: [[id, title], ...], what is false is left out.
function startPage({ title, footer, sections = [] }) {
  theme.bindButton(document.getElementById("theme"));
  document.title = title;
  document.getElementById("bottom").textContent = footer;
  linkSections(sections.filter(Boolean));
  addEventListener("scroll", tip.hide, { passive: true });
}

function showContent(...children) {
  const content = document.getElementById("content");
  content.replaceChildren();
  appendAll(content, children);
}

function saveFile(name, blob) {
  const link = el("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
