// H1 to H9: slice boundaries, the near and the far end, the eye, sizes.

#include <cmath>
#include <limits>

#include "assign/contract/assigner.h"
#include "core/random.h"
#include "measure/truth/truth.h"
#include "stress/contact.h"
#include "stress/hard_cases.h"

namespace clusterbench::stress {
namespace {

using grid::Scheme;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

struct Slicing {
  double near_m, far_m;
  int count;
};
constexpr Slicing k_slicings[] = {{0.1, 400, 24}, {0.01, 1e4, 32}, {1e-3, 1e6, 64}, {0.1, 500, 4096}};

grid::GridSpec grid_of_slicing(const Slicing& s) {
  return frustum_grid(s.count > 1000 ? Vec2i{2, 2} : Vec2i{6, 4}, Scheme::exponential, s.count, s.near_m, s.far_m);
}

Rig rig_of_slicing(const Slicing& s) {
  Rig rig;
  rig.projection().near_m = s.near_m;
  rig.projection().far_m = s.far_m;
  return rig;
}

float moved(float value, int ulps) {
  for (int i = 0; i < std::abs(ulps); ++i)
    value = std::nextafter(value, ulps > 0 ? std::numeric_limits<float>::infinity() : 0.0f);
  return value;
}

// Small lights on each boundary, and large ones that end on it.
std::vector<Trial> on_slice_boundaries(std::uint64_t) {
  std::vector<Trial> trials;
  for (const Slicing& s : k_slicings) {
    const Rig rig = rig_of_slicing(s);
    const Trial empty = rig.on(grid_of_slicing(s));
    const std::vector<float> boundaries = grid_of(empty, frame_of(empty)).screen().slices.boundaries;
    const std::size_t step = std::max<std::size_t>(1, boundaries.size() / 64);
    for (const int ulps : {-4, -1, 0, 1, 4}) {
      Rig at = rig;
      for (std::size_t k = 0; k < boundaries.size(); k += step) {
        const double depth = moved(boundaries[k], ulps);
        at.point({0.1 * depth, -0.05 * depth, -depth}, 1e-4 * depth);
        at.point({0.0, 0.0, -1.25 * depth}, 0.25 * depth);
      }
      trials.push_back(at.on(grid_of_slicing(s),
                             std::to_string(s.count) + " slices, " + std::to_string(ulps) + " ulp from each boundary"));
    }
  }
  return trials;
}

// The lookup by log2, compared with a natural logarithm in single precision.
std::vector<ToolCheck> lookup_on_boundaries(std::uint64_t) {
  std::vector<ToolCheck> checks;
  for (const Slicing& s : k_slicings) {
    const Rig rig = rig_of_slicing(s);
    const Trial trial = rig.on(grid_of_slicing(s));
    const grid::Slices slices = grid_of(trial, frame_of(trial)).screen().slices;
    int by_log2 = 0, by_natural = 0, deepest = 0;
    for (int k = 0; k < slices.count(); ++k) {
      const float depth = slices.boundaries[static_cast<std::size_t>(k)];
      const int found = slices.slice_of(depth);
      by_log2 += found != k;
      deepest = std::max(deepest, std::abs(found - k));
      const auto near = static_cast<float>(s.near_m), far = static_cast<float>(s.far_m);
      by_natural += static_cast<int>(std::log(depth / near) * static_cast<float>(s.count) / std::log(far / near)) != k;
    }
    checks.push_back({std::to_string(s.count) + " slices: the lookup of a boundary is never off by more than one slice",
                      deepest <= 1,
                      "log2: " + std::to_string(by_log2) + " of " + std::to_string(s.count) +
                          " one slice off, natural logarithm: " + std::to_string(by_natural)});
  }
  return checks;
}

std::vector<Trial> tangent_to_everything(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const grid::GridSpec& spec : grids_of_every_kind()) {
    const Trial empty = Rig().point({0, 0, -60}, 60).on(spec);
    const view::Frame frame = frame_of(empty);
    const grid::Grid grid = grid_of(empty, frame);
    const view::Space space = grid::space_of(grid, frame);
    for (const int ulps : {-4, -1, 0, 1, 4}) {
      SplitMix64 random(seed);
      // The first light fixes the extent of the world grid.
      Rig rig;
      rig.point({0, 0, -60}, 60);
      for (int i = 0; i < 400; ++i) {
        const std::uint32_t cell = random_cell(grid, random);
        const Contact contact = random_contact(grid.cell(cell), random);
        const double range = std::exp(std::log(0.05) + random.unit() * std::log(400.0));
        const Vec3d local = contact.point + range * contact.outward;
        const double nudged = static_cast<double>(moved(static_cast<float>(range), ulps));
        rig.point(glm::transpose(space.rotation) * local + space.origin, ulps == 0 ? range : nudged);
      }
      trials.push_back(rig.on(spec, "tangent, radius off by " + std::to_string(ulps) + " ulp"));
    }
  }
  return trials;
}

std::vector<Trial> around_the_eye(std::uint64_t) {
  std::vector<Trial> trials;
  Rig inside, centre;
  inside.point({1, 2, 3}, 10).point({-3, 0.5, -2}, 40).point({0, 0, 5}, 5.2);
  centre.point({0, 0, 0}, 3).point({0, 0, 0}, 0.05).point({0, 0, 0}, 1e3);
  inside.on_each(grids_of_every_kind(), "eye inside", trials);
  centre.on_each(grids_of_every_kind(), "eye at the centre", trials);
  for (const double off : {-1e-6, 0.0, 1e-6}) {
    Rig rig;
    for (const double r : {0.5, 7.0, 120.0})
      for (const Vec3d& d : {Vec3d(0, 0, -1), Vec3d(0.6, 0, -0.8), Vec3d(0.48, 0.64, 0.6), Vec3d(-0.8, 0.6, 0)})
        rig.point(d * (r * (1.0 + off)), r);
    rig.on_each(grids_of_every_kind(), "eye on the surface", trials);
  }
  return trials;
}

std::vector<Trial> behind_the_eye(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  rig.point({1, 1, 5}, 10).point({-4, 2, 8}, 9).point({30, -3, 1}, 40).point({2, 0, -0.0}, 3).point({0.5, 0, 0.0}, 1);
  rig.point({2, 1, -1e-6}, 1).point({-2, 1, 1e-6}, 4).point({0, 60, 20}, 70);
  rig.on_each(grids_of_every_kind(), "centre behind the eye", trials);
  return trials;
}

std::vector<Trial> around_near(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  rig.point({0, 0, -0.1}, 0.05).point({0.02, 0.01, -0.05}, 0.02).point({0, 0, -0.12}, 0.02).point({0, 0, -0.08}, 0.02);
  rig.point({0.01, 0, -0.05}, 0.05).point({0.3, 0.1, -0.1}, 0.4).point({0, 0, -0.02}, 0.0799999);
  rig.on_each(grids_of_every_kind(), "at near 0.1", trials);
  return trials;
}

std::vector<Trial> in_the_first_slice(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  for (const double depth : {0.1, 0.2, 1.0, 3.0, 4.9, 4.9999999, 5.0, 5.0000001, 5.1})
    rig.point({0.1 * depth, 0.05 * depth, -depth}, 0.03).point({-0.2 * depth, 0, -depth - 2.0}, 2.0);
  for (const int slices : {2, 16, 31})
    trials.push_back(rig.on(frustum_grid({12, 8}, Scheme::exponential_first, slices, 0.1, 500.0), "0.1..5 first"));
  return trials;
}

std::vector<Trial> around_far(std::uint64_t) {
  std::vector<Trial> trials;
  Rig rig;
  rig.point({0, 0, -500}, 3).point({20, 0, -505}, 5).point({-20, 0, -505}, 4.99999).point({0, 0, -900}, 700);
  rig.point({0, 30, -400}, 99.9999999).point({30, 30, -400}, 100).point({0, 0, -505.0001}, 5);
  for (int mm = -20; mm <= 20; ++mm) rig.point({mm, -10, -503.0 - 1e-3 * mm}, 3);
  rig.on_each(grids_of_every_kind(), "at far 500", trials);
  trials.push_back(rig.on(frustum_grid({6, 4}, Scheme::linear, 8, 0.1, 2.0), "far < r"));
  return trials;
}

// The lists of a light that moves through far in steps of a millimetre change once, in every slice.
std::vector<ToolCheck> far_sweep(std::uint64_t) {
  const assign::AssignerDescriptor* const rows[] = {assign::find_assigner("bounds"), assign::find_assigner("exact")};
  std::vector<ToolCheck> checks;
  for (const assign::AssignerDescriptor* row : rows) {
    int changes = 0;
    bool was_listed = true;
    for (int mm = -500; mm <= 500; ++mm) {
      const Trial trial = Rig().point({0, 0, -503.0 - 1e-3 * mm}, 3).on(pixel_grid({256, 256}));
      const view::Frame frame = frame_of(trial);
      const grid::Grid grid = grid_of(trial, frame);
      const auto assigner = row->make(assign::Params(row->params));
      assigner->build(grid);
      assign::Lists lists;
      assigner->assign({frame, view::lights_in(frame, frame.view_space)}, lists);
      changes += (lists.pair_count() > 0) != was_listed;
      was_listed = lists.pair_count() > 0;
    }
    checks.push_back({row->name + ": a light that leaves through far is dropped once", changes == 1,
                      std::to_string(changes) + " changes in 1001 steps of 1 mm"});
  }
  return checks;
}

std::vector<Trial> huge(std::uint64_t seed) {
  std::vector<Trial> trials;
  SplitMix64 random(seed);
  for (const double r : {1e4, 1e6}) {
    Rig rig;
    for (int i = 0; i < 40; ++i) {
      const double gap = 1.0 + 9.0 * random.unit(), z = 2.0 * random.unit() - 1.0, turn = 6.2831853 * random.unit();
      const double beside = std::sqrt(1.0 - z * z);
      rig.point((r + gap) * Vec3d(beside * std::cos(turn), beside * std::sin(turn), z), r);
    }
    rig.on_each(grids_of_every_kind(), "radius " + std::to_string(static_cast<int>(r)), trials);
    trials.push_back(rig.on(pixel_grid({32, 32}), "32 px tiles"));
  }
  return trials;
}

std::vector<Trial> tiny_and_endless(std::uint64_t seed) {
  std::vector<Trial> trials;
  SplitMix64 random(seed);
  Rig tiny, none, endless;
  for (int i = 0; i < 100; ++i) {
    const double depth = 0.2 + 60.0 * random.unit(), across = random.unit() - 0.5, up = random.unit() - 0.5;
    tiny.point({across * depth, up * depth, -depth}, 1e-4);
    none.point({across * depth, up * depth, -depth}, 0.0);
  }
  endless.point({0, 0, -30}, 20).point({5, 5, 200}, k_infinity);
  tiny.on_each(grids_of_every_kind(), "r = 1e-4", trials);
  none.point({0, 0, -30}, 20).on_each(grids_of_every_kind(), "r = 0", trials);
  endless.on_each(grids_of_every_kind(), "r = +inf", trials);
  return trials;
}

std::vector<ToolCheck> ranges_are_checked(std::uint64_t) {
  std::vector<ToolCheck> checks;
  const Trial tiny = Rig().point({0.3, 0.2, -10}, 1e-4).on(pixel_grid({64, 64}));
  const view::Frame frame = frame_of(tiny);
  const measure::Truth truth = measure::find_truth(frame, grid_of(tiny, frame), 1);
  checks.push_back({"a light of 0.1 mm reaches a cell", truth.lists.pair_count() >= 1,
                    std::to_string(truth.lists.pair_count()) + " pairs"});
  return checks;
}

}  // namespace

std::vector<HardCase> depth_cases() {
  return {{"H1", "lights on slice boundaries, and a few ulp beside", on_slice_boundaries, lookup_on_boundaries},
          {"H2", "lights tangent to cells: faces, edges, corners", tangent_to_everything, nullptr},
          {"H3", "the eye inside a light, at its centre, on its surface", around_the_eye, nullptr},
          {"H4", "centres behind the eye and beside it", behind_the_eye, nullptr},
          {"H5", "lights around near and in front of it", around_near, nullptr},
          {"H6", "a special first slice", in_the_first_slice, nullptr},
          {"H7", "lights around far; a sweep through it", around_far, far_sweep},
          {"H8", "huge lights with a small gap to the eye", huge, nullptr},
          {"H9", "tiny, empty and endless lights", tiny_and_endless, ranges_are_checked}};
}

}  // namespace clusterbench::stress
