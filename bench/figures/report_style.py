"""Contains the CSS and the JavaScript of the report page."""

from figures.report_html import CROP_WIDTH
from figures.report_svg import PALETTE

STYLE = """
:root { color-scheme: light dark; --page:#fff; --ink:#1c1e21; --soft:#565b62; --grid:#d8dce1; --band:#f4f5f7; LIGHT }
@media (prefers-color-scheme: dark) {
  :root { --page:#15171a; --ink:#e9ebee; --soft:#a8aeb6; --grid:#3a3f46; --band:#1e2125; DARK }
}
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 2rem 1.2rem 4rem; max-width: 80rem; background: var(--page); color: var(--ink);
  font: 16px/1.5 system-ui, sans-serif; }
h1 { margin: 0; font-size: 1.9rem; line-height: 1.2; }
h2 { margin: 3rem 0 .6rem; font-size: 1.35rem; }
h3 { margin: 1.6rem 0 .5rem; font-size: 1.05rem; }
p { max-width: 46rem; }
.lead, figcaption { color: var(--soft); }
figure { margin: 0; }
figure.plot, .scroll { overflow-x: auto; }
figure.plot svg { width: 100%; min-width: 44rem; height: auto; display: block; }
figcaption, li { font-size: .85rem; line-height: 1.35; }
figure.plot figcaption { max-width: 46rem; margin-top: .4rem; }
figure.overview svg { width: 100%; max-width: 40rem; height: auto; display: block; }
.strip { display: flex; flex-wrap: wrap; gap: 1.1rem .9rem; }
.crop { width: CROPpx; }
.crop img, .gone { display: block; width: CROPpx; image-rendering: pixelated; margin-bottom: 3px; }
.gone { height: 4rem; background: var(--band); text-align: center; padding-top: 1.2rem; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(18rem, 1fr)); gap: 12px; }
.wide img { display: block; max-width: 100%; height: auto; margin-bottom: 3px; }
.scroll, .facts { margin-top: 1rem; }
table { border-collapse: collapse; font-size: .82rem; font-variant-numeric: tabular-nums; }
th, td { padding: .28rem .42rem; text-align: right; border-bottom: 1px solid var(--grid); vertical-align: top; }
thead th { vertical-align: bottom; background: var(--band); hyphens: auto; cursor: pointer; }
th:first-child, .text { text-align: left; }
tbody th { font-weight: normal; }
.scroll table { font-size: .76rem; }
.scroll th, .scroll td { padding: .28rem .26rem; }
.scroll tbody th { min-width: 8rem; }
.facts th { color: var(--soft); }
thead th[aria-sort=ascending]::after { content: " ↑"; }
thead th[aria-sort=descending]::after { content: " ↓"; }
.scroll th:first-child { position: sticky; left: 0; background: var(--page); }
.scroll thead th:first-child { background: var(--band); }
.headline { font-size: 1.2rem; margin: .6rem 0; }
nav ul { display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; padding: 0; list-style: none; }
a { color: var(--c0); }
[data-value] { cursor: help; }
#tip { position: fixed; max-width: min(24rem, 92vw); padding: .25rem .5rem; border-radius: 4px; background: var(--ink);
  color: var(--page); font-size: .82rem; pointer-events: none; }
@media (max-width: 40rem) {
  body { padding: 1rem .8rem 3rem; }
  figure.plot svg { min-width: 0; }
  figure.plot.large svg { min-width: 44rem; }
  .facts, .facts tbody, .facts tr, .facts th, .facts td { display: block; }
  .facts th { border: 0; padding-bottom: 0; }
}
pre { margin: 0 0 .3rem; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem; }
"""
# Sorts a table when a column header is clicked, and shows the value of the point under the mouse pointer or finger.
SCRIPT = r"""
for (const table of document.querySelectorAll('.scroll table')) {
  const heads = table.tHead.rows[0].cells, body = table.tBodies[0];
  const value = (row, i) => { const text = row.cells[i].textContent, n = parseFloat(text.replace(/^under /, ''));
    return ['', '—', '∞', 'not reached'].includes(text) ? Infinity : isNaN(n) ? text : /^[^a-z]* s\b/.test(text) ? 1000 * n : n; };
  [...heads].forEach((head, i) => {
    const sort = () => {
      const up = head.getAttribute('aria-sort') !== 'ascending';
      for (const each of heads) each.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', up ? 'ascending' : 'descending');
      const order = (a, b) => typeof a === 'number' && typeof b === 'number' ? (a === b ? 0 : a - b) : String(a).localeCompare(String(b));
      body.append(...[...body.rows].sort((a, b) => (up ? 1 : -1) * order(value(a, i), value(b, i))));
    };
    head.tabIndex = 0;
    head.addEventListener('click', sort);
    head.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });
  });
}
const tip = document.getElementById('tip');
const show = event => {
  const text = event.target.dataset && event.target.dataset.value;
  tip.hidden = !text;
  if (!text) return;
  tip.textContent = text;
  const box = event.target.getBoundingClientRect();
  tip.style.left = Math.max(4, Math.min(box.left, innerWidth - tip.offsetWidth - 4)) + 'px';
  tip.style.top = Math.max(4, box.top - tip.offsetHeight - 6) + 'px';
};
for (const kind of ['pointerover', 'focusin', 'pointerdown']) document.addEventListener(kind, show);
addEventListener('scroll', () => tip.hidden = true, true);
// On a phone a plot fits the screen, and a tap makes it large enough to read.
for (const plot of document.querySelectorAll('figure.plot'))
  plot.addEventListener('click', event => event.target.dataset.value || plot.classList.toggle('large'));
"""


def style():
    """Returns the CSS, with the colours of the palette as variables --c0, --c1, …"""
    light, dark = ("".join(f"--c{i}:{colours[side]};" for i, colours in enumerate(PALETTE)) for side in (0, 1))
    return STYLE.replace("LIGHT", light).replace("DARK", dark).replace("CROP", str(CROP_WIDTH))
