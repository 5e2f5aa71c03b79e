#include "report/choosing/device_conclusion.h"

#include <algorithm>

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

// The first that is slower than the fastest for certain: their intervals do not overlap.
const WeighedCase* slower_of(const std::vector<WeighedCase>& timed) {
  const double high = result::Pair(interval_of(timed.front()))[1];
  for (const WeighedCase& weighed : timed)
    if (result::Pair(interval_of(weighed))[0] > high) return &weighed;
  return nullptr;
}

std::string fastest_text(const std::vector<WeighedCase>& timed) {
  const WeighedCase& fastest = timed.front();
  std::string out = case_title(*fastest.result_case) + " makes its lists fastest, in " + ns_text(fastest.device_ns()) +
                    " by its clock";
  if (const auto ratio = figure_of(*fastest.result_case, "device_floor"))
    out += text(", %.1f times what as many steps take that only write as much", *ratio);
  if (const WeighedCase* slower = slower_of(timed))
    return out + "; " + case_title(*slower->result_case) + " takes " +
           text("%.2f times as long", slower->device_ns() / fastest.device_ns());
  return out + (timed.size() > 1 ? "; the others are not known to be slower" : "");
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
