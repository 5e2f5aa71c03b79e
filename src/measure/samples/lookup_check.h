#pragma once
// Tests whether a shader's lookup finds every light that reaches a sample. Samples are random, at slice boundaries, at
// tile edges and at the ends of lights; the logarithm and the depth are rounded in the ways that shaders do.

#include <cstdint>
#include <vector>

#include "assign/contract/light_structure.h"
#include "grid/grid.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {

enum class Logarithm : std::uint8_t { rounded, glsl, fast };  // see grid::Log2; glsl: both ends of its error bound
enum class DepthRead : std::uint8_t { given, d32f, d24 };  // given: in single precision; the others: reversed-Z buffers
inline constexpr int k_logarithm_count = 3, k_depth_read_count = 3;
const char* name_of(Logarithm logarithm);  // "rounded", "glsl", "fast"
const char* name_of(DepthRead depth);      // "given", "d32f", "d24"

struct LookupWay {
  Logarithm logarithm = Logarithm::rounded;
  DepthRead depth = DepthRead::given;
};

struct LookupCounts {
  LookupWay way;
  std::uint64_t samples = 0;
  std::uint64_t needed = 0;  // lights that reach the samples
  std::uint64_t missed = 0;  // of those, lights that the lookup does not return
  std::uint64_t wrong_samples = 0;
  // Of the slices, as grid::safe_padding_ulps; 0 if the lookup uses no logarithm. Maximum over the frames.
  std::int64_t safe_padding_ulps = 0;
};

// The depth that a shader reads back from the depth buffer. Reversed-Z: 1 at near, 0 at far (or infinity). Depths in
// front of near are clamped to it. D24 stores the nearest of 2^24 - 1 steps.
double read_depth(const view::Projection& projection, DepthRead read, double depth);

// The samples of one frame, with their depth read back in every way. Points beyond the grid's far end are left out.
class LookupFrame {
 public:
  LookupFrame(const view::Frame& frame, const grid::Grid& grid, const std::vector<LookupWay>& ways, double far_m,
              int samples, std::uint64_t seed);

  // `counts`: one per combination, in their order.
  void add(const assign::LightStructure& structure, std::vector<LookupCounts>& counts) const;

 private:
  struct Way {
    LookupWay way;
    std::vector<grid::Log2> ends;  // bounds of its logarithm: one or two
    std::int64_t padding = 0;
    std::vector<grid::Sample> samples;
  };
  void add_way(const Way& way, const assign::LightStructure& structure, LookupCounts& counts) const;

  assign::Lists reaching_;  // for each sample
  std::vector<Way> ways_;
};

// Seeded samples in the frame: a quarter as volume_samples; a quarter at slice boundaries and a few ulp beside them; a
// quarter in pixels beside tile edges; a quarter at the nearest and farthest points of lights. Grids of boxes have
// neither slices nor tiles, and get more random samples instead.
std::vector<grid::Sample> edge_samples(const view::Frame& frame, const grid::Grid& grid, double far_m, int count,
                                       std::uint64_t seed);

}  // namespace clusterbench::measure
