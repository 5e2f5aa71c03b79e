#pragma once
// A frame's lights in each precision of the configuration.

#include <vector>

#include "config/config.h"
#include "view/packing.h"

namespace clusterbench::run {

class FrameLights {
 public:
  FrameLights() = default;
  FrameLights(const std::vector<config::PrecisionRequest>& precisions, const view::LightArrays& lights);

  // The lights that assigners of this precision get. `precision`: index in the configuration's list.
  const view::LightArrays& in_precision(std::size_t precision) const;
  // The same lights without inflation.
  const view::PackedLights& packed(std::size_t precision) const { return lights_[precision].packed; }

 private:
  struct Lights {
    view::PackedLights packed;
    view::LightArrays inflated;  // only if requested
    bool is_inflated;
  };

  std::vector<Lights> lights_;
};

}  // namespace clusterbench::run
