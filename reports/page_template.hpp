// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The mustache templates and the style sheet of report pages.
#pragma once

namespace isotach::reports {

/// The page. Sizes are in pixels because figures are: see figure_script.cpp.
inline constexpr const char* kPageTemplate = R"html(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{title}}</title>
<style>
:root { --ink: #1d2329; --quiet: #5a6570; --rule: #d4d9de; --shade: #f5f7f8;
        --good: #00694d; --warning: #8a5a00; --bad: #a8320a; }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 40px 24px 64px; max-width: 768px; color: var(--ink); background: #fff;
       font: 15px/1.5 Helvetica, Arial, "Liberation Sans", "DejaVu Sans", sans-serif;
       font-variant-numeric: tabular-nums; }
header { border-bottom: 2px solid var(--ink); margin-bottom: 24px; padding-bottom: 10px; }
h1 { font-size: 26px; line-height: 1.2; margin: 0 0 4px; }
header p { color: var(--quiet); margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 19px; line-height: 1.3; margin: 40px 0 12px; padding-bottom: 4px;
     border-bottom: 1px solid var(--rule); }
#summary > h2 { margin-top: 0; }
h3 { font-size: 16px; line-height: 1.3; margin: 28px 0 8px; }
p { margin: 0 0 12px; }
a { color: inherit; }
.verdicts { list-style: none; margin: 0 0 20px; padding: 0; }
.verdict, .box { position: relative; margin: 0 0 8px; padding: 8px 12px 8px 36px; background: var(--shade);
                     border-left: 4px solid var(--quiet); }
.box { margin: 16px 0; white-space: pre-line; }
.sign { position: absolute; left: 13px; font-weight: bold; color: var(--quiet); }
.good { border-color: var(--good); } .good .sign { color: var(--good); }
.warning { border-color: var(--warning); } .warning .sign { color: var(--warning); }
.bad { border-color: var(--bad); } .bad .sign { color: var(--bad); }
dl { display: grid; grid-template-columns: minmax(130px, max-content) 1fr; margin: 0 0 20px; }
dt, dd { margin: 0; padding: 4px 0; border-bottom: 1px solid var(--rule); overflow-wrap: anywhere; }
dt { color: var(--quiet); padding-right: 24px; }
.contents ol { margin: 0; padding-left: 24px; columns: 2; }
.contents h3 { font-size: 15px; margin: 20px 0 4px; }
.scroll { overflow-x: auto; margin: 16px 0 20px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; line-height: 1.35; }
caption { text-align: left; padding-bottom: 6px; }
caption b, figcaption b { font-weight: bold; }
thead { display: table-header-group; }
th { font-weight: bold; vertical-align: bottom; border-top: 1.5px solid var(--ink);
     border-bottom: 1px solid var(--ink); }
td { vertical-align: top; border-bottom: 1px solid var(--rule); }
tbody tr:last-child td { border-bottom: 1.5px solid var(--ink); }
th, td { padding: 4px 8px; text-align: left; }
th:first-child, td:first-child { padding-left: 0; }
td:first-child { white-space: nowrap; } th:last-child, td:last-child { padding-right: 0; }
.right { text-align: right; } td.right { white-space: nowrap; } .centre { text-align: center; }
.notes { margin: 6px 0 0; color: var(--quiet); font-size: 13px; }
.figures { margin: 20px 0 24px; }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 16px; }
figure { margin: 0; min-width: 0; }
figure svg { display: block; margin: 0 auto; }
figcaption { margin-top: 6px; font-size: 14px; line-height: 1.4; }
pre { margin: 16px 0; padding: 10px 12px; background: var(--shade); overflow-x: auto;
      font: 12.5px/1.4 "DejaVu Sans Mono", Menlo, Consolas, monospace; }
