// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "journal/evaluation.hpp"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <string_view>
#include <vector>

#include "journal/exact_json.hpp"
#include "mpm/setup_fields.hpp"

namespace isotach::journal {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(double value) {
  return exact_json(value);
}
ordered_json json_of(int value) {
  return value;
}
ordered_json json_of(bool value) {
  return value;
}
ordered_json json_of(const std::optional<double>& value) {
  return value ? exact_json(*value) : ordered_json(nullptr);
}
ordered_json json_of(const mpm::RimPlace& place) {
  return ordered_json::array({exact_json(place.time), exact_json(place.height)});
}
template <class T>
ordered_json json_of(const std::vector<T>& values) {
  ordered_json list = ordered_json::array();
  for (const T& value : values) list.push_back(json_of(value));
  return list;
}

std::string text_of(const model::Parameters<double>& parameters) {
  ordered_json json = ordered_json::object();
  for (const model::ParameterInfo& info : model::kParameterTable) {
    json[std::string(info.name)] = exact_json(parameters[info.id]);
  }
  json["lode_dependence"] =
      parameters.lode() == model::LodeDependence::matsuoka_nakai ? "matsuoka-nakai" : "none";
  return json.dump();
}

std::string text_of(const mpm::SlumpSetup& setup) {
  ordered_json json = ordered_json::object();
  mpm::visit_fields(
      setup, [&](std::string_view name, const auto& value) { json[std::string(name)] = json_of(value); });
  return json.dump();
}

std::string uuid_of(const std::string& text) {
  // any name space would do; the one for URLs is known to every library of UUIDs
  return boost::uuids::to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::url())(text));
}

}  // namespace

Inputs::Inputs(const model::Parameters<double>& material, const mpm::SlumpSetup& slump,
               std::string code_version)
    : parameters(text_of(material)),
      setup(text_of(slump)),
      version(std::move(code_version)),
      setup_key(uuid_of(version + '\n' + setup)),
      key(uuid_of(version + '\n' + parameters + '\n' + setup)) {}

}  // namespace isotach::journal
