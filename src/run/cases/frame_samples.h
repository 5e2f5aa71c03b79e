#pragma once
// The sets of samples that a configuration asks for, frame by frame.

#include <optional>
#include <vector>

#include "config/config.h"
#include "depth/depth_image.h"
#include "measure/samples/shading.h"
#include "run/cases/path_frames.h"
#include "run/cases/sweep.h"

namespace clusterbench::run {

// A frame's samples of one set.
struct FrameSampleSet {
  std::vector<grid::Sample> samples;
  std::optional<depth::DepthImage> picture;  // of visible surfaces
};

// Of one camera's path. Casts rays only for sets of visible surfaces.
class FrameSamples {
 public:
  // All must outlive it.
  FrameSamples(const config::Config& config, const SceneData& data, const PathFrames& path);

  // One per set of Config::sample_sets, in their order; those of surfaces are empty where the scene has none.
  std::vector<FrameSampleSet> of(const view::Frame& frame);

 private:
  std::vector<grid::Sample> points_of(const config::SampleSetRequest& request, const view::Frame& frame) const;
  void look_at_surfaces(const config::SampleSetRequest& request, const view::Frame& frame, FrameSampleSet& out) const;

  const config::Config& config_;
  const SceneData& data_;
  const PathFrames& path_;
};

}  // namespace clusterbench::run
