// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// What the TOML parser must not be shown: implementation.
#include "datasets/toml_precheck.hpp"

#include <algorithm>
#include <string>

namespace isotach::datasets {
namespace {

/// What a header may go on with behind its opening brackets, as far as the parser looks for itself: a bare
/// key, a quoted one, or the closing bracket that it refuses.
bool may_follow_brackets(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
         std::string_view("_-\"']").find(c) != std::string_view::npos;
}

/// Moves over a text line by line, with strings and brackets that span several taken as one.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::optional<TomlDefect> first_defect() {
    while (at_ < text_.size()) {
      skip_blanks();
      if (at_ < text_.size() && text_[at_] == '[') {
        ++at_;
        skip_blanks();
        if (at_ < text_.size() && text_[at_] == '[') ++at_;
        skip_blanks();
        if (at_ < text_.size() && !may_follow_brackets(text_[at_])) {
          return TomlDefect{line_, "a table header that begins with no key"};
        }
      }
      skip_expression();
      if (defect_) return defect_;
    }
    return std::nullopt;
  }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t", at_), text_.size()); }

  void advance(std::size_t count) {
    for (; count > 0 && at_ < text_.size(); --count) {
      if (text_[at_++] == '\n') ++line_;
    }
  }

  /// Up to and with the end of the line that is outside of strings and brackets.
  void skip_expression() {
    std::string open;    // brackets that wait for their own kind
    char last = '\n';    // that is not blank
    bool value = false;  // a value is what comes, not a key
    while (at_ < text_.size() && !defect_) {
      const char c = text_[at_];
      if (beyond_ascii()) {
        defect_ = TomlDefect{line_, "a character outside of ASCII that is not in quotes"};
        return;
      }
      if (c == '"' || c == '\'') {
        // the parser takes a quote behind anything else for a part of a word, and goes on in it
        if (std::string_view(value ? "\n=,[" : "\n=,[{.").find(last) == std::string_view::npos) {
          defect_ = TomlDefect{line_, "a quote inside of a word"};
          return;
        }
        skip_string(c);
        last = c;
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (c == '[' || c == '{') open += c == '[' ? ']' : '}';
      if ((c == ']' || c == '}') && !open.empty()) {
        if (open.back() != c) {
          defect_ = TomlDefect{line_, "a bracket closed by one of another kind"};
          return;
        }
        open.pop_back();
      }
      if (c == '=' || c == '[' || c == ']' || c == '}') value = true;
      if (c == '{' || (c == ',' && !open.empty() && open.back() == '}')) value = false;
      advance(1);
      if (c == '\n' && open.empty()) return;
      if (c != ' ' && c != '\t' && c != '\r') last = c;
    }
  }

  void skip_string(char quote) {
    const bool many = text_.substr(at_).starts_with(quote == '"' ? "\"\"\"" : "'''");
    const std::size_t length = many ? 3 : 1;
    const std::string_view close = text_.substr(at_, length);
    advance(length);
    while (at_ < text_.size()) {
      if (text_.substr(at_).starts_with(close)) {
        advance(length);
        // up to two quotes may stand before the three that close
        for (int i = 0; many && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) advance(1);
        return;
      }
      if (!many && text_[at_] == '\n') return;
      if (quote == '"' && text_[at_] == '\\') {
        skip_escape();
      } else {
        advance(1);
      }
    }
  }

  /// A backslash and what it escapes: an ASCII character; at the end of a line, all white space behind it.
  void skip_escape() {
    advance(1);
    const std::size_t next = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
    const bool ends_line = next != at_;
    advance(next - at_);
    if (beyond_ascii()) {
      defect_ = TomlDefect{line_, "a character outside of ASCII right behind a backslash"};
    } else if (!ends_line) {
      advance(1);
    }
  }

  [[nodiscard]] bool beyond_ascii() const {
    return at_ < text_.size() && static_cast<unsigned char>(text_[at_]) >= 0x80;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::optional<TomlDefect> defect_;
};

}  // namespace

std::optional<TomlDefect> find_toml_defect(std::string_view toml) {
  return Scanner(toml).first_defect();
}

}  // namespace isotach::datasets
