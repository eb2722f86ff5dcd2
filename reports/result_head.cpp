// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "reports/result_head.hpp"

#include "reports/json_number.hpp"

namespace isotach::reports {

nlohmann::ordered_json result_head(const RunInfo& run, std::string_view status,
                                   const std::vector<std::string>& warnings) {
  nlohmann::ordered_json json;
  json["command"] = run.command;
  json["version"] = run.version;
  json["status"] = status;
  json["seconds"] = json_number(run.seconds);
  json["input"] = input_name(run.input);
  json["warnings"] = run.warnings;
  for (const std::string& warning : warnings) json["warnings"].push_back(warning);
  return json;
}

}  // namespace isotach::reports
