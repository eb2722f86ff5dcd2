// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Tests of report pages.
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "reports/page.hpp"

namespace isotach::reports {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

bool has(const std::string& text, const std::string& part) {
  return count(text, part) > 0;
}

Figure small_figure(const std::string& caption) {
  Figure figure;
  figure.caption = caption;
  figure.series = {{.label = "measured", .x = {0.0, 1.0, 2.0}, .y = {0.0, 1.0, 4.0}}};
  return figure;
}

TEST(Page, EscapesAllText) {
  const std::string evil = "<b>&\"'{{title}}";
  const std::string escaped = "&lt;b&gt;&amp;&quot;&apos;{{title}}";
  Page page("T" + evil, "S" + evil);
  page.fact("N" + evil, "V" + evil);
  page.verdict(Tone::good, "W" + evil);
  page.section("H" + evil);
  page.paragraph("P" + evil);
  page.box(Tone::plain, "B" + evil);
  page.preformatted("F" + evil);
  page.table({.caption = "C" + evil, .header = {"X" + evil}, .rows = {{"Y" + evil}}, .notes = {"Z" + evil}});
  const std::string html = page.html();
  EXPECT_FALSE(has(html, evil));
  for (const char* mark : {"S", "N", "V", "W", "H", "P", "B", "F", "C", "X", "Y", "Z"}) {
    EXPECT_EQ(count(html, mark + escaped), 1U) << mark;
  }
  EXPECT_EQ(count(html, "T" + escaped), 2U);  // in the head and on the page
}

TEST(Page, NeedsNothingFromOutside) {
  Page page("t", "s");
  page.figure(small_figure("c"));
  const std::string html = page.html();
  for (const char* part : {"<script", "<link", "<img", "@import", "url(", "src=", "xlink", "href=\"http"}) {
    EXPECT_FALSE(has(html, part)) << part;
  }
}

TEST(Page, IsTheSameEveryTime) {
  const auto html = [] {
    Page page("t", "s");
    page.figures(small_figure("a"), small_figure("b"));
    return page.html();
  };
  EXPECT_EQ(html(), html());
}

TEST(Page, StandsInReadingOrder) {
  Page page("title-text", "subtitle-text");
  page.fact("fact-name", "fact-value");
  page.paragraph("summary-paragraph");
  page.section("first-section");
  page.paragraph("first-paragraph");
  page.table({.header = {"head-cell"}, .rows = {{"body-cell"}}});
  page.section("second-section");
  page.preformatted("a  b\n  c");
  page.verdict(Tone::bad, "verdict-text");
  const std::string html = page.html();
  std::size_t at = 0;
  for (const char* part : {"<h1>title-text", "subtitle-text", "verdict-text", "fact-name", "fact-value",
                           "summary-paragraph", "first-section", "first-paragraph", "<thead>", "head-cell",
                           "<tbody>", "body-cell", "second-section", "<pre>a  b\n  c</pre>"}) {
    const std::size_t next = html.find(part, at);
    ASSERT_NE(next, std::string::npos) << part;
    at = next;
  }
}

TEST(Page, ListsContentsOfMoreThanThreeSections) {
  Page page("t", "s");
  for (const char* heading : {"one", "two", "three"}) page.section(heading);
  EXPECT_FALSE(has(page.html(), "Contents"));
  page.section("four");
  const std::string html = page.html();
  EXPECT_TRUE(has(html, "Contents"));
  EXPECT_TRUE(has(html, "<a href=\"#section-4\">four</a>"));
  EXPECT_EQ(count(html, "id=\"section-4\""), 1U);
}

TEST(Page, NumbersFiguresAndTablesOnTheWay) {
  Page page("t", "s");
  page.figure(small_figure("caption-one"));
  page.section("h");
  page.figures(small_figure("caption-two"), small_figure("caption-three"));
  page.table({.caption = "table-one", .header = {"a"}});
  page.table({.header = {"a"}});
  page.table({.caption = "table-two", .header = {"a"}});
  const std::string html = page.html();
  EXPECT_TRUE(has(html, "<b>Figure 1.</b> caption-one"));
  EXPECT_TRUE(has(html, "<b>Figure 2.</b> caption-two"));
  EXPECT_TRUE(has(html, "<b>Figure 3.</b> caption-three"));
  EXPECT_EQ(count(html, "<svg "), 3U);
  EXPECT_TRUE(has(html, "<b>Table 1.</b> table-one"));
  EXPECT_TRUE(has(html, "<b>Table 2.</b> table-two"));
  EXPECT_FALSE(has(html, "Table 3"));
}

TEST(Page, PutsDrawingsAmongFigures) {
  Page page("t", "s");
  page.drawing({"<svg class=\"drawn\"/>", "caption-one"});
  page.figure(small_figure("caption-two"));
  page.drawing({"<svg class=\"drawn\"/>", "caption-three"});
  const std::string html = page.html();
  const std::size_t first = html.find("class=\"drawn\"");
  const std::size_t plotted = html.find("<svg viewBox");
  const std::size_t last = html.rfind("class=\"drawn\"");
  ASSERT_NE(plotted, std::string::npos);
  EXPECT_LT(first, html.find("<b>Figure 1.</b> caption-one"));
  EXPECT_LT(html.find("<b>Figure 1.</b> caption-one"), plotted);
  EXPECT_LT(plotted, html.find("<b>Figure 2.</b> caption-two"));
  EXPECT_LT(html.find("<b>Figure 2.</b> caption-two"), last);
  EXPECT_LT(last, html.find("<b>Figure 3.</b> caption-three"));
}

TEST(Page, AlignsColumns) {
  Page page("t", "s");
  page.table({.header = {"a", "b", "c"},
              .alignment = {Alignment::right, Alignment::centre},
              .rows = {{"1", "2", "3"}}});
  EXPECT_TRUE(
      has(page.html(), R"(<td class="right">1</td><td class="centre">2</td><td class="left">3</td>)"));
}

TEST(Page, RefusesRaggedTables) {
  Page page("t", "s");
  EXPECT_THROW(page.table({.header = {"a", "b"}, .rows = {{"1"}}}), std::invalid_argument);
  EXPECT_THROW(page.table({.header = {"a"}, .alignment = {Alignment::left, Alignment::left}}),
               std::invalid_argument);
}

TEST(Page, ShadesCells) {
  Page page("t", "s");
  page.table({.header = {"a", "b"}, .rows = {{"1", "2"}}, .shades = {{std::nullopt, Rgb{255, 0, 16}}}});
  const std::string html = page.html();
  EXPECT_EQ(count(html, "background:#ff0010"), 1U);
  EXPECT_TRUE(has(html, "<td class=\"left\">1</td>"));
  EXPECT_THROW(page.table({.header = {"a"}, .rows = {{"1"}}, .shades = {{}, {}}}), std::invalid_argument);
  EXPECT_THROW(page.table({.header = {"a"}, .rows = {{"1"}}, .shades = {{}}}), std::invalid_argument);
}

TEST(Page, PutsFiguresTwoByTwo) {
  Page page("t", "s");
  page.heading("Parts");
  page.figures({small_figure("one"), small_figure("two"), small_figure("three")});
  const std::string html = page.html();
  EXPECT_TRUE(has(html, "<h3>Parts</h3>"));
  EXPECT_EQ(count(html, "<div class=\"figures pair\">"), 2U);
  EXPECT_EQ(count(html, "<svg "), 3U);
}

}  // namespace
}  // namespace isotach::reports
