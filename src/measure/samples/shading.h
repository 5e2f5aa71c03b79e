#pragma once
// Samples ask the light structure, and what it gives is compared with the lights that reach them: comparable between
// grids and methods.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assign/contract/light_structure.h"
#include "grid/grid.h"
#include "measure/samples/samples.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {

// Lists that lack more of the lights that are needed at the samples are no lists to compare with: rounding at cell
// boundaries misses far fewer.
inline constexpr double k_most_unlit = 1e-3;
// Of fewer lights that samples need nothing is said.
inline constexpr std::uint64_t k_least_needed = 100;

struct ShadingCounts {
  std::uint64_t samples = 0;
  std::uint64_t evaluated = 0;       // lights that the structure gives at the samples
  std::uint64_t needed = 0;          // lights that reach the samples
  std::uint64_t missed = 0;          // of those, not given, whatever the reason
  std::uint64_t unanswered = 0;      // samples at which the structure has no answer: they lie outside of its cells
  std::uint64_t missed_outside = 0;  // of the missed, at those
  assign::Reads reads{};             // what shaders fetch of the structure to know these lights
  // Irradiance, of all needed lights and of those that are missed, as sums over the samples. Photometric, in lux on a
  // surface that faces the light: intensity times the colour's luminance, by KHR_lights_punctual's attenuation with the
  // range's window and a spot's falloff.
  double lost_lux = 0.0, total_lux = 0.0;

  // The frame that misses most; none where nothing is missed.
  struct WorstFrame {
    int frame = 0;
    std::uint64_t missed = 0, needed = 0;

    friend bool operator==(const WorstFrame&, const WorstFrame&) = default;
  };
  std::optional<WorstFrame> worst{};
  WorstFrame now{-1};  // the frame that is being added
  // The sample that loses most light.
  struct DarkestSample {
    int frame = 0;
    float pixel_x = 0.0f, pixel_y = 0.0f;
    double lost_lux = 0.0;
  };
  std::optional<DarkestSample> darkest{};

  double lost_irradiance() const;  // share of the irradiance that is lost, 0 where there is none

  double overshade() const;  // evaluated / needed; NaN when nothing is needed
  // NaN also where it compares with nothing: few lights are needed, or some are not given, which makes it small.
  double comparable_overshade() const;
  double unlit() const;         // missed / needed; NaN when nothing is needed
  double unlit_inside() const;  // the same without missed_outside
};

// Which lights reach each of the frame's samples, in exact terms (double-precision distance with the tie counted as
// reached), CSR like lists.
assign::Lists lights_reaching(const view::Frame& frame, std::span<const grid::Sample> samples);

// The same, and what each of these lights brings: of the lists' entries, in their order.
struct NeededLights {
  assign::Lists lists;
  std::vector<double> lux;
};
NeededLights needed_lights(const view::Frame& frame, std::span<const grid::Sample> samples);

// Of a frame, all at once or part by part.
void add_samples(ShadingCounts& counts, int frame, std::span<const grid::Sample> samples, const NeededLights& needed,
                 const assign::LightStructure& structure);

}  // namespace clusterbench::measure
