// On every page, and on those of the documentation: boxes that scroll can be reached with the keyboard.
"use strict";
(() => {
  const boxes = document.querySelectorAll(".wide, .table-wrapper, pre, figure.still");
  const words = { PRE: "text", FIGURE: "picture" };
  function reachable() {
    for (const box of boxes) {
      if (box.scrollWidth > box.clientWidth + 1) {
        box.tabIndex = 0;
        box.setAttribute("role", "group");
        box.setAttribute("aria-label", `${words[box.tagName] || "table"}, scrolls sideways`);
      } else {
        for (const name of ["tabindex", "role", "aria-label"]) box.removeAttribute(name);
      }
    }
  }
  reachable();
  addEventListener("resize", reachable);
})();
