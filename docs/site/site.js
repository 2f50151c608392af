"use strict";
// The menu on a phone, dark colours, and the search, which reads an index of all sections
// from a script: pages that are opened from the disk may load nothing else.

const menu = document.getElementById("menu");
menu.addEventListener("click", () => {
  const open = menu.getAttribute("aria-expanded") !== "true";
  menu.setAttribute("aria-expanded", open);
  for (const part of document.querySelectorAll("[data-toggle=wy-nav-shift]")) {
    part.classList.toggle("shift", open);
  }
});

const colours = document.getElementById("colours");
const systemIsDark = matchMedia("(prefers-color-scheme: dark)");

function isDark() {
  const chosen = document.documentElement.dataset.colours;
  return chosen ? chosen === "dark" : systemIsDark.matches;
}

function nameColours() {
  colours.textContent = isDark() ? "Light colours" : "Dark colours";
}

colours.addEventListener("click", () => {
  const chosen = isDark() ? "light" : "dark";
  document.documentElement.dataset.colours = chosen;
  try {
    localStorage.setItem("lanelight-colours", chosen);
  } catch { /* for this page only */ }
  nameColours();
});
systemIsDark.addEventListener("change", nameColours);
nameColours();

// Tables that are too wide can be moved by the keys too.
for (const table of document.querySelectorAll(".rst-content table")) {
  if (table.scrollWidth > table.clientWidth) table.tabIndex = 0;
}

const search = document.getElementById("search");
const found = document.getElementById("found");
const MOST = 12; // results

function loadIndex() {
  if (window.searchIndex || document.getElementById("search-index")) return;
  const script = document.createElement("script");
  script.id = "search-index";
  script.src = search.dataset.index;
  script.addEventListener("load", showFound);
  document.head.append(script);
}

// Every word must be there; words in titles count more. 0: not found.
function score(section, words) {
  const title = section.title.toLowerCase(), text = section.text.toLowerCase();
  let sum = 0;
  for (const word of words) {
    if (title.includes(word)) sum += 20;
    else if (!text.includes(word)) return 0;
    sum += Math.min(5, text.split(word).length - 1);
  }
  return sum;
}

function excerpt(section, word) {
  const at = Math.max(0, section.text.toLowerCase().indexOf(word) - 40);
  return (at > 0 ? "… " : "") + section.text.slice(at, at + 120);
}

function result(section, word) {
  const item = document.createElement("li"), link = document.createElement("a");
  link.href = `${search.dataset.base}/${section.location}`;
  link.textContent = section.title;
  const text = document.createElement("span");
  text.textContent = excerpt(section, word);
  item.append(link, text);
  return item;
}

function showFound() {
  const words = search.value.toLowerCase().split(/\s+/).filter((word) => word.length > 1);
  found.hidden = words.length === 0;
  if (words.length === 0 || !window.searchIndex) return;
  const best = window.searchIndex
    .map((section) => [score(section, words), section])
    .filter(([points]) => points > 0)
    .sort(([a], [b]) => b - a)
    .slice(0, MOST);
  found.replaceChildren(...best.map(([, section]) => result(section, words[0])));
  if (best.length === 0) found.textContent = "Nothing found.";
}

search.addEventListener("focus", loadIndex);
search.addEventListener("input", () => {
  loadIndex();
  showFound();
});
search.addEventListener("keydown", (event) => {
  if (event.key === "Enter") found.querySelector("a")?.click();
  if (event.key !== "Escape") return;
  search.value = "";
  showFound();
});
