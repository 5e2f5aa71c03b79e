#pragma once
// What lights lose when they are packed, against the scene's own numbers.

#include <cstdint>

#include "view/packing.h"

namespace clusterbench::measure {

struct MeanMax {
  double mean = 0.0, max = 0.0;  // not a number: over nothing
};

// Over all lights of all frames that end somewhere and that the format holds.
struct PackingLoss {
  MeanMax position_error_m;
  MeanMax range_error_m;                    // by how much it is too long
  MeanMax axis_error_rad, angle_error_rad;  // of spots
  MeanMax safe_inflation_m;                 // of the bound: by how much growing in all directions would be enough
  // Lights that the format does not hold: the most in one frame, and in how many frames there is one.
  std::uint64_t unrepresentable_lights = 0;
  int unrepresentable_frames = 0;
};

class PackingLossMeter {
 public:
  // The lights before they are inflated.
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
