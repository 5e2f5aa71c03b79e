#include "run/cases/frame_lights.h"

namespace clusterbench::run {

FrameLights::FrameLights(const std::vector<config::PrecisionRequest>& precisions, const view::LightArrays& lights) {
  for (const config::PrecisionRequest& precision : precisions) {
    Lights& now = lights_.emplace_back(Lights{view::packed(lights, precision.packing), {}, precision.inflate});
    if (now.is_inflated) now.inflated = view::inflated(now.packed);
  }
}

const view::LightArrays& FrameLights::in_precision(std::size_t precision) const {
  const Lights& now = lights_[precision];
  return now.is_inflated ? now.inflated : now.packed.lights;
}

}  // namespace clusterbench::run
