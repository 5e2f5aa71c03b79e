#pragma once
// The sample sets that a configuration requests, frame by frame.

#include <optional>
#include <span>
#include <vector>

#include "config/config.h"
#include "depth/depth_image.h"
#include "measure/samples/shading.h"
#include "run/cases/path_frames.h"
#include "run/cases/scene_data.h"

namespace clusterbench::run {

// A frame's samples of one set.
struct FrameSampleSet {
  std::vector<grid::Sample> samples;
  std::optional<depth::DepthImage> picture;  // of visible surfaces
};

// For one camera path. Casts rays only for sets of visible surfaces.
class FrameSamples {
 public:
  // All must outlive this object.
  FrameSamples(const config::Config& config, const SceneData& data, const PathFrames& path)
      : FrameSamples(config, config.sample_sets, data, path) {}
  FrameSamples(const config::Config& config, std::span<const config::SampleSetRequest> sets, const SceneData& data,
               const PathFrames& path);

  // One per set, in the same order; sets that the scene does not have (set_obstacle()) are empty.
  // Several threads may call it.
  std::vector<FrameSampleSet> of(const view::Frame& frame) const;

 private:
  std::vector<grid::Sample> points_of(const config::SampleSetRequest& request, const view::Frame& frame) const;
  void add_surface_samples(const config::SampleSetRequest& request, const view::Frame& frame,
                           FrameSampleSet& out) const;

  const config::Config& config_;
  std::span<const config::SampleSetRequest> sets_;
  const SceneData& data_;
  const PathFrames& path_;
};

}  // namespace clusterbench::run
