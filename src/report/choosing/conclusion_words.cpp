#include "report/choosing/conclusion_words.h"

#include <cmath>
#include <cstdint>

#include "core/text.h"
#include "measure/statistics/frame_cost.h"
#include "report/cases/case_costs.h"
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"

namespace clusterbench::report {

std::string case_title(const result::Case& result_case) {
  const std::string& name = result_case.name;
  return shown(name.substr(name.find('/', name.find('/') + 1) + 1));
}

std::string ns_text(double ns) {
  const double us = 1e-3 * ns;
  return text(us < 10.0 ? "%.2f us" : us < 1000.0 ? "%.3g us" : "%.0f us", us);
}

std::string bytes_text(double bytes) {
  return bytes < 1e3   ? text("%.0f B", bytes)
         : bytes < 1e6 ? text("%.3g kB", 1e-3 * bytes)
                       : text("%.3g MB", 1e-6 * bytes);
}

std::string less_or_more(double ratio) {
  return text("%.2g %% ", 100.0 * std::abs(ratio - 1.0)) + (ratio < 1.0 ? "less" : "more");
}

std::string more_text(double ratio, const measure::Interval& by_times, const measure::Interval& by_prices) {
  const bool is_share = ratio < 2.0;
  const auto amount = [&](double of) {
    const double percent = 100.0 * (of - 1.0);
    const bool is_near_alike = std::abs(of - measure::k_alike_ratio) < 5e-4;  // 5.04 % more is not within 5 %
    return !is_share ? text("%.3g", of)
                     : text(is_near_alike              ? "%.3g %%"
                            : std::abs(percent) < 99.5 ? "%.2g %%"
                                                       : "%.0f %%",
                            percent);
  };
  const auto range = [&](const measure::Interval& of) { return amount(of.low) + " to " + amount(of.high); };
  std::vector<std::string> ranges;
  if (by_times.is_known() && std::isfinite(by_times.high))
    ranges.push_back("95 % interval of the times: " + range(by_times));
  if (by_prices.is_known() && std::isfinite(by_prices.high))
    ranges.push_back("with the model's prices halved or doubled: " + range(by_prices) +
                     (by_prices.low < 1.0 ? ", so it may cost less on another GPU" : ""));
  return amount(ratio) + (is_share ? " more" : " times as much") +
         (ranges.empty() ? "" : " (" + joined(ranges, "; ") + ")");
}

std::string alike_title(bool is_modelled, bool is_timed) {
  if (!is_modelled) return is_timed ? "Not told apart by these times" : "The same by these figures";
  return std::string("About the same cost (within 5 %") + (is_timed ? ", or not told apart by these times)" : ")");
}

std::string samples_text(const std::vector<std::string>& sets) {
  return "Its samples" + (sets.empty() ? "" : " (" + result::words_of_sets(sets) + ")");
}

std::string few_samples_text(double needed, const std::vector<std::string>& sets) {
  if (needed >= k_least_needed_to_choose) return "";
  return ". " + samples_text(sets) + " need only " + number_of(static_cast<std::uint64_t>(needed), "light") +
         ", summed over all samples" +
         ": costs are rough, and a light that is lost can go unseen; more frames, or samples (samples.opaque.divisor, "
         "shading.samples), tell more";
}

std::string remedy_text(UnseenSurfaces why) {
  const auto why_text = [&]() -> std::string {
    switch (why) {
      case UnseenSurfaces::not_requested:
        return "where no surface is; --set 'samples.opaque={}' (levels with triangles) or samples.opaque.ground=lowest "
               "shades surfaces";
      case UnseenSurfaces::no_triangles:
        return "since the scene has no triangles; samples.opaque.ground=lowest shades a floor";
      case UnseenSurfaces::no_embree:
        return "since clusterbench was built without Embree, which sees surfaces; a build with it shades them";
    }
    return "";
  };
  return why_text() + ", and can change the choice";
}

}  // namespace clusterbench::report
