#pragma once
// The lists that methods on a device must give: the tests of src/gpu/shaders/common.glsl, with the same steps in the
// same order, on the processor.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "assign/contract/assigner_run.h"
#include "assign/contract/light_test.h"
#include "assign/settings.h"
#include "geom/single_precision/bounding_volumes.h"
#include "gpu/device/device.h"

namespace clusterbench::gpu::testing {

// By how much a device that may round either way pads more.
inline float steps_of_device() {
  return device().facts().rounds_to_nearest ? 1.0f : 2.0f;
}

inline float size_of_vector(const Vec3f& v) {
  return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
}

// As cone_touches_ball() of common.glsl.
inline bool cone_touches_ball_on_device(const geom::SphericalCone& cone, const geom::Ball& ball, float slack) {
  if (ball.radius > 1e18f) return true;
  const float x = ball.center.x - cone.apex.x, y = ball.center.y - cone.apex.y, z = ball.center.z - cone.apex.z;
  const float along = x * cone.axis.x + y * cone.axis.y + z * cone.axis.z;
  const float reach = ball.radius + slack * (size_of_vector(cone.apex) + size_of_vector(ball.center));
  const float farthest = cone.range + reach;
  if (along < -reach || along > farthest) return false;
  if (x * x + y * y + z * z > farthest * farthest) return false;
  const float across_x = x - along * cone.axis.x, across_y = y - along * cone.axis.y,
              across_z = z - along * cone.axis.z;
  const float across = across_x * across_x + across_y * across_y + across_z * across_z;
  const float beside = reach + cone.sin_angle * along;
  return beside >= 0.0f && cone.cos_angle * cone.cos_angle * across <= beside * beside;
}

// A light as it is packed for the device.
struct PackedLight {
  geom::Ball ball{};  // of negative radius: without volume
  bool has_cone = false;
  geom::SphericalCone cone{};
};

class PackedLights {
 public:
  // `slack`: of the cones' test, in units of the right one.
  PackedLights(const assign::Params& params, const grid::Grid& grid, const view::LightArrays& lights, float slack)
      : test_(params, k_ball_roundoffs * steps_of_device()), slack_(slack * k_cone_slack * steps_of_device()) {
    test_.start_grid(grid, assign::kinds_of(lights));
    for (std::uint32_t light = 0; light < lights.boxes.first; ++light) lights_.push_back(packed(lights, light));
  }

  const geom::Ball& ball(std::uint32_t light) const { return lights_[light].ball; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(lights_.size()); }
  bool touches(std::uint32_t light, const geom::Box& box, std::uint32_t cell) const {
    const PackedLight& at = lights_[light];
    if (at.ball.radius < 0.0f || !geom::ball_touches_box(at.ball, box)) return false;
    return !at.has_cone || cone_touches_ball_on_device(at.cone, test_.cell_balls()[cell], slack_);
  }

 private:
  static constexpr float k_ball_roundoffs = 4.0f, k_cone_slack = 0x1p-19f, k_endless = 1e19f;

  PackedLight packed(const view::LightArrays& lights, std::uint32_t light) const {
    if (lights.is_empty(light)) return {{Vec3f(0.0f), -1.0f}};
    PackedLight out{test_.ball(lights, light, k_ball_roundoffs * steps_of_device())};
    out.ball.radius = std::min(out.ball.radius, k_endless);
    if (!lights.is_spot(light) || !test_.tests_cones()) return out;
    out.has_cone = true;
    out.cone = test_.cone(lights, light);
    out.cone.range = std::min(out.cone.range, k_endless);
    return out;
  }

  assign::LightTest test_;
  float slack_;
  std::vector<PackedLight> lights_;
};

// Every light against every cell, on the processor.
inline assign::Lists reference_lists(const assign::Params& params, const assign::testing::Setting& setting,
                                     float slack = 1.0f) {
  const PackedLights lights(params, setting.grid,
                            view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame)), slack);
  assign::Lists lists;
  lists.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < setting.grid.cell_count(); ++cell) {
    const geom::Box box = geom::box_around(std::get<geom::FrustumCell>(setting.grid.cell(cell)));
    for (std::uint32_t light = 0; light < lights.count(); ++light)
      if (lights.touches(light, box, cell)) lists.lights.push_back(light);
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

inline assign::Lists lists_of(const assign::AssignerDescriptor& method, const assign::Params& params,
                              const assign::testing::Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  assign::AssignerRun run(method, params, assign::Answer::lists);
  run.build(setting.grid, assign::kinds_of(lights));
  run.assign(setting.input(lights));
  const std::string fault = assign::lists_fault(*run.filled_lists(), setting.grid.cell_count(), lights);
  EXPECT_EQ(fault, "") << method.name << " on " << setting.name;
  return fault.empty() ? run.cell_lists() : assign::Lists{};
}

// Each choice, with cells that the host has made: the balls around those of the device are others
// (device_cells_test.cpp).
inline std::vector<assign::Params> choices_with_cells_of_host(const assign::AssignerDescriptor& row) {
  std::vector<assign::Params> choices = assign::testing::params_of(row);
  std::erase_if(choices, [](const assign::Params& params) {
    return params.values().contains("cells") && params.text("cells") != "host";
  });
  return choices;
}

// The first cell whose lists differ, as a sentence; "" if none does.
inline std::string first_difference(const assign::Lists& found, const assign::Lists& expected) {
  if (found.cell_count() != expected.cell_count()) return "lists of " + std::to_string(found.cell_count()) + " cells";
  for (std::uint32_t cell = 0; cell < expected.cell_count(); ++cell) {
    const auto a = found.of(cell), b = expected.of(cell);
    const auto [at, in_b] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
    if (at == a.end() && in_b == b.end()) continue;
    const auto name = [](auto light, auto end) { return light == end ? "the end" : "light " + std::to_string(*light); };
    return "cell " + std::to_string(cell) + ", entry " + std::to_string(at - a.begin()) + ": " + name(at, a.end()) +
           " for " + name(in_b, b.end());
  }
  return "";
}

// A setting with every n-th light of its own, and of its touching lights those that are left.
inline assign::testing::Setting thinned(assign::testing::Setting setting, std::uint32_t nth, std::uint32_t first) {
  std::vector<scene::WorldLight> kept;
  std::vector<assign::testing::Setting::Touch> touches;
  for (std::uint32_t light = 0; light < setting.frame.lights.size(); ++light) {
    const scene::WorldLight& at = setting.frame.lights[light];
    const bool is_special = at.range_m == 0.0 || std::isinf(at.range_m);
    if (light % nth != first % nth && !is_special) continue;
    for (const auto& touch : setting.touches)
      if (touch.light == light) touches.push_back({touch.cell, static_cast<std::uint32_t>(kept.size())});
    kept.push_back(at);
  }
  setting.frame.lights = std::move(kept);
  setting.touches = std::move(touches);
  setting.frame.count_types();
  return setting;
}

}  // namespace clusterbench::gpu::testing
