// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/discover_study.hpp"

#include "app/interrupt.hpp"
#include "app/study_command.hpp"

namespace isotach::app {

tl::expected<reports::Discoveries, calibration::FitFailure> discover_study(
    const datasets::Study& study, const DiscoverStudyOptions& options) {
  reports::Discoveries found;
  const bool slumps = options.tests != TestsLookedAt::oedometer && fits_any(study.slump_tests);
  const bool oedometers = fits_any(study.oedometer_tests);
  constexpr double kOedometer = 0.1;  // of the work where there are slumps too
  const double turn = !slumps ? 1.0 : oedometers ? kOedometer : 0.0;  // from oedometer tests to slumps
  discovery::SlumpDiscoverOptions slump_options;
  if (oedometers) {
    discovery::DiscoverOptions oedometer_options;
    oedometer_options.threads = options.threads;
    oedometer_options.control.stop = &interrupted();
    oedometer_options.progress = [&](double fraction, const std::string& what) {
      if (options.progress) options.progress(turn * fraction, what);
    };
    auto oedometer = discovery::discover_oedometer(study, oedometer_options);
    if (!oedometer) return tl::unexpected(oedometer.error());
    const bool meets = oedometer->verdict == discovery::Verdict::adequate || oedometer->chosen.has_value();
    slump_options.knowledge = discovery::knowledge_of(oedometer->answer().candidate.fit);
    if (!meets) slump_options.knowledge->priors = {};
    if (options.tests != TestsLookedAt::slump) found.oedometer = std::move(*oedometer);
  }
  if (!slumps) return found;
  slump_options.threads = options.slump_threads;
  slump_options.control.stop = &interrupted();
  slump_options.simulate = options.simulate;
  slump_options.progress = [&](double fraction, const std::string& what) {
    if (options.progress) options.progress(turn + (1.0 - turn) * fraction, what);
  };
  auto slump = discovery::discover_slump(study, slump_options);
  if (!slump) return tl::unexpected(slump.error());
  found.slump = std::move(*slump);
  return found;
}

}  // namespace isotach::app
