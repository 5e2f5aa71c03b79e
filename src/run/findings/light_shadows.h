#pragma once
// Shadow maps of a path's lights: made when a light is first in a list, cached until the light or a surface moves.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "config/config.h"
#include "depth/shadow_map.h"
#include "measure/shadows/shadow_cull.h"
#include "run/cases/path_frames.h"
#include "run/findings/run_result.h"

namespace clusterbench::run {

// For one scene's lights, and each shadow_cull of the configuration.
class LightShadows {
 public:
  // All must outlive this object.
  LightShadows(const config::Config& config, const SceneData& data, const PathFrames& path);

  // Moves surfaces to their places in this frame; the following calls use its lights. The frame must stay alive during
  // these calls.
  void start(const view::Frame& frame);

  // One map per light of the frame in these lists; null for other lights.
  std::vector<const depth::ShadowMap*> maps(std::size_t request, const assign::Lists& lists);
  // The key of a light's map: the map is valid while the key is the same.
  struct Seen {
    scene::WorldLight light;
    std::uint64_t surfaces = 0;

    bool is_same(const Seen& other) const;
  };
  Seen seen(std::uint32_t light) const { return {frame_->lights[light], caster_.builds()}; }

  // Per request and entry of needed.lists: whether no surface is between light and sample, from near_m after the light
  // to bias_m before the sample.
  std::vector<std::vector<bool>> lit(std::span<const grid::Sample> samples, const measure::NeededLights& needed) const;

  // Mean times of making a request's maps.
  struct MakingTimes {
    std::uint64_t maps = 0;
    double cast_ns = 0.0, reduce_ns = 0.0;
  };
  const MakingTimes& making(std::size_t request) const { return kept_[request].times; }

 private:
  struct Made {
    Seen seen;
    std::unique_ptr<depth::ShadowMap> map;
    double cast_ns = 0.0, reduce_ns = 0.0;
  };
  struct Kept {
    std::vector<Made> of_lights;  // by index of the frame's lights
    MakingTimes times;
  };

  std::uint64_t kept_bytes() const;
  std::vector<bool> lit(double near_m, double bias_m, std::span<const grid::Sample> samples,
                        const measure::NeededLights& needed) const;

  const config::Config& config_;
  depth::RayCaster caster_;
  Vec3d origin_;
  const view::Frame* frame_ = nullptr;
  std::vector<Kept> kept_;  // one per request
};

// Compares one method's lists with and without lights in shadow, over a path.
class ShadowCullMeter {
 public:
  ShadowCullMeter(const config::ShadowCullRequest& request, std::size_t index) : index_(index) {
    result_.request = request;
  }

  // `truth`: null if unknown. The lists must outlive the frame.
  void add(LightShadows& shadows, const view::Frame& frame, const grid::Grid& grid, const assign::Lists& lists,
           const assign::Lists* truth);
  // For the current frame.
  void add_samples(const grid::Grid& grid, std::span<const grid::Sample> samples, const measure::NeededLights& needed,
                   const std::vector<bool>& is_lit);
  ShadowCullResult result(const LightShadows& shadows) const;

 private:
  void count_maps(const LightShadows& shadows, const std::vector<const depth::ShadowMap*>& maps);

  std::size_t index_;
  ShadowCullResult result_;
  std::vector<std::optional<LightShadows::Seen>> seen_;  // by light
  std::vector<std::size_t> bytes_;                       // by light
  const assign::Lists* lists_ = nullptr;                 // of the current frame
  assign::Lists kept_;
  double step_ns_ = 0.0;
  int frames_ = 0;
};

}  // namespace clusterbench::run
