// H10 to H18: projections, pictures, far-away worlds.

#include <cmath>
#include <limits>

#include "assign/contract/assigner_run.h"
#include "core/random.h"
#include "measure/truth/truth.h"
#include "stress/hard_cases.h"

namespace clusterbench::stress {
namespace {

using grid::Scheme;

// Lights in and around a view of the given slopes, of all sizes; every third one is a spot.
Rig& scatter(Rig& rig, double slope_x, double slope_y, int count, std::uint64_t seed) {
  SplitMix64 random(seed);
  for (int i = 0; i < count; ++i) {
    const double depth = std::exp(std::log(0.05) + random.unit() * std::log(600.0 / 0.05));
    const double across = 1.4 * (2.0 * random.unit() - 1.0), up = 1.4 * (2.0 * random.unit() - 1.0);
    const Vec3d position{across * slope_x * depth, up * slope_y * depth, -depth};
    const double range = depth * std::exp(std::log(1e-3) + random.unit() * std::log(1e3));
    const double yaw = 360.0 * k_degree * random.unit(), pitch = random.unit() - 0.5,
                 angle = 1e-3 + 1.5 * random.unit();
    if (i % 3 == 2)
      rig.spot(position, {std::cos(yaw), pitch, std::sin(yaw)}, range, angle);
    else
      rig.point(position, range);
  }
  return rig;
}

double slope_of(double degrees) {
  return std::tan(degrees * k_degree / 2.0);
}

std::vector<Trial> fields_of_view(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const double degrees : {0.1, 1.0, 170.0, 179.0}) {
    Rig rig;
    rig.projection().yfov_rad = degrees * k_degree;
    scatter(rig, slope_of(degrees) * 16 / 9, slope_of(degrees), 120, seed)
        .on_each(grids_of_every_kind(), std::to_string(degrees) + " degrees", trials);
  }
  return trials;
}

std::vector<Trial> aspects(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const Vec2i& viewport : {Vec2i{6400, 64}, Vec2i{64, 6400}}) {
    Rig rig;
    const double slope = slope_of(60.0);
    scatter(rig, slope * viewport.x / viewport.y, slope, 120, seed).show(viewport);
    rig.on_each(grids_of_every_kind(), std::to_string(viewport.x) + "x" + std::to_string(viewport.y), trials);
  }
  return trials;
}

Rig orthographic_rig(double near_m, std::uint64_t seed) {
  Rig rig;
  rig.projection() = {};
  rig.projection().orthographic = true;
  rig.projection().xmag_m = 40.0;
  rig.projection().ymag_m = 22.5;
  rig.projection().near_m = near_m;
  rig.projection().far_m = 200.0;
  SplitMix64 random(seed);
  for (int i = 0; i < 150; ++i) {
    const double x = random.between(-50, 50), y = random.between(-30, 30), z = random.between(-220, 30);
    const double range = std::exp(random.between(std::log(0.05), std::log(60.0)));
    if (i % 3 == 2)
      rig.spot({x, y, z}, {x + 0.1, -10, z + 100}, range, 0.3 + 0.005 * i);
    else
      rig.point({x, y, z}, range);
  }
  return rig;
}

std::vector<Trial> orthographic(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const double near : {0.0, 1.0, -25.0}) {
    const Rig rig = orthographic_rig(near, seed);
    grid::GridSpec linear = frustum_grid({16, 9}, Scheme::linear, 16, 0.0, 200.0);
    linear.slices.near_m = near;
    trials.push_back(rig.on(linear, "near " + std::to_string(near)));
    for (const Scheme scheme : {Scheme::exponential, Scheme::exponential_first, Scheme::power}) {
      grid::GridSpec curved = frustum_grid({16, 9}, scheme, 16, 0.0, 200.0);
      curved.slices.near_m = near;
      trials.push_back(rig.on(curved, "not linear, near " + std::to_string(near)));
    }
  }
  return trials;
}

