"use strict";
/* Values as people type them: "0.67", "670 g", "15 cm/s", "3 deg", "5 %"; and as they are read. */

// Symbol -> [factor, dimension], dimensions as exponents of m, kg, s, K, rad.
const UNIT = {
  m: [1, { m: 1 }], g: [1e-3, { kg: 1 }], s: [1, { s: 1 }], K: [1, { K: 1 }], rad: [1, { rad: 1 }],
  deg: [Math.PI / 180, { rad: 1 }], "°": [Math.PI / 180, { rad: 1 }],
  N: [1, { m: 1, kg: 1, s: -2 }], J: [1, { m: 2, kg: 1, s: -2 }], W: [1, { m: 2, kg: 1, s: -3 }],
  Pa: [1, { m: -1, kg: 1, s: -2 }], Hz: [1, { s: -1 }], min: [60, { s: 1 }], h: [3600, { s: 1 }],
  "%": [1e-2, {}], 1: [1, {}],
};
const PREFIX = { G: 1e9, M: 1e6, k: 1e3, c: 1e-2, m: 1e-3, "µ": 1e-6, "μ": 1e-6, u: 1e-6, n: 1e-9 };

/* Factor and dimension of a unit such as "N.s/m" or "W/(m2.K)"; null for what is none. */
function parsedUnit(text) {
  let factor = 1;
  const dimension = {};
  const parts = text.replace(/²/g, "2").replace(/³/g, "3").replace(/[·*]/g, ".").split("/");
  for (let i = 0; i < parts.length; i++) {
    const sign = i === 0 ? 1 : -1; // "a/b/c" and "a/(b.c)" both divide by b and c
    for (const one of parts[i].replace(/[()\s]/g, "").split(/\.(?!\d)/)) {
      const found = /^([A-Za-zµμ°%]+|1)(-?\d+(?:\.\d+)?)?$/.exec(one);
      const known = found && symbol(found[1]);
      if (!known) return null;
      const power = sign * Number(found[2] ?? 1);
      factor *= known[0] ** power;
      for (const [name, of] of Object.entries(known[1])) {
        dimension[name] = (dimension[name] || 0) + of * power;
      }
    }
  }
  return { factor, dimension };
}

/* A symbol, with a prefix or without; the symbol by itself comes first: "min" is no milli-inch. */
function symbol(text) {
  if (Object.hasOwn(UNIT, text)) return UNIT[text];
  const rest = text.slice(1);
  if (rest in UNIT && text[0] in PREFIX && rest !== "%" && rest !== "1") {
    return [PREFIX[text[0]] * UNIT[rest][0], UNIT[rest][1]];
  }
  return null;
}

/* A text as number and what is behind it; null for what does not begin with a number. */
const quantityOf = (text) =>
  /^\s*([-+−]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/.exec(text.replace(",", "."));

/* What is wrong with a text that is no value; notIn: the words for one with another unit. */
const wrongIn = (notIn, text) =>
  /^[\p{L}°%]/u.test(quantityOf(text)?.[2] ?? "") ? notIn : "not a number";

/* The number that a text stands for in a unit; NaN for what is none, or is of another kind. */
function typedValue(text, unit) {
  const found = quantityOf(text);
  if (!found) return NaN;
  const number = Number(found[1].replace("−", "-")), given = found[2].replace(/^°C$/, "degC");
  if (given === "" || given === unit) return number;
  if (unit === "degC" && given === "K") return Number((number - 273.15).toPrecision(15));
  const one = parsedUnit(given), other = parsedUnit(unit);
  if (!one || !other) return NaN;
  const names = [...Object.keys(one.dimension), ...Object.keys(other.dimension)];
  const apart = (name) => Math.abs((one.dimension[name] || 0) - (other.dimension[name] || 0)) > 1e-9;
  if (names.some(apart)) return NaN;
  // to the digits that were typed: 67 mm is 0.067, not 0.06700000000000001
  return Number((number * (one.factor / other.factor)).toPrecision(15));
}
