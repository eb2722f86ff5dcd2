// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// An element test file: material, state and the order of the sections.
#include "datasets/element_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "datasets/effects_section.hpp"
#include "datasets/element_stages.hpp"
#include "datasets/study_sections.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {
namespace {

using Law = model::Law<double>;
using State = model::State<double>;
using Vector6 = model::Mandel<double>;

constexpr std::string_view kSixComponents = "six numbers: 11, 22, 33, 12, 13, 23";
constexpr Range kOverconsolidation = Range::positive(1e4);
constexpr double kRoundOff = 1e-12;     // at q = 3 p the lateral stress vanishes, and with it the law
constexpr double kLargestTrace = 1e-6;  // of omega, as digits cut off in a file leave it

/// Six tensor components of the key, negated: a Mandel vector with the law's sign.
std::optional<Vector6> components_if(TomlTable& table, std::string_view key) {
  const auto values = table.numbers_if(key, Range{}, kSixComponents);
  if (!values) return std::nullopt;
  if (values->size() != 6) throw table.error(key, fmt::format("{} numbers", values->size()), kSixComponents);
  Vector6 components;
  for (int i = 0; i < 6; ++i) components[i] = -(*values)[static_cast<std::size_t>(i)];
  return model::mandel_from_components<double>(components);
}

void check_stress(TomlTable& table, const Vector6& stress) {
  const double p = -model::trace<double, 6>(stress) / 3.0;
  const double q = std::sqrt(1.5) * model::deviator<double, 6>(stress).norm();
  if (!(p > 0.0)) {
    throw table.error("stress_kPa", fmt::format("mean stress p = {:.6g}", 1e-3 * p),
                      "p > 0 (compression positive)");
  }
  if (!(q < 3.0 * p * (1.0 - kRoundOff))) {
    throw table.error("stress_kPa", fmt::format("q = {:.6g} at p = {:.6g}", 1e-3 * q, 1e-3 * p), "q < 3 p");
  }
}

Vector6 read_omega(TomlTable& table, const Law& law, const Vector6& stress) {
  const auto omega = components_if(table, "omega");
  if (!omega) return Vector6::Zero();
  const double trace = model::trace<double, 6>(*omega);
  if (!(std::abs(trace) <= kLargestTrace)) {
    throw table.error("omega", fmt::format("trace {:.6g}", -trace),
                      "a deviatoric tensor: 11 + 22 + 33 = 0, to within 1e-6");
  }
  const Vector6 deviatoric = model::deviator<double, 6>(*omega);
  const double M = law.measures(stress).F * law.critical_ratio();
  if (!(1.5 * deviatoric.squaredNorm() < M * M)) {
    throw table.error("omega", fmt::format("(3/2) omega:omega = {:.6g}", 1.5 * deviatoric.squaredNorm()),
                      fmt::format("less than M^2, which is {:.6g} at this stress", M * M));
  }
  return deviatoric;
}

State read_state(TomlTable table, const Law& law) {
  State state{};
  const auto stress = components_if(table, "stress_kPa");
  if (!stress) throw table.error("stress_kPa", "it is missing", kSixComponents);
  state.stress = 1e3 * *stress;
  check_stress(table, state.stress);
  state.omega = read_omega(table, law, state.stress);

  const auto void_ratio = table.number_if("void_ratio", kVoidRatio);
  const auto ocr = table.number_if("ocr", kOverconsolidation);
  if (void_ratio.has_value() == ocr.has_value()) {
    throw table.error(ocr ? "ocr" : "void_ratio", ocr ? "given together with void_ratio" : "it is missing",
                      "either void_ratio or ocr");
  }
  table.reject_unknown_keys();
  if (void_ratio) {
    state.void_ratio = *void_ratio;
  } else {
    state.void_ratio = law.void_ratio_at(*ocr * law.measures(state).equivalent_pressure);
    if (!kVoidRatio.contains(state.void_ratio)) {
      throw table.error("ocr", fmt::format("{} makes the void ratio {:.6g}", *ocr, state.void_ratio),
                        fmt::format("an ocr whose void ratio is {}", kVoidRatio.words()));
    }
  }
  return state;
}

}  // namespace

ElementFile read_element_file(const std::filesystem::path& file, const ReadOptions& options) {
  const TomlDocument document = TomlDocument::read(file, options);
  TomlTable root = document.root();
  for (const std::string_view key : {"note", "material", "state", "stage"}) static_cast<void>(root.has(key));
  refuse_effects(root);
  root.reject_unknown_keys();

  std::optional<std::string> note;
  if (root.has("note")) note = root.text("note");
  auto material = read_material(root.table("material"));
  const State start = read_state(root.table("state"), Law(material));
  auto stages = read_element_stages(root);
  return {file, std::move(note), std::move(material), start, std::move(stages)};
}

}  // namespace isotach::datasets