std::vector<Trial> off_centre(std::uint64_t seed) {
  std::vector<Trial> trials;
  const double outer = std::tan(54 * k_degree), inner = std::tan(40 * k_degree);
  const double top = std::tan(44 * k_degree), bottom = -std::tan(55 * k_degree);
  for (const scene::ProjectionSides& sides :
       {scene::ProjectionSides{-outer, inner, bottom, top}, scene::ProjectionSides{-inner, outer, bottom, top}}) {
    Rig rig;
    rig.projection().sides = sides;
    scatter(rig, outer, -bottom, 150, seed).show({2064, 2208});
    rig.on_each(grids_of_every_kind(), sides.left < -sides.right ? "left eye" : "right eye", trials);
  }
  return trials;
}

// A picture moved by parts of a pixel, as in temporal anti-aliasing.
std::vector<Trial> jittered(std::uint64_t seed) {
  std::vector<Trial> trials;
  const double top = slope_of(60.0), right = top * 16 / 9;
  for (const Vec3d& pixels :
       {Vec3d{0.5, 0.5, 0}, Vec3d{-0.5, 0.5, 0}, Vec3d{0.25, -0.5, 0}, Vec3d{-0.375, -0.125, 0}}) {
    const double x = pixels.x * 2.0 * right / 1920.0, y = pixels.y * 2.0 * top / 1080.0;
    Rig rig;
    rig.projection().sides = scene::ProjectionSides{-right + x, right + x, -top + y, top + y};
    scatter(rig, right, top, 120, seed).on_each(grids_of_every_kind(), "jitter", trials);
  }
  return trials;
}

std::vector<Trial> infinite_far(std::uint64_t seed) {
  std::vector<Trial> trials;
  Rig rig;
  rig.projection().far_m = std::numeric_limits<double>::infinity();
  scatter(rig, slope_of(60.0) * 16 / 9, slope_of(60.0), 150, seed)
      .on_each(grids_of_every_kind(), "far from the configuration", trials);
  grid::GridSpec far_unnamed = pixel_grid({128, 128});
  far_unnamed.slices.far_m = 0.0;
  trials.push_back(rig.on(far_unnamed, "far from the lights"));
  far_unnamed.slices.scheme = Scheme::fit;
  trials.push_back(rig.on(far_unnamed, "slices that fit the lights"));
  return trials;
}

std::vector<Trial> odd_pictures(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const Vec2i& viewport : {Vec2i{1366, 768}, Vec2i{1000, 700}, Vec2i{1, 1}, Vec2i{7680, 4320}, Vec2i{65, 63}}) {
    Rig rig;
    const double slope = slope_of(60.0);
    scatter(rig, slope * viewport.x / viewport.y, slope, 90, seed).show(viewport);
    const std::string label = std::to_string(viewport.x) + "x" + std::to_string(viewport.y);
    trials.push_back(rig.on(pixel_grid(viewport.x > 4000 ? Vec2i{256, 256} : Vec2i{64, 64}), label));
    if (viewport.x > 200) trials.push_back(rig.on(pixel_grid({97, 101}), label));
    grid::GridSpec distance = pixel_grid({192, 160});
    distance.kind = grid::Kind::distance;
    trials.push_back(rig.on(distance, label));
  }
  return trials;
}

assign::Lists lists_after(const assign::AssignerDescriptor& row, assign::AssignerRun& run, const grid::Grid& grid,
                          const view::Frame& frame) {
  run.build(grid);
  const view::LightArrays lights = view::lights_in(frame, grid::space_of(grid, frame));
  const depth::DepthImage depths = depths_for(row, frame);
  run.assign(input_of(frame, lights, depths));
  return run.cell_lists();
}

