// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// A report as one self-contained HTML page: a summary, then sections of text, tables and figures.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reports/figure.hpp"

namespace isotach::reports {

enum class Alignment { left, centre, right };

/// A table; all cells are plain text.
struct Table {
  std::string caption{};                         ///< above the table, numbered; may be empty
  std::vector<std::string> header{};             ///< repeated on every printed page
  std::vector<Alignment> alignment{};            ///< by column; those not named are left
  std::vector<std::vector<std::string>> rows{};  ///< each with as many cells as the header
  std::vector<std::string> notes{};              ///< below the table
  /// Colours behind cells, by row and column, where there are any; as many as rows and cells.
  std::vector<std::vector<std::optional<Rgb>>> shades{};
};

/// How a verdict or a box is meant; said by a sign and a colour.
enum class Tone { plain, good, warning, bad };

/// A picture that is SVG already: one `<svg>` element that scales with the page, without ids.
struct Drawing {
  std::string svg{};
  std::string caption{};  ///< below it on the page
};

/// Collects a report in reading order and writes it as HTML without scripts or anything outside of the page.
/// The same calls give the same bytes. All text is UTF-8, taken literally and escaped. What is added before
/// the first section() belongs to the summary, which has the first printed page to itself if sections follow.
class Page {
 public:
  /// What the report is about, and what was run on what (command, version, input).
  Page(std::string title, std::string subtitle);

  /// One line of the summary: a name and its value.
  void fact(std::string name, std::string value);
  /// One sentence of the summary that a reader in a hurry must see; verdicts stand before the facts.
  void verdict(Tone tone, std::string sentence);

  /// Starts a section; with more than three of them the summary ends with a list of contents.
  void section(std::string heading);
  /// A heading within the section.
  void heading(std::string text);
  void paragraph(std::string text);
  /// Throws std::invalid_argument where a row has not as many cells as the header, or the alignment has more,
  /// or shades are not those of the cells.
  void table(Table table);
  /// A figure across the page, numbered with all others in reading order.
  void figure(Figure figure);
  /// A drawing across the page, numbered with the figures.
  void drawing(Drawing drawing);
  /// Two figures side by side, made FigureWidth::half.
  void figures(Figure left, Figure right);
  /// Figures two by two; of an odd number the last one has a row for itself, as wide as the others.
  void figures(std::vector<Figure> figures);
  /// A note (Tone::plain) or a warning set apart from the text.
  void box(Tone tone, std::string text);
  /// Text with its line breaks and columns as they are.
  void preformatted(std::string text);

  /// The page. Throws what render_svgs throws.
  [[nodiscard]] std::string html() const;

 private:
  struct Paragraph {
    std::string text;
  };
  struct Heading {
    std::string text;
  };
  struct Box {
    Tone tone;
    std::string text;
  };
  struct Preformatted {
    std::string text;
  };
  struct FigureRow {
    std::size_t first;  // in pictures_
    std::size_t count;
    bool half = false;  // each as wide as half the page
  };
  using Block = std::variant<Heading, Paragraph, Table, FigureRow, Box, Preformatted>;
  struct Section {
    std::string heading;
    std::vector<Block> blocks;
  };
  struct Renderer;

  void add(Block block) { sections_.back().blocks.push_back(std::move(block)); }

  std::string title_;
  std::string subtitle_;
  std::vector<std::pair<std::string, std::string>> facts_;
  std::vector<std::pair<Tone, std::string>> verdicts_;
  std::vector<Section> sections_;                        // the first is the summary and has no heading
  std::vector<std::variant<Figure, Drawing>> pictures_;  // in reading order
};

}  // namespace isotach::reports
