"""How the page looks, on the screen and printed. Only black, white and greys, but in the view."""

CSS = """
:root { color-scheme: light; }
html { font: 16px/1.45 "Liberation Sans", "DejaVu Sans", Arial, Helvetica, sans-serif; color: #111; background: #fff; }
body { max-width: 66rem; margin: 0 auto; padding: 1rem 1.25rem 3rem; overflow-wrap: break-word; }
h1 { font-size: 1.7rem; line-height: 1.2; margin: 0.6rem 0; }
h2 { font-size: 1.3rem; margin: 2.2rem 0 0.6rem; border-bottom: 2px solid #111; }
h3 { font-size: 1.08rem; margin: 1.6rem 0 0.5rem; }
.job > h2 { font-size: 1.5rem; border-bottom-width: 4px; margin-top: 3.5rem; }
.sort { color: #444; margin: 0; }
.status { border: 2px solid #111; padding: 0.5rem 0.9rem; margin: 1rem 0; }
.status p { margin: 0.35rem 0; }
.status .word { font-size: 1.15rem; font-weight: bold; }
.failed { border: 8px solid #111; }
.failed .word { font-size: 2.6rem; line-height: 1.15; font-weight: 900; }
.failed .means { font-size: 1.2rem; font-weight: bold; }
nav { margin: 1rem 0; } nav ul { margin: 0.2rem 0; padding-left: 1.4rem; }
nav > ul { columns: 16rem auto; } nav li { break-inside: avoid; }
a { color: #111; }
sub { line-height: 0; font-size: 0.75em; }
.wide { overflow-x: auto; margin: 0.6rem 0 1.2rem; }
table { border-collapse: collapse; font-size: 0.875rem; font-variant-numeric: tabular-nums; }
caption { text-align: left; font-weight: bold; padding: 0.2rem 0; white-space: nowrap; }
th, td { text-align: left; vertical-align: top; padding: 0.14rem 0.7rem 0.14rem 0; border-bottom: 1px solid #bbb; }
thead th { border-bottom: 1.5px solid #111; vertical-align: bottom; }
tbody th { font-weight: normal; white-space: nowrap; }
.number { text-align: right; }
td.number { white-space: nowrap; }
.many th, .many td { padding-right: 0.5rem; }
.note { font-size: 0.875rem; color: #333; margin: -0.7rem 0 1.2rem; }
.messages li { margin: 0.35rem 0; white-space: pre-wrap; }
.unit { white-space: nowrap; }
.figures { display: flex; flex-wrap: wrap; gap: 1.6rem 2rem; align-items: flex-start; }
figure { margin: 0; flex: 0 0 auto; max-width: 100%; }
figure.narrow { flex: 0 1 calc(50% - 1rem); min-width: min(100%, 22rem); }
figure img { display: block; max-width: 100%; height: auto; }
figcaption { font-size: 0.9rem; margin-top: 0.35rem; max-width: 42rem; }
pre { font: 0.8rem/1.35 "Liberation Mono", "DejaVu Sans Mono", "Courier New", monospace; white-space: pre-wrap;
   border: 1px solid #888; padding: 0.6rem; margin: 0.6rem 0; }
.controls { display: flex; flex-wrap: wrap; gap: 0.4rem 1.4rem; align-items: center; margin: 0.6rem 0; }
.controls label { display: inline-flex; gap: 0.4rem; align-items: center; }
.controls input[type=range] { width: min(14rem, 40vw); accent-color: #111; } .controls output { min-width: 4rem; }
.controls select { font: inherit; max-width: 60vw; }
.view .scene { height: min(75vh, 44rem); min-height: 24rem; border: 1px solid #888; }
.curves { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 20rem), 1fr)); gap: 1rem; margin: 1rem 0; }
.curve { height: 20rem; min-width: 0; }
footer { margin-top: 2.5rem; border-top: 1px solid #111; font-size: 0.875rem; color: #333; }
@page { margin: 16mm 14mm; }
@media print {
   html { font-size: 10.5pt; }
   body { max-width: none; padding: 0; }
   h2, h3, caption { break-after: avoid; }
   figure, tr, .status, .short { break-inside: avoid; }
   table { font-size: 8.5pt; }
   thead { display: table-header-group; }
   .wide { overflow: visible; }
   .many table { font-size: 6.5pt; } .many th, .many td { padding-right: 0.35rem; }
   .job[id] { break-before: page; }
   figure img { max-height: 22cm; width: auto; }
   figure.narrow img { max-height: 9.5cm; }
   figure.narrow { min-width: 0; }
   figcaption { font-size: 0.8rem; }
   a { text-decoration: none; }
   .view-section { display: none; }
}
""".strip()
