#include "report/results/measured_prices.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "gpu/reading/cost_fit.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::SetReading;
using result::WalkReading;

gpu::ReadingWork work_of(const SetReading& set) {
  const auto whole = [&](double per_sample) {
    return static_cast<std::uint64_t>(std::llround(per_sample * set.samples));
  };
  gpu::ReadingWork work;
  work.samples = whole(1.0);
  work.lights = whole(set.lights);
  work.reads = whole(set.reads);
  work.read_bytes = whole(set.read_bytes);
  work.divergence = set.divergence;
  return work;
}

std::vector<gpu::CostObservation> observations_of(const std::vector<Case>& cases) {
  std::vector<gpu::CostObservation> all;
  for (const Case& result_case : cases) {
    if (!result_case.reading) continue;
    for (const SetReading& set : result_case.reading->sets)
      for (const WalkReading& walk : set.walks)
        if (walk.walk == "lane" && set.lights > 0.0)
          all.push_back({walk.read_ns.median - set.nothing_ns.median, work_of(set)});
  }
  return all;
}

std::set<std::string> devices_of(const std::vector<Case>& cases) {
  std::set<std::string> devices;
  for (const Case& result_case : cases)
    if (result_case.reading) devices.insert(result_case.reading->device);
  return devices;
}

// "ns_per_read, read_gb_per_s"
std::string untold(const gpu::CostFit& fit) {
  std::vector<std::string> names;
  if (!fit.ns_per_light.is_determined()) names.emplace_back("ns_per_light");
  if (!fit.ns_per_read.is_determined()) names.emplace_back("ns_per_read");
  if (!fit.ns_per_byte.is_determined()) names.emplace_back("read_gb_per_s");
  return joined(names);
}

}  // namespace

std::string MeasuredPrices::text() const {
  return "cost by " + number_of(readings, "reading") + " on " + shown(device) +
         report::text(": a light %.3g ns", ns_per_light) + report::text(", a read %.3g ns", ns_per_read) +
         report::text(", %.4g GB/s", read_gb_per_s) + report::text(" (off by %.2g %% rms)", 100.0 * error_rms) +
         "; a light there is a small attenuation: if yours costs more, --set cost.ns_per_light says so";
}

MeasuredPrices measured_prices(const result::Result& result, const std::string& path) {
  constexpr double k_most_gb_per_s = 1e6;  // of the configuration's schema
  const std::string where = "--cost-from";
  const std::set<std::string> devices = devices_of(result.cases);
  if (devices.empty())
    throw Error(path, where, "has no readings; --set 'reading={}' makes `clusterbench run` measure them on a device");
  if (devices.size() > 1)
    throw Error(path, where,
                "has readings of " + std::to_string(devices.size()) + " devices (" +
                    joined(std::vector<std::string>(devices.begin(), devices.end())) + "); prices are those of one");
  if (std::ranges::any_of(result.cases, [](const Case& one) { return one.reading && one.reading->software; }))
    throw Error(path, where,
                "was read on " + *devices.begin() + ", which computes on the processor: its prices are no GPU's");
  const std::vector<gpu::CostObservation> observations = observations_of(result.cases);
  if (observations.empty()) throw Error(path, where, "has no readings with the walk `lane` that walk a light");
  const gpu::CostFit fit = gpu::fit_cost(observations);
  if (!fit.is_determined())
    throw Error(path, where,
                "its " + number_of(observations.size(), "reading") + " do not tell the prices apart" +
                    (untold(fit).empty() ? "" : " (" + untold(fit) + ")") +
                    "; read more structures (storages packed, bitfield, linked, runs), grids and scenes");
  return {fit.ns_per_light.value, fit.ns_per_read.value, std::min(fit.read_gb_per_s(), k_most_gb_per_s),
          *devices.begin(),       observations.size(),   fit.residual_rms};
}

}  // namespace clusterbench::report
