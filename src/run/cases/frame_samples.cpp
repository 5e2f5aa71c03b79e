#include "run/cases/frame_samples.h"

#include "run/cases/impossible_cases.h"

namespace clusterbench::run {

FrameSamples::FrameSamples(const config::Config& config, std::span<const config::SampleSetRequest> sets,
                           const SceneData& data, const PathFrames& path)
    : config_(config), sets_(sets), data_(data), path_(path) {}

std::vector<FrameSampleSet> FrameSamples::of(const view::Frame& frame) const {
  std::vector<FrameSampleSet> out;
  for (const config::SampleSetRequest& request : sets_) {
    FrameSampleSet& set = out.emplace_back();
    if (!set_obstacle(request, data_).empty()) continue;
    if (!request.needs_triangles())
      set.samples = points_of(request, frame);
    else
      add_surface_samples(request, frame, set);
  }
  return out;
}

std::vector<grid::Sample> FrameSamples::points_of(const config::SampleSetRequest& request,
                                                  const view::Frame& frame) const {
  using measure::SampleSet;
  const double far = sample_far(frame, path_.far_m());
  const std::uint64_t seed = config_.seed;
  switch (request.set) {
    case SampleSet::volume:
      return measure::volume_samples(frame, far, request.count, seed);
    case SampleSet::fog:
      return measure::fog_samples(frame, far, request.froxels);
    case SampleSet::mirror:
      return measure::mirror_samples(frame, path_.light_bounds(), request.count, seed);
    case SampleSet::anywhere:
      return measure::anywhere_samples(frame, path_.light_bounds(), request.count, seed);
    case SampleSet::opaque:
    case SampleSet::transparent:
      break;  // see add_surface_samples()
  }
  return {};
}

void FrameSamples::add_surface_samples(const config::SampleSetRequest& request, const view::Frame& frame,
                                       FrameSampleSet& out) const {
  if (const std::optional<double> height_m = ground_height(request, data_)) {
    out.picture = measure::ground_depths(frame, depth::PixelGrid(frame.viewport, request.divisor), *height_m);
    out.samples = measure::opaque_samples(frame, *out.picture);
    return;
  }
  FrameDepths& depths = *path_.depths();
  const std::shared_ptr<const depth::DepthImage> image = depths.thinned(frame, request.divisor, config_.threads);
  if (request.set == measure::SampleSet::opaque) {
    out.samples = measure::opaque_samples(frame, *image);
    out.picture = *image;
  } else {
    out.samples = measure::transparent_samples(frame, depths.layers(frame, *image, request.layers, config_.threads));
  }
}

}  // namespace clusterbench::run
