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

  // `precision`: index in the list. What its assigners get.
  const view::LightArrays& in_precision(std::size_t precision) const;
  // What they would get without inflation.
  const view::PackedLights& packed(std::size_t precision) const { return lights_[precision].packed; }

 private:
  struct Lights {
    view::PackedLights packed;
    view::LightArrays inflated;  // only where it is asked for
    bool is_inflated;
  };

  std::vector<Lights> lights_;
};

}  // namespace clusterbench::run
