// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
// The data file that an [[oedometer]] table names, in whichever format it is.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "datasets/oedometer.hpp"
#include "datasets/specimen.hpp"
#include "datasets/toml_table.hpp"

namespace isotach::datasets {

/// Formats of oedometer data.
enum class DataFormat {
  csv,  ///< one test, as this project's own files
  bro,  ///< columns of the Dutch subsurface registry, several tests
  ags4  ///< CONG and CONS groups of an AGS4 file, several tests
};

/// Which data a study asks for, and how they are to be read.
struct DataRequest {
  std::filesystem::path file;
  std::optional<DataFormat> format;  ///< nothing: by the file's suffix and header
  Selection select;                  ///< where a file holds several tests
  std::optional<Control> protocol;   ///< as stated; nothing: what the format is for, strain for csv
  OedometerReading reading;
  SpecimenData specimen{};  ///< as the study states it
};

/// Reads data, format, select, protocol, stress and pore_pressure of an [[oedometer]] table.
[[nodiscard]] DataRequest read_data_request(TomlTable& test);

/// A file's record, and its specimen: as the study states it, else as the file does.
struct OedometerData {
  OedometerRecord record;
  SpecimenData specimen;
  bool ends_of_steps_only = false;  ///< one reading a load step, at its end
};

/// Works out the initial void ratio of the specimen, by which strains are reckoned where a file has void
/// ratios. Called exactly once.
using VoidRatioOf = std::function<double(const SpecimenData&)>;

/// Reads the data out of `text`. `test` is the [[oedometer]] table, for messages about its keys.
/// InputError: whatever the reader of the format refuses, a test that is not selected or selected wrongly, a
/// key that has no meaning for the format, no height where the format needs one.
[[nodiscard]] OedometerData read_oedometer_data(const TomlTable& test, const DataRequest& request,
                                                std::string text, const VoidRatioOf& void_ratio_of);

}  // namespace isotach::datasets