@media (max-width: 600px) { .pair { grid-template-columns: 1fr; } }
@page { size: A4; margin: 18mm 16mm 20mm; @bottom-right { content: counter(page); font: 9pt Helvetica, sans-serif; } }
@media print {
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  table, figcaption { font-size: 9.5pt; }
  .notes { font-size: 9pt; }
  pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 8.5pt; }
  .first-page { break-after: page; font-size: 9pt; line-height: 1.35; }
  .first-page .contents { display: none; }
  .first-page .verdict { padding: 5px 12px 5px 36px; margin-bottom: 5px; }
  .first-page .verdicts, .first-page dl { margin-bottom: 12px; }
  .first-page dt, .first-page dd { padding: 2px 0; }
  .first-page .scroll, .first-page .figures { margin: 10px 0; }
  .first-page table, .first-page figcaption { font-size: 8.5pt; line-height: 1.25; }
  .first-page th, .first-page td { padding-top: 2px; padding-bottom: 2px; }
  .first-page + section > h2 { margin-top: 0; }
  h2, h3, caption, thead { break-after: avoid; }
  tbody tr:nth-child(-n+2) { break-before: avoid; }
  tr, figure, .pair, .box, .verdict, .short, dt, dd { break-inside: avoid; }
  .scroll { overflow: visible; }
  .pair { grid-template-columns: 1fr 1fr; }
  p, li { orphans: 3; widows: 3; }
  a { text-decoration: none; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style>
</head>
<body>
<header>
<h1>{{title}}</h1>
{{#subtitle}}
<p>{{subtitle}}</p>
{{/subtitle}}
</header>
<main>
<section id="summary"{{#has_sections}} class="first-page"{{/has_sections}}>
<h2>Summary</h2>
{{#has_verdicts}}
<ul class="verdicts">
{{#verdicts}}
<li class="verdict {{class}}"><span class="sign">{{sign}}</span>{{text}}</li>
{{/verdicts}}
</ul>
{{/has_verdicts}}
{{#has_facts}}
<dl>
{{#facts}}
<dt>{{name}}</dt><dd>{{value}}</dd>
{{/facts}}
</dl>
{{/has_facts}}
{{#summary_blocks}}
{{>block_list}}
{{/summary_blocks}}
{{#has_contents}}
<nav class="contents">
<h3>Contents</h3>
<ol>
{{#sections}}
<li><a href="#{{anchor}}">{{heading}}</a></li>
{{/sections}}
</ol>
</nav>
{{/has_contents}}
</section>
{{#sections}}
<section id="{{anchor}}">
<h2>{{heading}}</h2>
{{#blocks}}
{{>block_list}}
{{/blocks}}
</section>
{{/sections}}
</main>
</body>
</html>
)html";

/// One block of any kind.
inline constexpr const char* kBlocksTemplate = R"html({{#heading}}
<h3>{{text}}</h3>
{{/heading}}
{{#paragraph}}
<p>{{text}}</p>
{{/paragraph}}
{{#table}}
<div class="scroll{{#short}} short{{/short}}">
<table>
{{#caption}}
<caption><b>Table {{number}}.</b> {{caption}}</caption>
{{/caption}}
<thead>
<tr>{{#header}}<th scope="col" class="{{class}}">{{text}}</th>{{/header}}</tr>
</thead>
<tbody>
{{#rows}}
<tr>{{#cells}}<td class="{{class}}"{{#shade}} style="background:{{shade}}"{{/shade}}>{{text}}</td>{{/cells}}</tr>
{{/rows}}
</tbody>
</table>
{{#notes}}
<p class="notes">{{text}}</p>
{{/notes}}
</div>
{{/table}}
{{#figures}}
<div class="figures {{class}}">
{{#items}}
<figure id="figure-{{number}}">
{{{svg}}}
<figcaption><b>Figure {{number}}.</b> {{caption}}</figcaption>
</figure>
{{/items}}
</div>
{{/figures}}
{{#box}}
<div class="box {{class}}"><span class="sign">{{sign}}</span>{{text}}</div>
{{/box}}
{{#preformatted}}
<pre>{{text}}</pre>
{{/preformatted}}
)html";

}  // namespace isotach::reports
