// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Filling of the page template.
#include "reports/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <kainjow/mustache.hpp>
#include <stdexcept>

#include "reports/page_template.hpp"

namespace isotach::reports {
namespace {

namespace mustache = kainjow::mustache;
using mustache::data;

constexpr std::size_t kSectionsWithoutContents = 3;
constexpr std::size_t kShortTable = 15;  // rows that printing keeps on one page

/// The class that the template's style sheet colours.
std::string class_of(Tone tone) {
  switch (tone) {
    case Tone::plain:
      return "plain";
    case Tone::good:
      return "good";
    case Tone::warning:
      return "warning";
    case Tone::bad:
      return "bad";
  }
  return {};
}

/// The sign that says the tone without colour.
std::string sign_of(Tone tone) {
  switch (tone) {
    case Tone::plain:
      return "•";
    case Tone::good:
      return "✓";
    case Tone::warning:
      return "!";
    case Tone::bad:
      return "✕";
  }
  return {};
}

std::string class_of(Alignment alignment) {
  switch (alignment) {
    case Alignment::left:
      return "left";
    case Alignment::centre:
      return "centre";
    case Alignment::right:
      return "right";
  }
  return {};
}

/// A list with one {{text}} per item.
data list_of(const std::vector<std::string>& texts) {
  data list{data::type::list};
  for (const std::string& text : texts) list.push_back(data{"text", text});
  return list;
}

/// A value for a mustache section that vanishes where the text is empty.
data unless_empty(const std::string& text) {
  return text.empty() ? data{false} : data{text};
}

/// Cells with their column's alignment, and what is behind them, if anything.
data cells_of(const std::vector<std::string>& texts, const std::vector<Alignment>& alignment,
              const std::vector<std::optional<Rgb>>& shades = {}) {
  data cells{data::type::list};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    data cell;
    cell.set("text", texts[i]);
    cell.set("class", class_of(i < alignment.size() ? alignment[i] : Alignment::left));
    cell.set("shade", data{false});
    if (i < shades.size() && shades[i]) {
      cell.set("shade",
               fmt::format("#{:02x}{:02x}{:02x}", shades[i]->red, shades[i]->green, shades[i]->blue));
    }
    cells.push_back(cell);
  }
  return cells;
}

/// The pictures in the same order, those that are figures drawn, in one run of gnuplot.
std::vector<Drawing> drawn(const std::vector<std::variant<Figure, Drawing>>& pictures) {
  std::vector<Figure> figures;
  for (const auto& picture : pictures) {
    if (const auto* figure = std::get_if<Figure>(&picture)) figures.push_back(*figure);
  }
  std::vector<std::string> svgs = render_svgs(figures);
  std::vector<Drawing> drawings;
  std::size_t next = 0;
  for (const auto& picture : pictures) {
    if (const auto* figure = std::get_if<Figure>(&picture)) {
      drawings.push_back({std::move(svgs[next++]), figure->caption});
    } else {
      drawings.push_back(std::get<Drawing>(picture));
    }
  }
  return drawings;
}

}  // namespace

/// Turns blocks into what the template expects, numbering tables and figures on the way.
struct Page::Renderer {
  std::vector<Drawing> pictures;
  int tables = 0;

  data operator()(const Heading& block) const {
    data content;
    content.set("text", block.text);
    return wrapped("heading", content);
  }

  data operator()(const Paragraph& block) const {
    data content;
    content.set("text", block.text);
    return wrapped("paragraph", content);
  }

  data operator()(const Table& table) {
    data content;
    content.set("caption", unless_empty(table.caption));
    content.set("number", table.caption.empty() ? std::string() : fmt::format("{}", ++tables));
    content.set("header", cells_of(table.header, table.alignment));
    data rows{data::type::list};
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const auto shades = table.shades.empty() ? std::vector<std::optional<Rgb>>{} : table.shades[i];
      rows.push_back(data{"cells", cells_of(table.rows[i], table.alignment, shades)});
    }
    content.set("rows", rows);
    content.set("notes", list_of(table.notes));
    content.set("short", data{table.rows.size() <= kShortTable});
    return wrapped("table", content);
  }

  data operator()(const FigureRow& row) const {
    data items{data::type::list};
    for (std::size_t i = row.first; i < row.first + row.count; ++i) {
      data item;
      item.set("number", fmt::format("{}", i + 1));
      item.set("svg", pictures[i].svg);
      item.set("caption", pictures[i].caption);
      items.push_back(item);
    }
    data content;
    content.set("class", std::string(row.half ? "pair" : "single"));
    content.set("items", items);
    return wrapped("figures", content);
  }

  data operator()(const Box& box) const {
    data content;
    content.set("class", class_of(box.tone));
    content.set("sign", sign_of(box.tone));
    content.set("text", box.text);
    return wrapped("box", content);
  }

  data operator()(const Preformatted& block) const {
    data content;
    content.set("text", block.text);
    return wrapped("preformatted", content);
  }

  /// The block under the name of its kind, the other kinds being absent.
  static data wrapped(const char* kind, const data& content) {
    data block;
    for (const char* name : {"heading", "paragraph", "table", "figures", "box", "preformatted"})
      block.set(name, data{false});
    block.set(kind, content);
    return block;
  }

  data blocks_of(const Section& section) {
    data blocks{data::type::list};
    for (const Block& block : section.blocks) blocks.push_back(std::visit(*this, block));
    return blocks;
  }
};

