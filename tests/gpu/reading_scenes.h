#pragma once
// Structures and samples that readings are tested with.

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "assign/settings.h"
#include "gpu/reading/reading_samples.h"

namespace clusterbench::gpu::testing {

using assign::AssignerDescriptor;
using assign::Params;
using assign::testing::Setting;

inline grid::Sample sample_at(const view::Frame& frame, const Vec2d& pixel, double depth) {
  const Vec3d at = view::picture_ray(frame, pixel).at(depth);
  return {static_cast<float>(pixel.x), static_cast<float>(pixel.y), Vec3f(at),
          glm::transpose(frame.view_space.rotation) * at, frame.view_space.origin};
}

// A thinned picture of a setting with its samples: those of its pixels with a surface.
struct Picture {
  depth::DepthImage image;
  std::vector<grid::Sample> samples;

  Picture(const view::Frame& frame, int divisor, std::uint64_t seed)
      : image(depth::thinned(depth::seeded_depths(frame, seed), {frame.viewport, divisor})) {
    for (std::size_t i = 0; i < image.nearest.size(); ++i)
      if (image.nearest[i] < std::numeric_limits<float>::infinity())
        samples.push_back(sample_at(frame, image.pixels.pixel(i), static_cast<double>(image.nearest[i])));
  }
};

// Points in the view, beside it and behind the eye.
inline std::vector<grid::Sample> points_anywhere(const view::Frame& frame, int count, std::uint64_t seed) {
  assign::testing::Random random(seed);
  std::vector<grid::Sample> samples;
  for (int i = 0; i < count; ++i) {
    const Vec2d pixel{random.between(-0.2, 1.2) * frame.viewport.x, random.between(-0.2, 1.2) * frame.viewport.y};
    samples.push_back(sample_at(frame, pixel, random.log_between(0.05, 500.0)));
    if (random.unit() < 0.9) continue;
    grid::Sample& behind = samples.back();
    behind.view = -behind.view;
    behind.from_eye = -behind.from_eye;
    behind.pixel_x = behind.pixel_y = std::numeric_limits<float>::quiet_NaN();
  }
  return samples;
}

// A structure with all that it refers to.
struct Held {
  std::string name;
  view::LightArrays lights;
  std::unique_ptr<assign::AssignerRun> run;
  std::unique_ptr<assign::Storage> storage;

  const assign::LightStructure& structure() const { return storage ? *storage : *run->structure(); }
};

inline std::unique_ptr<assign::AssignerRun> run_of(const AssignerDescriptor& method, assign::Answer answer,
                                                   const Setting& setting, const view::LightArrays& lights) {
  auto run = std::make_unique<assign::AssignerRun>(method, Params(method.params), answer);
  run->build(setting.grid, assign::kinds_of(lights));
  run->assign(setting.input(lights));
  return run;
}

inline Held own_structure(const AssignerDescriptor& method, const Setting& setting) {
  Held held{method.name + " on " + setting.name,
            view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame)), nullptr, nullptr};
  held.run = run_of(method, assign::Answer::structure, setting, held.lights);
  return held;
}

struct StorageChoice {
  const char* storage;
  std::map<std::string, assign::ParamValue> params;
};

inline Held stored(const AssignerDescriptor& method, const StorageChoice& choice, const Setting& setting) {
  Held held{choice.storage, view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame)), nullptr,
            nullptr};
  for (const auto& [name, value] : choice.params)
    held.name += " " + name + (std::holds_alternative<std::string>(value) ? "=" + std::get<std::string>(value) : "");
  held.name += " on " + setting.name;
  held.run = run_of(method, assign::Answer::lists, setting, held.lights);
  const assign::StorageDescriptor& storage = *assign::find_storage(choice.storage);
  held.storage = storage.make(Params(storage.params, choice.params));
  held.storage->start(setting.grid, held.lights);
  held.storage->store(*held.run->filled_lists());
  return held;
}

// Every storage in the forms that its buffers have.
inline std::vector<StorageChoice> storage_choices() {
  return {{"packed", {}},
          {"packed", {{"index_bits", std::string("32")}}},
          {"packed", {{"headers", std::string("sparse")}}},
          {"packed", {{"equal_lists", std::string("shared")}, {"header_size", 32.0}}},
          {"packed", {{"max_entries", 3000.0}, {"headers", std::string("sparse")}}},
          {"fixed", {}},
          {"fixed", {{"cap", 7.0}, {"counts", std::string("none")}}},
          {"bitfield", {}},
          {"linked", {}},
          {"linked", {{"nodes_per_cell", 0.5}}},
          {"runs", {}}};
}

inline const AssignerDescriptor& method_named(const char* name) {
  return *assign::find_assigner(name);
}

// Without most of its lights: so few that indices have 8 bits.
inline Setting with_few_lights(Setting setting) {
  std::vector<scene::WorldLight> kept;
  for (std::size_t i = 0; i < setting.frame.lights.size(); i += 4) kept.push_back(setting.frame.lights[i]);
  setting.frame.lights = kept;
  setting.frame.count_types();
  return setting;
}

}  // namespace clusterbench::gpu::testing
