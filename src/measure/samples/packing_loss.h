#pragma once
// Errors of packed lights, compared with the scene's own numbers.

#include <cstdint>

#include "view/packing.h"

namespace clusterbench::measure {

struct MeanMax {
  double mean = 0.0, max = 0.0;  // NaN without values
};

// Over all lights of all frames that have a finite range and that the format can hold.
struct PackingLoss {
  MeanMax position_error_m;
  MeanMax range_error_m;                    // by how much the range is too long
  MeanMax axis_error_rad, angle_error_rad;  // of spots
  MeanMax safe_inflation_m;                 // of the bound: the growth in all directions that would be sufficient
  // Lights that the format cannot hold: maximum of one frame, and number of frames with any.
  std::uint64_t unrepresentable_lights = 0;
  int unrepresentable_frames = 0;
};

class PackingLossMeter {
 public:
  // `packed`: the lights before they are inflated.
  void add_frame(const view::PackedLights& packed);
  PackingLoss result() const;

 private:
  struct Sum {
    double sum = 0.0, max = 0.0;
    std::uint64_t count = 0;

    void add(double value);
    MeanMax result() const;
  };

  void add_light(const view::PackedLights& packed, std::uint32_t light);
  void add_cone(const view::LightArrays& lights, std::uint32_t light);

  Sum position_, range_, axis_, angle_, inflation_;
  std::uint64_t unrepresentable_lights_ = 0;
  int unrepresentable_frames_ = 0;
};

}  // namespace clusterbench::measure
