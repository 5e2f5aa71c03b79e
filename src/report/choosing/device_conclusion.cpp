#include "report/choosing/device_conclusion.h"

#include <algorithm>
#include <span>

#include "core/text.h"
#include "report/cases/columns.h"
#include "report/choosing/conclusion_words.h"
#include "result/at.h"

namespace clusterbench::report {
namespace {

using result::Case;
using result::DeviceTimes;

const result::Interval& interval_of(const WeighedCase& weighed) {
  return weighed.result_case->device->run_ns.ci95;
}

// Slower than the fastest for certain: their intervals do not overlap.
bool is_slower(const WeighedCase& weighed, const WeighedCase& fastest) {
  return result::Pair(interval_of(weighed))[0] > result::Pair(interval_of(fastest))[1];
}

std::string alike_text(const std::vector<std::string>& alike) {
  constexpr std::size_t k_most = 3;
  if (alike.size() == 1) return alike.front() + " is";
  if (alike.size() <= k_most) return joined(alike) + " are";
  return joined(std::span(alike).first(2)) + " and " + std::to_string(alike.size() - 2) + " more are";
}

std::string fastest_text(const std::vector<WeighedCase>& timed) {
  const WeighedCase& fastest = timed.front();
  std::string out = case_title(*fastest.result_case) + " makes its lists fastest, in " + ns_text(fastest.device_ns()) +
                    " by its clock";
  if (const auto ratio = figure_of(*fastest.result_case, "device_floor"))
    out += text(", %.1f times what as many steps take that do nothing but write as many bytes", *ratio);
  const WeighedCase* slower = nullptr;  // the first for certain
  std::vector<std::string> alike;
  for (const WeighedCase& weighed : std::span(timed).subspan(1)) {
    if (!is_slower(weighed, fastest)) alike.push_back(case_title(*weighed.result_case));
    if (slower == nullptr && is_slower(weighed, fastest)) slower = &weighed;
  }
  if (!alike.empty()) out += "; " + alike_text(alike) + " not known to be slower";
  if (slower != nullptr)
    out += "; " + case_title(*slower->result_case) + " takes " +
           text("%.2f times as long", slower->device_ns() / fastest.device_ns());
  return out;
}

}  // namespace

std::string device_text(const SceneView& view, const std::optional<result::Device>& device) {
  if (view.on_device.empty() || !device) return "";
  std::vector<std::vector<WeighedCase>> grids;  // lists of one grid compare; those of visible surfaces alone do not
  bool is_timed = false;
  for (const WeighedCase& weighed : view.on_device) {
    if (!weighed.result_case->device) continue;
    is_timed = true;
    if (is_at_surfaces(weighed.method())) continue;
    const auto same = std::ranges::find_if(grids, [&](const std::vector<WeighedCase>& grid) {
      return grid.front().result_case->grid.name == weighed.result_case->grid.name;
    });
    (same == grids.end() ? grids.emplace_back() : *same).push_back(weighed);
  }
  const std::string on = " On " + shown(device->name) + ": ";
  if (!is_timed) return on + "nothing was timed.";
  if (device->type == "software")
    return on + "its times rank nothing: they are those of a driver that computes on the processor, and no GPU's.";
  std::string out;
  for (const std::vector<WeighedCase>& grid : grids) out += (out.empty() ? on : "; ") + fastest_text(grid);
  return out.empty() ? "" : out + ". Times of a device and of the processor are not compared.";
}

}  // namespace clusterbench::report
