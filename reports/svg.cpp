// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// Rewriting of gnuplot's SVG as an XML tree.
#include "reports/svg.hpp"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace isotach::reports {
namespace {

constexpr const char* kFontFamily = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', sans-serif";

bool is(const pugi::xml_node& node, std::string_view name) {
  return name == node.name();
}

/// The id that an href such as "#gpPt6" points to.
std::string target_of(const pugi::xml_attribute& href) {
  const std::string_view value = href.value();
  return std::string(value.empty() ? value : value.substr(1));
}

/// Removes what draws nothing: groups without content and the name gnuplot makes up for an unnamed plot.
void remove_empty(pugi::xml_node node) {
  for (pugi::xml_node child = node.first_child(); child;) {
    const pugi::xml_node next = child.next_sibling();
    remove_empty(child);
    const std::string_view id = node.attribute("id").value();
    const bool made_up = is(child, "title") && !id.empty() && id == child.child_value();
    if (made_up || (is(child, "g") && !child.first_child())) node.remove_child(child);
    child = next;
  }
}

/// Removes definitions that nothing refers to, until all that are left are used.
void remove_unused_definitions(pugi::xml_node svg) {
  for (bool removed = true; removed;) {
    removed = false;
    std::set<std::string> used;
    for (const pugi::xpath_node& use : svg.select_nodes("//use[@xlink:href]")) {
      used.insert(target_of(use.node().attribute("xlink:href")));
    }
    for (const pugi::xpath_node& found : svg.select_nodes("//defs/*[@id]")) {
      pugi::xml_node definition = found.node();
      if (used.count(definition.attribute("id").value()) != 0) continue;
      definition.parent().remove_child(definition);
      removed = true;
    }
  }
}

/// Prefixes ids and the references to them, and takes the font from every element.
void rename(pugi::xml_node node, const std::string& prefix) {
  if (auto id = node.attribute("id")) id.set_value((prefix + id.value()).c_str());
  if (auto href = node.attribute("xlink:href")) {
    href.set_value(("#" + prefix + target_of(href)).c_str());
    href.set_name("href");
  }
  node.remove_attribute("font-family");
  for (pugi::xml_node child : node.children()) rename(child, prefix);
}

}  // namespace

std::string inline_svg(std::string_view document, std::string_view id_prefix, std::string_view title) {
  pugi::xml_document xml;
  const pugi::xml_parse_result parsed = xml.load_buffer(document.data(), document.size());
  pugi::xml_node svg = xml.child("svg");
  const std::string view_box = svg.attribute("viewBox").value();
  if (!parsed || view_box.empty()) {
    throw std::runtime_error(fmt::format("gnuplot wrote no SVG document: {}", parsed.description()));
  }
  svg.remove_child("title");
  svg.remove_child("desc");
  remove_unused_definitions(svg);
  remove_empty(svg);
  rename(svg, std::string(id_prefix));

  std::istringstream numbers(view_box);
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
  numbers >> x >> y >> width >> height;
  svg.remove_attributes();
  svg.append_attribute("viewBox") = view_box.c_str();
  // Width and height are the natural size; the style lets the element shrink with its column, in proportion.
  svg.append_attribute("width") = width;
  svg.append_attribute("height") = height;
  svg.append_attribute("style") = "max-width:100%;height:auto";
  svg.append_attribute("font-family") = kFontFamily;
  svg.append_attribute("role") = "img";
  if (!title.empty()) svg.append_attribute("aria-label") = std::string(title).c_str();

  std::ostringstream text;
  svg.print(text, "", pugi::format_raw | pugi::format_no_declaration);
  return text.str();
}

}  // namespace isotach::reports
