#pragma once
// Samples look up the light structure, and the returned lights are compared with the lights that reach the samples. The
// counts are comparable between grids and methods.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assign/contract/light_structure.h"
#include "grid/grid.h"
#include "measure/samples/samples.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {

// If a larger share of the needed lights is missed, lists are not comparable: rounding at cell boundaries misses far
// fewer.
inline constexpr double k_most_unlit = 1e-3;
// With fewer needed lights, overshade is not reported.
inline constexpr std::uint64_t k_least_needed = 100;

struct ShadingCounts {
  std::uint64_t samples = 0;
  std::uint64_t evaluated = 0;       // lights that the structure returns at the samples
  std::uint64_t needed = 0;          // lights that reach the samples
  std::uint64_t missed = 0;          // of those, not returned, for any reason
  std::uint64_t unanswered = 0;      // samples outside of the structure's cells, which have no list
  std::uint64_t missed_outside = 0;  // of the missed, at those samples
  assign::Reads reads{};             // fetches of shaders from the structure to find these lights
  // Sums over the samples of the illuminance of all needed lights and of the missed ones. Photometric, in lux on a
  // surface that faces the light: intensity times luminance of the colour, attenuated as in KHR_lights_punctual with
  // the range's window and a spot's falloff.
  double lost_lux = 0.0, total_lux = 0.0;

  // The frame with most missed lights; none if no light is missed.
  struct WorstFrame {
    int frame = 0;
    std::uint64_t missed = 0, needed = 0;

    friend bool operator==(const WorstFrame&, const WorstFrame&) = default;
  };
  std::optional<WorstFrame> worst{};
  WorstFrame now{-1};  // the current frame
  // The sample that loses most illuminance.
  struct DarkestSample {
    int frame = 0;
    float pixel_x = 0.0f, pixel_y = 0.0f;
    double lost_lux = 0.0;
  };
  std::optional<DarkestSample> darkest{};

  double lost_irradiance() const;  // share of the illuminance that is lost, 0 if there is none

  double overshade() const;  // evaluated / needed; NaN if no light is needed
  // NaN also if it is not comparable: few lights are needed, or some are missed, which makes the ratio too small.
  double comparable_overshade() const;
  double unlit() const;         // missed / needed; NaN if no light is needed
  double unlit_inside() const;  // the same without missed_outside
};

// The lights that reach each of the frame's samples, exactly (double-precision distance, equality counts as reached),
// in CSR format like lists.
assign::Lists lights_reaching(const view::Frame& frame, std::span<const grid::Sample> samples);

// The same with the illuminance of each light: one value per entry of the lists, in their order.
struct NeededLights {
  assign::Lists lists;
  std::vector<double> lux;
};
NeededLights needed_lights(const view::Frame& frame, std::span<const grid::Sample> samples);

// Adds samples of a frame, all at once or part by part.
void add_samples(ShadingCounts& counts, int frame, std::span<const grid::Sample> samples, const NeededLights& needed,
                 const assign::LightStructure& structure);

}  // namespace clusterbench::measure
