#include "report/cases/contender.h"

#include <algorithm>
#include <cmath>

#include "assign/contract/assigner.h"
#include "report/cases/columns.h"
#include "result/at.h"
#include "result/figures/case_figure.h"
#include "run/cases/case_names.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::Cost;

std::string view_of(const Case& result_case) {
  return result_case.camera + ", " + viewport_text(result_case.viewport) + machine_part(result_case);
}

measure::Costs costs_of(const Case& result_case, RankBy by) {
  measure::Costs costs;
  if (result_case.timing) {
    const auto [low, high] = result::Pair(result_case.timing->frame_ns.ci95);
    if (std::isfinite(low) && std::isfinite(high)) costs.time_ns = {low, high};
  }
  // Drawn lights have no lists, so their size is no advantage.
  if (!draws_lights(result_case)) costs.bytes = static_cast<double>(result_case.buffers.bytes.high_water);
  if (by == RankBy::frame_time) {
    costs.overshade = figure_of(result_case, "overshade").value_or(costs.k_unknown);
    return costs;
  }
  const double gpu_ns = result::number<&Case::cost, &Cost::gpu_ns>(result_case).value_or(costs.k_unknown);
  if (!result_case.timing) costs.time_ns = {0.0, 0.0};
  costs.time_ns.low += gpu_ns;
  costs.time_ns.high += gpu_ns;
  costs.overshade = 0.0;  // equal, so that it does not count
  return costs;
}

}  // namespace

bool loses_nothing_seen(const Case& result_case) {
  return result_case.eligible && (!result_case.cost || result_case.cost->lit);
}

int slowness_of(const Case& result_case) {
  return assign::slowness_of(result_case.assigner.name);
}

bool draws_lights(const Case& result_case) {
  const assign::AssignerDescriptor* assigner = assign::find_assigner(result_case.assigner.name);
  return assigner != nullptr && assigner->draws_lights;
}

bool samples_search(const Case& result_case) {
  if (result_case.storage != run::k_own_structure) return false;
  const assign::AssignerDescriptor* assigner = assign::find_assigner(result_case.assigner.name);
  return assigner == nullptr ? result_case.samples_search.value_or(false) : assigner->own_is_searched();
}

bool runs_on_device(const Case& result_case) {
  return result_case.assigner.on_device.value_or(false);
}

bool is_on_software_device(const result::Result& result, const Case& result_case) {
  if (!runs_on_device(result_case)) return false;
  const bool runs_software = result.device && result.device->type == "software";
  return result_case.device ? result_case.device->software.value_or(runs_software) : runs_software;
}

bool is_at_surfaces(const std::string& assigner) {
  const assign::AssignerDescriptor* method = assign::find_assigner(assigner);
  return method != nullptr && method->at_surfaces;
}

std::string at_surfaces_text(const std::string& assigner) {
  return is_at_surfaces(assigner)
             ? "lights visible opaque surfaces alone: transparent ones, particles and fog need lists of their own"
             : "";
}

std::vector<double> frame_rounds(const Case& result_case) {
  if (!result_case.timing) return {};
  const std::vector<double>& samples = result_case.timing->frame_ns.samples;
  return std::ranges::all_of(samples, [](double ns) { return std::isfinite(ns); }) ? samples : std::vector<double>();
}

std::uint64_t seed_of(const result::Result& result) {
  const result::Json seed = result.config.value("seed", result::Json());
  return seed.is_number_unsigned() ? seed.get<std::uint64_t>() : 1;
}

RankBy rank_by(const result::Result& result) {
  return result.config.value("rank_by", "") == "frame_cost" ? RankBy::frame_cost : RankBy::frame_time;
}

run::Contender contender_of(const Case& result_case, RankBy by) {
  run::Contender out{result_case.id,
                     result_case.scene,
                     view_of(result_case),
                     costs_of(result_case, by),
                     loses_nothing_seen(result_case) && !samples_search(result_case) && !runs_on_device(result_case),
                     block_of(result_case),
                     {},
                     {},
                     1,
                     false};
  const std::optional<double> frame_ns = result::number<&Case::cost, &Cost::frame_ns>(result_case),
                              gpu_ns = result::number<&Case::cost, &Cost::gpu_ns>(result_case);
  if (by == RankBy::frame_cost) out.is_eligible = out.is_eligible && (result_case.timing ? frame_ns : gpu_ns);
  if (!result_case.timing) {
    out.costs.slowness = slowness_of(result_case);
    return out;
  }
  out.rounds_ns = frame_rounds(result_case);
  if (by == RankBy::frame_cost)
    for (double& ns : out.rounds_ns) ns += gpu_ns.value_or(0.0);
  out.session = result_case.timing->session.value_or("");
  out.launches = static_cast<int>(result_case.timing->launches.value_or(1));
  out.is_cold = result_case.timing->caches == "cold";
  return out;
}

}  // namespace clusterbench::report
