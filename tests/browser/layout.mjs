// What a reader's eye would find: text that overlaps, leaves the page or is too faint.

/** Runs in the page: elements that hold text of their own and can be seen. */
const TEXTS = `
  const shown = (e) => e.checkVisibility({ opacityProperty: true, visibilityProperty: true }) && !e.closest("[aria-hidden=true] b, .u-legend, svg, dialog, noscript");
  const own = (e) => [...e.childNodes].some((n) => n.nodeType === Node.TEXT_NODE && n.textContent.trim());
  const texts = [...document.body.querySelectorAll("*")].filter((e) => !["SCRIPT", "STYLE", "OPTION", "TITLE"].includes(e.tagName) && own(e) && shown(e));
  const name = (e) => e.tagName.toLowerCase() + (e.className ? "." + e.className : "") + ' "' + e.textContent.trim().slice(0, 40) + '"';
`;

/** Pairs of texts that lie on one another, and texts outside the page or cut off. */
export async function overlaps(page) {
  return page.evaluate(`(() => {
    ${TEXTS}
    const faults = [];
    const wide = document.documentElement;
    if (wide.scrollWidth > wide.clientWidth) faults.push("the page is " + wide.scrollWidth + " px wide, the window " + wide.clientWidth);
    // The lines of text themselves, not the boxes around them.
    const lines = [];
    for (const e of texts) {
      const clip = e.closest(".scroll, pre")?.getBoundingClientRect();
      for (const n of e.childNodes) {
        if (n.nodeType !== Node.TEXT_NODE || !n.textContent.trim()) continue;
        const range = document.createRange();
        range.selectNodeContents(n);
        for (const r of range.getClientRects()) {
          if (clip && (r.left >= clip.right - 1 || r.right <= clip.left + 1)) continue; // to be scrolled to
          if (r.width > 1 && r.height > 1) lines.push({ e, left: r.left, right: r.right, top: r.top + 0.2 * r.height, bottom: r.bottom - 0.2 * r.height, clip });
          if (!clip && (r.left < -1 || r.right > wide.clientWidth + 1)) faults.push("leaves the page: " + name(e));
        }
      }
    }
    lines.sort((a, b) => a.top - b.top);
    for (let i = 0; i < lines.length; ++i)
      for (let j = i + 1; j < lines.length && lines[j].top < lines[i].bottom; ++j) {
        const [a, b] = [lines[i], lines[j]];
        if (a.e === b.e || a.e.contains(b.e) && b.e.contains(a.e)) continue;
        const across = Math.min(a.right, b.right) - Math.max(a.left, b.left);
        const down = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
        if (across > 1.5 && down > 1.5) faults.push(name(a.e) + " lies on " + name(b.e));
      }
    // Controls that can be pressed must not lie on one another either.
    const buttons = [...document.querySelectorAll("button, select, a, summary")].filter(shown).map((e) => [e, e.getBoundingClientRect()]);
    for (let i = 0; i < buttons.length; ++i)
      for (let j = i + 1; j < buttons.length; ++j) {
        const [a, b] = [buttons[i][1], buttons[j][1]];
        if (Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1.5 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 1.5)
          faults.push(name(buttons[i][0]) + " lies on " + name(buttons[j][0]));
      }
    return [...new Set(faults)].slice(0, 20);
  })()`);
}

/**
 * Texts whose contrast with what is behind them is below WCAG 2.1 AA: 4.5, or 3 for large ones. What is behind: the
 * backgrounds of the elements around, one over the other; over the scene the darkest and the lightest it can be.
 */
export async function faintTexts(page) {
  return page.evaluate(`(() => {
    ${TEXTS}
    const parse = (c) => { const v = c.match(/[\\d.]+/g).map(Number); return { rgb: v.slice(0, 3), a: v.length > 3 ? v[3] : 1 }; };
    const over = (top, bottom) => top.rgb.map((v, i) => top.a * v + (1 - top.a) * bottom[i]);
    const luminance = (rgb) => {
      const [r, g, b] = rgb.map((v) => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const contrast = (a, b) => { const [x, y] = [luminance(a), luminance(b)].sort((p, q) => q - p); return (x + 0.05) / (y + 0.05); };
    const faults = [];
    for (const e of texts) {
      const style = getComputedStyle(e);
      const layers = [];
      let overScene = false;
      for (let at = e; at; at = at.parentElement) {
        if (at.id === "stage") { overScene = layers.every((l) => l.a < 1); break; }
        layers.push(parse(getComputedStyle(at).backgroundColor));
        if (layers.at(-1).a === 1) break;
      }
      const bases = overScene ? [[20, 20, 20], [255, 255, 255]] : [[255, 255, 255]];
      for (const base of bases) {
        const behind = layers.reduceRight((below, layer) => over(layer, below), base);
        const ratio = contrast(over(parse(style.color), behind), behind);
        const size = parseFloat(style.fontSize);
        const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
        if (ratio < (large ? 3 : 4.5)) { faults.push("contrast " + ratio.toFixed(2) + ": " + name(e)); break; }
      }
    }
    return [...new Set(faults)].slice(0, 20);
  })()`);
}
