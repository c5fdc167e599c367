// How index.html looks: one column on a telephone, contents beside the figures on a screen, no figure broken
// across pages in print. Pictures are drawn for white paper and keep it in the dark.
#pragma once

namespace temper::gallery {

inline constexpr const char* kIndexStyle = R"css(
:root {
  color-scheme: light dark;
  --ink: #1d2127; --soft: #59626d; --page: #f7f6f3; --card: #ffffff; --rule: #d8d5cd;
  --link: #005fa3; --yes: #00714f; --no: #b3350c; --no-card: #fdf1ec;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ink: #e4e2dd; --soft: #a5a9ae; --page: #17191c; --card: #202327; --rule: #3a3e44;
    --link: #7bbcf0; --yes: #55c79f; --no: #ff9166; --no-card: #33241d;
  }
}
* { box-sizing: border-box; }
html { scroll-behavior: smooth; scroll-padding-top: 1rem; }
body {
  margin: 0; background: var(--page); color: var(--ink);
  font: 1rem/1.5 Charter, "Bitstream Charter", "Iowan Old Style", "Source Serif 4", Georgia, serif;
}
a { color: var(--link); text-decoration: none; }
a:hover { text-decoration: underline; }
header, .body, footer { max-width: 100rem; margin: 0 auto; padding: 0 1.5rem; }
header { padding-top: 2.5rem; }
h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .5rem; text-wrap: balance; }
h2 { font-size: 1.35rem; line-height: 1.25; margin: 0 0 .75rem; text-wrap: balance; }
h2 a { color: inherit; }
h2 .number { color: var(--soft); font-weight: normal; margin-right: .5em; }
h3 { font-size: 1rem; margin: 1.5rem 0 .25rem; }
p { max-width: 46rem; }
sub, sup { line-height: 0; font-size: .72em; }
.sum { font-size: 1.15rem; }
.yes { color: var(--yes); } .no { color: var(--no); }
nav, .tables, .claims, footer, .label { font-family: "Inter", "Source Sans 3", "Helvetica Neue", Arial, sans-serif; }
nav { font-size: .86rem; line-height: 1.35; margin: 1.5rem 0; }
nav h2 { font-size: .8rem; letter-spacing: .06em; text-transform: uppercase; color: var(--soft); }
nav ol { list-style: none; margin: 0; padding: 0; columns: 16rem; column-gap: 2rem; }
nav li { display: grid; grid-template-columns: 1.8rem 1fr auto; gap: .5rem; padding: .2rem 0; break-inside: avoid; }
nav .number, nav .count { color: var(--soft); font-variant-numeric: tabular-nums; white-space: nowrap; }
nav .count.no { color: var(--no); }
section { border-top: 1px solid var(--rule); padding: 1.75rem 0 2.25rem; }
.paper { margin: 0 0 1.25rem; padding-left: 1rem; border-left: 3px solid var(--rule); color: var(--soft); }
.label { font-size: .74rem; letter-spacing: .06em; text-transform: uppercase; display: block; }
.pictures { display: grid; gap: 1.25rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 26rem), 1fr)); align-items: start; }
figure { margin: 0; max-width: 52rem; }
figure img { display: block; width: 100%; background: #fff; border: 1px solid var(--rule); border-radius: 3px; padding: .5rem; }
figcaption { font-size: .9rem; line-height: 1.4; margin-top: .4rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .86rem; line-height: 1.4; }
.tables table { font-variant-numeric: tabular-nums lining-nums; }
.caption { margin: 1.5rem 0 .35rem; font-size: .9rem; line-height: 1.4; }
th { text-align: left; font-weight: 600; border-bottom: 1.5px solid var(--ink); padding: .3rem .9rem .3rem 0; vertical-align: bottom; }
td { border-bottom: 1px solid var(--rule); padding: .3rem .9rem .3rem 0; vertical-align: top; }
.n { text-align: right; }
.claims { width: 100%; margin-top: 1.75rem; table-layout: fixed; }
.claims col.verdict { width: 2.2rem; } .claims col.says { width: 40%; }
.claims td { padding-top: .5rem; padding-bottom: .5rem; overflow-wrap: break-word; }
.claims td:first-child { font-size: 1.05rem; line-height: 1.2; font-weight: 700; }
.claims tr.failed td { background: var(--no-card); }
.claims tr.failed td:first-child { padding-left: .5rem; }
.why { display: block; color: var(--soft); font-size: .95em; margin-top: .2rem; }
.where { color: var(--soft); white-space: nowrap; }
.hidden { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.failing { padding-left: 1.2rem; max-width: 60rem; }
footer { color: var(--soft); font-size: .82rem; padding-top: 1rem; padding-bottom: 3rem; }
@media (min-width: 75rem) {
  .body { display: grid; grid-template-columns: 17rem minmax(0, 1fr); gap: 3rem; }
  nav { position: sticky; top: 0; max-height: 100vh; overflow-y: auto; align-self: start; margin: 0; padding: 1.75rem 0; }
  nav ol { columns: auto; }
  .pictures.threes { grid-template-columns: repeat(3, 1fr); }
}
@media (max-width: 44rem) {
  header, .body, footer { padding-left: 1rem; padding-right: 1rem; }
  .claims, .claims tbody { display: block; }
  .claims thead, .claims colgroup { display: none; }
  .claims tr { display: grid; grid-template-columns: 2rem 1fr; border-bottom: 1px solid var(--rule); padding: .5rem 0; }
  .claims td { display: block; border: 0; padding: .1rem 0; grid-column: 2; }
  .claims td:first-child { grid-column: 1; grid-row: 1; }
  .claims td[data-label]::before { content: attr(data-label) ": "; color: var(--soft); }
}
@media print {
  :root { --ink: #000; --soft: #444; --page: #fff; --card: #fff; --rule: #bbb; --link: #000; --no-card: #fff; }
  body { font-size: 9.5pt; }
  .body { display: block; }
  nav { position: static; max-height: none; overflow: visible; }
  nav ol { columns: 2; }
  figure, tr, h2, .paper { break-inside: avoid; }
  h2, .paper, thead { break-after: avoid; }
  .pictures { grid-template-columns: repeat(2, 1fr); }
  .pictures > :only-child { grid-column: 1 / -1; max-width: 14cm; }
  figure img { max-height: 20cm; object-fit: contain; border: 0; }
}
)css";

}  // namespace temper::gallery
