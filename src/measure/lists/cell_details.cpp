#include "measure/lists/cell_details.h"

#include <algorithm>
#include <array>
#include <span>

namespace clusterbench::measure {
namespace {

void add_cell(FrameDetails& details, std::uint32_t cell, std::span<const std::uint32_t> truth,
              std::span<const std::uint32_t> reported) {
  std::array<std::uint32_t, 3> counts{};
  const auto add = [&](std::uint32_t light, PairMark mark) {
    details.pair_lights.push_back(light);
    details.pair_marks.push_back(static_cast<std::uint32_t>(mark));
    ++counts[static_cast<std::size_t>(mark)];
  };
  for (std::size_t t = 0, r = 0; t < truth.size() || r < reported.size();) {
    const bool is_reported = t == truth.size() || (r < reported.size() && reported[r] <= truth[t]);
    const bool is_true = r == reported.size() || (t < truth.size() && truth[t] <= reported[r]);
    const std::uint32_t light = is_reported ? reported[r] : truth[t];
    add(light, !is_true ? PairMark::false_positive : !is_reported ? PairMark::false_negative : PairMark::both);
    r += is_reported ? 1 : 0;
    t += is_true ? 1 : 0;
  }
  details.cells.push_back(cell);
  details.reported.push_back(static_cast<std::uint32_t>(reported.size()));
  details.truth.push_back(static_cast<std::uint32_t>(truth.size()));
  details.false_positives.push_back(counts[static_cast<std::size_t>(PairMark::false_positive)]);
  details.false_negatives.push_back(counts[static_cast<std::size_t>(PairMark::false_negative)]);
}

}  // namespace

FrameDetails find_details(const assign::Lists& truth, const assign::Lists& reported) {
  FrameDetails details;
  for (std::uint32_t cell = 0; cell < reported.cell_count(); ++cell)
    if (!truth.of(cell).empty() || !reported.of(cell).empty())
      add_cell(details, cell, truth.of(cell), reported.of(cell));
  details.lights = details.pair_lights;
  std::sort(details.lights.begin(), details.lights.end());
  details.lights.erase(std::unique(details.lights.begin(), details.lights.end()), details.lights.end());
  return details;
}

}  // namespace clusterbench::measure
