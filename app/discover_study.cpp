// Copyright Isotach contributors. SPDX-License-Identifier: BSD-3-Clause
#include "app/discover_study.hpp"

#include "app/interrupt.hpp"

namespace isotach::app {

tl::expected<reports::Discoveries, calibration::FitFailure> discover_study(
    const datasets::Study& study, const DiscoverStudyOptions& options) {
  reports::Discoveries found;
  const bool slumps = options.tests != TestsLookedAt::oedometer && fits_any(study.slump_tests);
  double begin = 0.0;
  const auto tell = [&](double fraction, const std::string& what) {
    constexpr double kOedometer = 0.1;  // of the work where there are slumps too
    const double share = !slumps ? 1.0 : begin > 0.0 ? 1.0 - begin : kOedometer;
    if (options.progress) options.progress(begin + share * fraction, what);
  };
  discovery::SlumpDiscoverOptions slump_options;
  if (fits_any(study.oedometer_tests)) {
    discovery::DiscoverOptions oedometer_options;
    oedometer_options.threads = options.threads;
    oedometer_options.control.stop = &interrupted();
    oedometer_options.progress = tell;
    auto oedometer = discovery::discover_oedometer(study, oedometer_options);
    if (!oedometer) return tl::unexpected(oedometer.error());
    const bool meets = oedometer->verdict == discovery::Verdict::adequate || oedometer->chosen.has_value();
    const calibration::OedometerFit& fit = oedometer->chosen
                                               ? oedometer->trials[*oedometer->chosen].candidate.fit
                                               : oedometer->base.candidate.fit;
    slump_options.knowledge = discovery::knowledge_of(fit);
    if (!meets) slump_options.knowledge->priors = {};
    if (options.tests != TestsLookedAt::slump) found.oedometer = std::move(*oedometer);
    begin = 0.1;
  }
  if (!slumps) return found;
  slump_options.threads = options.slump_threads;
  slump_options.control.stop = &interrupted();
  slump_options.simulate = options.simulate;
  slump_options.progress = tell;
  auto slump = discovery::discover_slump(study, slump_options);
  if (!slump) return tl::unexpected(slump.error());
  found.slump = std::move(*slump);
  return found;
}

}  // namespace isotach::app
