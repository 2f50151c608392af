"use strict";
// Light or dark: what the system prefers until the reader chooses. Runs in the head, so
// that the page never flashes in the wrong colours. Says "themechange" on the document.

const theme = {
  get dark() {
    return document.documentElement.dataset.theme === "dark";
  },

  set(dark) {
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    document.dispatchEvent(new Event("themechange"));
  },

  // The value of a custom property of style, for canvases.
  color(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  },

  // Pages opened from disk may not be allowed to store anything.
  remembered() {
    try {
      return localStorage.getItem("lanelight-theme");
    } catch {
      return null;
    }
  },

  remember(dark) {
    try {
      localStorage.setItem("lanelight-theme", dark ? "dark" : "light");
    } catch {
      // The choice holds for this visit only.
    }
  },

  start() {
    const system = matchMedia("(prefers-color-scheme: dark)");
    const stored = theme.remembered();
    theme.set(stored ? stored === "dark" : system.matches);
    system.addEventListener("change", (event) => {
      if (!theme.remembered()) theme.set(event.matches);
    });
    theme.printLight();
  },

  // Paper is white: canvases are drawn anew in light colours before printing.
  printLight() {
    let before = false;
    addEventListener("beforeprint", () => {
      before = theme.dark;
      theme.set(false);
    });
    addEventListener("afterprint", () => theme.set(before));
  },

  bindButton(button) {
    const show = () => button.setAttribute("aria-pressed", String(theme.dark));
    button.addEventListener("click", () => {
      theme.set(!theme.dark);
      theme.remember(theme.dark);
    });
    document.addEventListener("themechange", show);
    show();
  },
};

theme.start();