// Half the resolution and back: no state of the other size may remain.
std::vector<ToolCheck> resized(std::uint64_t seed) {
  std::vector<ToolCheck> checks;
  for (const assign::AssignerDescriptor* row : checked_methods()) {
    Rig rig;
    scatter(rig, 1.0, 0.6, 150, seed);
    grid::GridSpec spec = grids_of_every_kind()[0];
    for (const grid::GridSpec& of_a_kind : grids_of_every_kind())
      if (row->takes(of_a_kind.kind)) spec = of_a_kind;
    const Trial full = rig.on(spec), half = rig.show({960, 540}).on(spec);
    const view::Frame full_frame = frame_of(full), half_frame = frame_of(half);
    const grid::Grid full_grid = grid_of(full, full_frame), half_grid = grid_of(half, half_frame);
    const assign::Params params(row->params);
    for (const assign::Answer answer : assign::answers_with_cells(*row, params)) {
      assign::AssignerRun used(*row, params, answer), fresh(*row, params, answer);
      const assign::Lists before = lists_after(*row, used, full_grid, full_frame);
      const assign::Lists small = lists_after(*row, used, half_grid, half_frame);
      const bool same = small == lists_after(*row, fresh, half_grid, half_frame) &&
                        before == lists_after(*row, used, full_grid, full_frame);
      checks.push_back({row->name + ": nothing stale after the resolution changes and changes back", same, ""});
    }
  }
  return checks;
}

// Camera and lights far from the origin. Coordinates are whole parts of a centimetre, which doubles represent there.
std::vector<Trial> far_from_the_origin(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const double offset : {0.0, 1e5, 1e6, 1e7}) {
    SplitMix64 random(seed);
    const Vec3d away{offset, 0.5 * offset, -offset};
    Rig rig;
    for (int i = 0; i < 150; ++i) {
      const double x = random.between(-40, 40), y = random.between(-10, 10), z = random.between(-80, 10);
      const Vec3d position = glm::round(Vec3d(x, y, z) * 64.0) / 64.0;
      const double range = random.between(0.2, 12.0), angle = random.between(0.05, 1.5);
      if (i % 3 == 2)
        rig.spot(position + away, {x, y, 30}, range, angle);
      else
        rig.point(position + away, range);
    }
    rig.look(away, 0.0).on_each(grids_of_every_kind(), "offset " + std::to_string(static_cast<long>(offset)), trials);
  }
  return trials;
}

std::vector<ToolCheck> same_lists_everywhere(std::uint64_t seed) {
  const std::vector<Trial> trials = far_from_the_origin(seed);
  const std::size_t grids = grids_of_every_kind().size();
  std::vector<assign::Lists> at_origin;
  bool same = true;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    if (trials[i].grid.kind == grid::Kind::world) {
      at_origin.emplace_back();
      continue;
    }
    const view::Frame frame = frame_of(trials[i]);
    const assign::Lists lists = measure::find_truth(frame, grid_of(trials[i], frame), 1).lists;
    if (i < grids) at_origin.push_back(lists);
    same = same && lists == at_origin[i % grids];
  }
  return {{"true lists in view space are the same at 0 and at 1e7 m", same, ""}};
}

}  // namespace

std::vector<HardCase> projection_cases() {
  return {{"H10", "fields of view of 0.1, 1, 170 and 179 degrees", fields_of_view, nullptr},
          {"H11", "pictures of 100:1 and 1:100", aspects, nullptr},
          {"H12", "orthographic with near 0 and below", orthographic, nullptr},
          {"H13", "off-centre projections of a headset", off_centre, nullptr},
          {"H14", "jittered projections", jittered, nullptr},
          {"H15", "infinite far", infinite_far, nullptr},
          {"H16", "resolutions that tiles do not divide", odd_pictures, nullptr},
          {"H17", "the resolution changes and changes back", nullptr, resized},
          {"H18", "a world 1e5 to 1e7 m away", far_from_the_origin, same_lists_everywhere}};
}

}  // namespace clusterbench::stress