Page::Page(std::string title, std::string subtitle)
    : title_(std::move(title)), subtitle_(std::move(subtitle)), sections_(1) {}

void Page::fact(std::string name, std::string value) {
  facts_.emplace_back(std::move(name), std::move(value));
}

void Page::verdict(Tone tone, std::string sentence) {
  verdicts_.emplace_back(tone, std::move(sentence));
}

void Page::section(std::string heading) {
  sections_.push_back({std::move(heading), {}});
}

void Page::heading(std::string text) {
  add(Heading{std::move(text)});
}

void Page::paragraph(std::string text) {
  add(Paragraph{std::move(text)});
}

void Page::table(Table table) {
  for (const std::vector<std::string>& row : table.rows) {
    if (row.size() != table.header.size()) {
      throw std::invalid_argument(fmt::format("table '{}': a row has {} cells, the header {}", table.caption,
                                              row.size(), table.header.size()));
    }
  }
  if (table.alignment.size() > table.header.size()) {
    throw std::invalid_argument(fmt::format("table '{}': more alignments than columns", table.caption));
  }
  const auto shades_fit = [&] {
    if (table.shades.empty()) return true;
    if (table.shades.size() != table.rows.size()) return false;
    return std::all_of(table.shades.begin(), table.shades.end(),
                       [&](const auto& row) { return row.size() == table.header.size(); });
  };
  if (!shades_fit()) {
    throw std::invalid_argument(fmt::format("table '{}': shades are not those of its cells", table.caption));
  }
  add(std::move(table));
}

void Page::figure(Figure figure) {
  pictures_.push_back(std::move(figure));
  add(FigureRow{pictures_.size() - 1, 1});
}

void Page::drawing(Drawing drawing) {
  pictures_.push_back(std::move(drawing));
  add(FigureRow{pictures_.size() - 1, 1});
}

void Page::figures(Figure left, Figure right) {
  left.width = right.width = FigureWidth::half;
  pictures_.push_back(std::move(left));
  pictures_.push_back(std::move(right));
  add(FigureRow{pictures_.size() - 2, 2, true});
}

void Page::figures(std::vector<Figure> figures) {
  for (std::size_t i = 0; i < figures.size(); i += 2) {
    const std::size_t count = std::min<std::size_t>(2, figures.size() - i);
    for (std::size_t k = i; k < i + count; ++k) {
      figures[k].width = FigureWidth::half;
      pictures_.push_back(std::move(figures[k]));
    }
    add(FigureRow{pictures_.size() - count, count, true});
  }
}

void Page::box(Tone tone, std::string text) {
  add(Box{tone, std::move(text)});
}

void Page::preformatted(std::string text) {
  add(Preformatted{std::move(text)});
}

std::string Page::html() const {
  Renderer renderer{drawn(pictures_)};
  data page;
  page.set("title", title_);
  page.set("subtitle", unless_empty(subtitle_));
  data verdicts{data::type::list};
  for (const auto& [tone, sentence] : verdicts_) {
    data verdict;
    verdict.set("class", class_of(tone));
    verdict.set("sign", sign_of(tone));
    verdict.set("text", sentence);
    verdicts.push_back(verdict);
  }
  page.set("verdicts", verdicts);
  page.set("has_verdicts", data{!verdicts_.empty()});
  data facts{data::type::list};
  for (const auto& [name, value] : facts_) {
    data fact;
    fact.set("name", name);
    fact.set("value", value);
    facts.push_back(fact);
  }
  page.set("facts", facts);
  page.set("has_facts", data{!facts_.empty()});
  page.set("summary_blocks", renderer.blocks_of(sections_.front()));
  data sections{data::type::list};
  for (std::size_t i = 1; i < sections_.size(); ++i) {
    data section;
    section.set("anchor", fmt::format("section-{}", i));
    section.set("heading", sections_[i].heading);
    section.set("blocks", renderer.blocks_of(sections_[i]));
    sections.push_back(section);
  }
  page.set("sections", sections);
  const std::size_t count = sections_.size() - 1;
  page.set("has_sections", data{count > 0});
  page.set("has_contents", data{count > kSectionsWithoutContents});

  mustache::mustache html{kPageTemplate};
  mustache::mustache blocks{kBlocksTemplate};
  if (!html.is_valid() || !blocks.is_valid()) {
    throw std::logic_error("report template: " + html.error_message() + blocks.error_message());
  }
  page.set("block_list", data{mustache::partial{[] { return std::string(kBlocksTemplate); }}});
  return html.render(page);
}

}  // namespace isotach::reports
