// On every page, and on those of the documentation: tables scroll in boxes of their own, and boxes that
// scroll can be reached with the keyboard.
"use strict";
(() => {
  const UNIT = /(\d) (?=([µmk]?[msgKNJW](\/[a-z]+)?|Hz|°C?|%)([\s,;:.)]|$))/g;
  // a number keeps its unit on its line; a long name breaks between its words
  for (const { childNodes } of document.querySelectorAll("#content :is(h1, p, figcaption, .tiles b)")) {
    for (const node of [...childNodes].filter((each) => each.nodeType === Node.TEXT_NODE)) {
      const bound = node.data.replace(UNIT, "$1\u00a0");
      const [first, ...others] = bound.split(/(?<=[a-z][._])(?=[a-z])/);
      node.replaceWith(first, ...others.flatMap((part) => [document.createElement("wbr"), part]));
    }
  }
  // of more columns than two, where the window is narrow each row is a list
  for (const table of document.querySelectorAll("#content table:has(thead th:nth-child(3))")) {
    table.classList.add("listed");
    const heads = [...table.tHead.rows[0].cells].map((head) => head.textContent.trim());
    for (const { cells } of table.tBodies[0].rows) {
      if (cells.length !== heads.length) continue; // some go over several columns
      // a name in the first column says what it is; a number does not
      const first = cells[0].classList.contains("n") ? 0 : 1;
      for (let n = first; n < cells.length; n++) cells[n].dataset.head = heads[n];
      for (const cell of cells) cell.classList.toggle("none", /^–?$/.test(cell.textContent.trim()));
    }
  }
  for (const table of document.querySelectorAll("table")) {
    if (table.closest(".wide, .table-wrapper")) continue;
    const box = document.createElement("div");
    box.className = "wide";
    table.replaceWith(box);
    box.append(table);
  }
  const boxes = document.querySelectorAll(".wide, .table-wrapper, pre, figure.still");
  const words = { PRE: "text", FIGURE: "picture" };
  function reachable() {
    for (const box of boxes) {
      if (box.scrollWidth > box.clientWidth + 1) {
        box.tabIndex = 0;
        if (box.tagName !== "FIGURE") box.setAttribute("role", "group"); // which a figure is anyway
        box.setAttribute("aria-label", `${words[box.tagName] || "table"}, scrolls sideways`);
      } else {
        for (const name of ["tabindex", "role", "aria-label"]) box.removeAttribute(name);
      }
    }
  }
  reachable();
  addEventListener("resize", reachable);
})();
