#include "view/selected_lights.h"

#include <algorithm>
#include <vector>

namespace clusterbench::view {
namespace {

// `first`: index of the array's first light.
void gather(const std::vector<float>& from, std::uint32_t first, std::span<const std::uint32_t> chosen,
            std::vector<float>& to) {
  to.resize(chosen.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) to[i] = from[chosen[i] - first];
}

}  // namespace

void select_lights(const LightArrays& all, std::span<const std::uint32_t> chosen, LightArrays& out) {
  const auto first_spot = std::ranges::lower_bound(chosen, all.spots.first);
  const auto points = static_cast<std::size_t>(first_spot - chosen.begin());
  static_cast<LightRanges&>(out) =
      LightRanges(static_cast<std::uint32_t>(points), static_cast<std::uint32_t>(chosen.size() - points));
  out.space = all.space;
  for (std::vector<float> LightArrays::*part :
       {&LightArrays::x, &LightArrays::y, &LightArrays::z, &LightArrays::radius, &LightArrays::reach})
    gather(all.*part, 0, chosen, out.*part);
  for (std::vector<float> LightArrays::*part : {&LightArrays::axis_x, &LightArrays::axis_y, &LightArrays::axis_z,
                                                &LightArrays::cos_angle, &LightArrays::sin_angle})
    gather(all.*part, all.spots.first, chosen.subspan(points), out.*part);
}

}  // namespace clusterbench::view
