// Shrinks a setting that shows a fault: removes or rounds every part that is not needed for the same fault.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "core/error.h"
#include "stress/hard_cases.h"
#include "stress/random_search.h"
#include "stress/stress_run.h"

namespace clusterbench::stress {
namespace {

// Fewer digits first; 17 would change nothing.
constexpr int k_decimal_digits[] = {1, 2, 3, 4, 6, 8, 12};
constexpr int k_most_checks = 1500;

double rounded_to(double value, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

// Whether a file with these numbers could be read back.
bool can_be_loaded(const Trial& trial) {
  const scene::CameraProjection& projection = trial.scene.cameras[0].projection;
  const bool is_projection = projection.far_m > projection.near_m && projection.near_m >= 0.0 &&
                             (projection.orthographic ? projection.xmag_m > 0.0 && projection.ymag_m > 0.0
                                                      : projection.near_m > 0.0 && projection.yfov_rad > 0.0 &&
                                                            projection.yfov_rad < std::numbers::pi);
  return is_projection &&
         std::all_of(trial.scene.lights.begin(), trial.scene.lights.end(), [](const scene::Light& light) {
           return light.range_m > 0.0 && light.outer_cone_rad > 0.0 && light.outer_cone_rad <= 90.0 * k_degree;
         });
}

class Shrinker {
 public:
  Shrinker(const Trial& trial, const SettingFault& fault, std::span<const StressMethod> methods)
      : best_(trial), fault_(fault), methods_(methods_that_show(fault, methods)) {}

  Trial run() {
    keep_few_lights();
    for (int round = 0; round < 3; ++round) {
      has_changed_ = false;
      simplify_camera();
      simplify_grid();
      simplify_projection();
      round_lights();
      if (!has_changed_) break;
    }
    return best_;
  }

 private:
  using Change = std::function<void(Trial&)>;

  bool shows_fault(const Trial& trial) {
    if (!can_be_loaded(trial) || ++checks_ > k_most_checks) return false;
    for (const SettingFault& fault : check_setting(trial, methods_).faults)
      if (fault.kind == fault_.kind && fault.method == fault_.method && fault.type == fault_.type) return true;
    return false;
  }

  // True if the change was made: it changes the setting and the fault stays.
  bool attempt(const Change& change) {
    Trial next = best_;
    change(next);
    try {
      if (!shows_fault(next)) return false;
    } catch (const Error&) {
      return false;
    }
    best_ = std::move(next);
    has_changed_ = true;
    return true;
  }

  static void remove_light(Trial& trial, std::size_t index) {
    trial.scene.lights.erase(trial.scene.lights.begin() + static_cast<std::ptrdiff_t>(index));
  }

  // The nodes of removed lights would be written, too.
  static void drop_idle_nodes(Trial& trial) {
    std::vector<scene::Node> nodes{trial.scene.nodes[0]};
    for (scene::Light& light : trial.scene.lights) {
      nodes.push_back(trial.scene.nodes[static_cast<std::size_t>(light.node)]);
      light.node = static_cast<int>(nodes.size()) - 1;
    }
    trial.scene.nodes = nodes;
  }

  void keep_few_lights() {
    for (std::size_t i = 0; i < best_.scene.lights.size(); ++i) {
      if (best_.scene.lights[i].type != fault_.type) continue;
      if (attempt([&](Trial& trial) { trial.scene.lights = {trial.scene.lights[i]}; })) break;
    }
    for (std::size_t i = best_.scene.lights.size(); best_.scene.lights.size() > 1 && i > 0; --i)
      attempt([&](Trial& trial) { remove_light(trial, i - 1); });
    drop_idle_nodes(best_);
  }

  // Camera at the origin, lights moved with it; or one of both.
  void simplify_camera() {
    const scene::Node camera = best_.scene.nodes[0];
    const bool moved = camera.translation != Vec3d(0.0), turned = camera.rotation != Vec4d(0.0, 0.0, 0.0, 1.0);
    if (moved || turned) attempt(into_view);
    if (moved) {
      attempt([](Trial& trial) { trial.scene.nodes[0].translation = Vec3d(0.0); });
      round_each({&best_.scene.nodes[0].translation.x, &best_.scene.nodes[0].translation.y,
                  &best_.scene.nodes[0].translation.z});
    }
    if (turned) attempt([](Trial& trial) { trial.scene.nodes[0].rotation = {0.0, 0.0, 0.0, 1.0}; });
  }

  static void into_view(Trial& trial) {
    const view::Frame frame = frame_of(trial);
    const view::Space& space = frame.view_space;
    for (const scene::WorldLight& light : frame.lights) {
      const auto rig_index = static_cast<std::size_t>(light.rig_index);
      scene::Node& node = trial.scene.nodes[static_cast<std::size_t>(trial.scene.lights[rig_index].node)];
      node.translation = space.rotation * (light.position - space.origin);
      if (light.type == scene::LightType::spot)
        node.rotation = scene::rotation_towards(space.rotation * light.direction);
    }
    trial.grid.bounds_lo_m -= space.origin;
    trial.grid.bounds_hi_m -= space.origin;
    trial.scene.nodes[0].translation = Vec3d(0.0);
    trial.scene.nodes[0].rotation = {0.0, 0.0, 0.0, 1.0};
  }

  void simplify_grid() {
    if (!best_.grid.has_tiles()) return simplify_boxes();
    list_boundaries();
    for (std::size_t i = best_.grid.slices.boundaries_m.size(); i > 0 && best_.grid.slices.boundaries_m.size() > 2; --i)
      attempt([&](Trial& trial) {
        auto& list = trial.grid.slices.boundaries_m;
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(i - 1));
      });
    for (std::size_t i = 0; i < best_.grid.slices.boundaries_m.size(); ++i)
      round_each({&best_.grid.slices.boundaries_m[i]});
    for (const int count : {1, 2, 3, 4, 6, 8}) {
      if (count < tile_count().x && attempt([&](Trial& trial) {
            trial.grid.tiles = {{0, 0}, {count, tile_count().y}};
          }))
        break;
    }
    for (const int count : {1, 2, 3, 4, 6, 8}) {
      if (count < tile_count().y && attempt([&](Trial& trial) {
            trial.grid.tiles = {{0, 0}, {tile_count().x, count}};
          }))
        break;
    }
  }

  Vec2i tile_count() const {
    return best_.grid.tiles.count.x > 0 ? best_.grid.tiles.count : grid_of(best_, frame_of(best_)).screen().tiles.count;
  }

  // The slices by their boundaries, so that single ones can be removed.
  void list_boundaries() {
    if (best_.grid.slices.scheme == grid::Scheme::list) return;
    if (best_.grid.slices.fit) attempt([](Trial& trial) { trial.grid.slices.fit.reset(); });
    const grid::Grid grid = grid_of(best_, frame_of(best_));
    const std::vector<float>& boundaries = grid.screen().slices.boundaries;
    attempt([&](Trial& trial) {
      trial.grid.slices.scheme = grid::Scheme::list;
      trial.grid.slices.fit.reset();
      trial.grid.slices.boundaries_m.assign(boundaries.begin(), boundaries.end());
    });
  }

  // The box of this frame as a fixed one, so that it can be simplified.
  void hold_box() {
    if (best_.grid.kind != grid::Kind::world || best_.grid.follow == grid::Follow::nothing) return;
    const grid::Grid grid = grid_of(best_, frame_of(best_));
    const grid::WorldGrid& world = grid.world();
    attempt([&](Trial& trial) {
      trial.grid.follow = grid::Follow::nothing;
      trial.grid.has_bounds = true;
      trial.grid.bounds_lo_m = world.origin + Vec3d(Vec3f{world.x.front(), world.y.front(), world.z.front()});
      trial.grid.bounds_hi_m = world.origin + Vec3d(Vec3f{world.x.back(), world.y.back(), world.z.back()});
    });
  }

  void simplify_boxes() {
    hold_box();
    const bool is_cascade = best_.grid.kind == grid::Kind::cascades;
    while (is_cascade && best_.grid.levels > 1 && attempt([](Trial& trial) { --trial.grid.levels; })) continue;
    const Vec3i least = is_cascade ? Vec3i{4, 4, 2} : Vec3i{1, 1, 1};
    for (int axis = 0; axis < 3; ++axis)
      while (best_.grid.cells[axis] > least[axis] &&
             attempt([&](Trial& trial) { trial.grid.cells[axis] -= least[axis]; }))
        continue;
    round_each({&best_.grid.finest_m});
    for (int axis = 0; axis < 3 && best_.grid.has_bounds; ++axis)
      round_each({&best_.grid.bounds_lo_m[axis], &best_.grid.bounds_hi_m[axis]});
  }

  void simplify_projection() {
    if (best_.viewport != Vec2i{64, 64}) attempt([](Trial& trial) { trial.viewport = {64, 64}; });
    const scene::CameraProjection before = best_.scene.cameras[0].projection;
    if (before.sides) attempt([](Trial& trial) { trial.scene.cameras[0].projection.sides.reset(); });
    if (!before.orthographic) attempt([](Trial& trial) { trial.scene.cameras[0].projection.yfov_rad = 1.0; });
    scene::CameraProjection& projection = best_.scene.cameras[0].projection;
    if (projection.sides)
      round_each(
          {&projection.sides->left, &projection.sides->right, &projection.sides->bottom, &projection.sides->top});
    round_each({&projection.near_m, &projection.far_m, &projection.yfov_rad, &projection.xmag_m, &projection.ymag_m});
  }

  void round_lights() {
    for (std::size_t i = 0; i < best_.scene.lights.size(); ++i) {
      scene::Light& light = best_.scene.lights[i];
      scene::Node& node = best_.scene.nodes[static_cast<std::size_t>(light.node)];
      for (int axis = 0; axis < 3; ++axis) {
        set_to(node.translation[axis], 0.0);
        round_each({&node.translation[axis]});
      }
      if (light.type == scene::LightType::box) {
        round_each({&light.half_extents_m.x, &light.half_extents_m.y, &light.half_extents_m.z});
        continue;
      }
      round_each({&light.range_m});
      if (light.type != scene::LightType::spot) continue;
      round_each({&light.outer_cone_rad});
      if (node.rotation != Vec4d(0.0, 0.0, 0.0, 1.0)) round_direction(i);
    }
  }

  void round_direction(std::size_t index) {
    for (const int digits : k_decimal_digits) {
      const bool done = attempt([&](Trial& trial) {
        scene::Node& node = trial.scene.nodes[static_cast<std::size_t>(trial.scene.lights[index].node)];
        Vec3d direction(0.0);
        const view::Frame frame = frame_of(trial);
        for (const scene::WorldLight& light : frame.lights)
          if (light.rig_index == static_cast<int>(index)) direction = light.direction;
        for (int axis = 0; axis < 3; ++axis) direction[axis] = std::round(direction[axis] * std::pow(10.0, digits));
        if (direction != Vec3d(0.0)) node.rotation = scene::rotation_towards(glm::normalize(direction));
      });
      if (done) return;
    }
  }

  // Numbers of best_ itself: changed in place, and changed back if the fault disappears.
  bool set_to(double& number, double value) {
    const double before = number;
    if (before == value || !std::isfinite(before)) return false;
    number = value;
    bool stays = false;
    try {
      stays = shows_fault(best_);
    } catch (const Error&) {
    }
    if (!stays) number = before;
    has_changed_ = has_changed_ || stays;
    return stays;
  }
  void round_each(std::initializer_list<double*> numbers) {
    for (double* number : numbers)
      for (const int digits : k_decimal_digits) {
        const double value = rounded_to(*number, digits);
        if (value == *number || set_to(*number, value)) break;
      }
  }

  Trial best_;
  SettingFault fault_;
  std::vector<StressMethod> methods_;
  int checks_ = 0;
  bool has_changed_ = false;
};

}  // namespace

std::vector<StressMethod> methods_that_show(const SettingFault& fault, std::span<const StressMethod> methods) {
  std::vector<StressMethod> shown;
  for (const StressMethod& method : methods)
    if (fault.method.empty() ? method.conservative && !method.assigner->naive
                             : method.label == fault.method || method.label == reference_of(fault.method))
      shown.push_back(method);
  return shown;
}

Trial shrunk(const Trial& trial, const SettingFault& fault, std::span<const StressMethod> methods) {
  return Shrinker(trial, fault, methods).run();
}

}  // namespace clusterbench::stress
