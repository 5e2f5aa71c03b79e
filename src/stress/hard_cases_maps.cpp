// H33 to H35: cases found with other people's maps: lattices, their scales, clipped tiles.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "assign/contract/assigner.h"
#include "core/error.h"
#include "measure/truth/truth.h"
#include "stress/contact.h"
#include "stress/hard_cases.h"

namespace clusterbench::stress {
namespace {

using grid::Scheme;

int whole_between(SplitMix64& random, int least, int most) {
  return least + static_cast<int>(random.below(static_cast<std::uint64_t>(most - least) + 1));
}

// Lights at whole metres that end at the middle planes of the picture, or at their common line; each four times,
// mirrored. `off` moves them all.
Rig lattice_rig(std::uint64_t seed, int lights, const Vec3d& off) {
  SplitMix64 random(seed);
  Rig rig;
  for (int i = 0; i < lights; i += 4) {
    Vec3d position{0, 0, -whole_between(random, 1, 60)};
    const int axis = whole_between(random, 0, 1);
    position[axis] = whole_between(random, 1, 6);
    position[1 - axis] = whole_between(random, -12, 12);
    double range = position[axis];
    if (i % 32 == 0) {
      position = {3, 4, position.z};
      range = 5;
    }
    Vec3d towards(0.0);
    towards[axis] = -1.0;
    const double angle = whole_between(random, 1, 4) * 15 * k_degree;
    for (const double x : {1.0, -1.0})
      for (const double y : {1.0, -1.0}) {
        const Vec3d side{x, y, 1.0}, at = side * position + off;
        i % 20 == 16 ? rig.spot(at, side * towards, range, angle) : rig.point(at, range);
      }
  }
  return rig;
}

// The picture is 16:9 and 90 degrees high: rows of tiles begin at slopes like 3/4.
std::vector<grid::GridSpec> lattice_grids() {
  grid::GridSpec frustum = frustum_grid({16, 8}, Scheme::list, 0, 0.0, 0.0), distance, cascades, world;
  frustum.slices.boundaries_m = {1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 40, 50, 65};
  distance = frustum;
  distance.kind = grid::Kind::distance;
  cascades.kind = grid::Kind::cascades;
  cascades.cells = {12, 12, 12};
  cascades.levels = 4;
  cascades.finest_m = 1.0;
  world.kind = grid::Kind::world;
  world.cells = {24, 12, 32};
  world.has_bounds = true;
  world.bounds_lo_m = {-24, -12, -64};
  world.bounds_hi_m = {24, 12, 0};
  return {frustum, frustum_grid({16, 8}, Scheme::exponential, 24, 0.1, 400), distance, cascades, world};
}

std::vector<Trial> lattices(std::uint64_t seed) {
  constexpr int k_lights = 240;
  std::vector<Trial> trials;
  for (const double eighths : {0.0, 1.0, 2.0, 4.0}) {
    Rig rig = lattice_rig(seed, k_lights, Vec3d(0.0));
    rig.projection().yfov_rad = 90 * k_degree;
    rig.look({0, 0, eighths == 0.0 ? 0.0 : -20.0}, eighths * 45 * k_degree);
    rig.on_each(lattice_grids(), "turned by " + std::to_string(static_cast<int>(45 * eighths)) + " degrees", trials);
  }
  return trials;
}

// The same rig mirrored by swapping its lights: the lists must be mirrored, too.
ToolCheck mirrored_lists(std::uint64_t seed) {
  Rig rig = lattice_rig(seed, 240, Vec3d(0.0));
  rig.projection().yfov_rad = 90 * k_degree;
  const Trial trial = rig.on(lattice_grids()[0]);
  const view::Frame frame = frame_of(trial);
  const grid::Grid grid = grid_of(trial, frame);
  const assign::Lists lists = measure::find_truth(frame, grid, 1).lists;
  const Vec3i cells = grid.cells();
  std::uint64_t unlike = 0;
  for (std::uint32_t cell = 0; cell < grid.cell_count(); ++cell) {
    const Vec3i at = grid.cell_at(cell);
    const std::uint32_t beside = grid::cell_index({cells.x - 1 - at.x, at.y, at.z}, cells);
    unlike += lists.of(cell).size() != lists.of(beside).size();
  }
  return {"mirrored cells have as many lights of a mirrored rig", unlike == 0, std::to_string(unlike) + " have not"};
}

// The shortest of several: an interrupted frame of 50 us takes a hundred times as long.
double seconds_of(int times, const std::function<void()>& work) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < times; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    shortest = std::min(shortest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return shortest;
}
constexpr int k_times = 9;

// Times of one frame: the truth's and the exact methods' seconds.
struct FrameTimes {
  double truth = 0.0, exact = 0.0, exact_fast = 0.0;
};

double assign_seconds(const char* name, const grid::Grid& grid, const assign::FrameInput& input) {
  const assign::AssignerDescriptor& row = *assign::find_assigner(name);
  const auto assigner = row.make(assign::Params(row.params));
  assigner->build(grid);
  assign::Lists lists;
  assigner->assign(input, lists);
  return seconds_of(k_times, [&] { assigner->assign(input, lists); });
}

FrameTimes frame_times(std::uint64_t seed, const Vec3d& off) {
  constexpr int k_lights = 400;
  const Trial trial = lattice_rig(seed, k_lights, off).on(lattice_grids()[1]);
  const view::Frame frame = frame_of(trial);
  const grid::Grid grid = grid_of(trial, frame);
  const view::LightArrays lights = view::lights_in(frame, frame.view_space);
  FrameTimes times;
  times.truth = seconds_of(k_times / 3, [&] { static_cast<void>(measure::find_truth(frame, grid, 1)); });
  times.exact = assign_seconds("exact", grid, {frame, lights});
  times.exact_fast = assign_seconds("exact-fast", grid, {frame, lights});
  return times;
}

std::string ratio_text(double on, double off) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", off > 0.0 ? on / off : 0.0);
  return text;
}

// Figures, no gate: a loaded machine must not fail.
ToolCheck time_of_ties(std::uint64_t seed) {
  const FrameTimes on = frame_times(seed, Vec3d(0.0)), off = frame_times(seed, {0.013, 0.017, 0.011});
  return {"a frame on the lattice costs so many times the one moved off it (told, not judged)", true,
          "truth " + ratio_text(on.truth, off.truth) + ", exact " + ratio_text(on.exact, off.exact) + ", exact-fast " +
              ratio_text(on.exact_fast, off.exact_fast)};
}

std::vector<ToolCheck> lattice_checks(std::uint64_t seed) {
  return {mirrored_lists(seed), time_of_ties(seed)};
}

// Kilometres away with ranges of centimetres, cones of 1e-5 rad. Half of the lights touch a cell.
std::vector<Trial> far_and_small(std::uint64_t seed) {
  std::vector<Trial> trials;
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance}) {
    grid::GridSpec spec = frustum_grid({30, 17}, Scheme::exponential, 12, 1.0, 20000.0);
    spec.kind = kind;
    const Trial empty = Rig().on(spec);
    const grid::Grid grid = grid_of(empty, frame_of(empty));
    SplitMix64 random(seed);
    Rig rig;
    for (int i = 0; i < 120; ++i) {
      const auto cell = static_cast<std::uint32_t>(grid.cell_count() * 3 / 4 + random.below(grid.cell_count() / 4));
      const Contact contact = random_contact(grid.cell(cell), random);
      const double range = std::exp(random.between(std::log(0.002), std::log(2.0)));
      const Vec3d at = contact.point + (i % 2 == 0 ? 1.0 : random.between(0.0, 1.0)) * range * contact.outward;
      const Vec3d along = glm::normalize(glm::cross(contact.outward, Vec3d(0.3, 0.5, 0.8)));
      if (i % 3 == 0)
        rig.point(at, range);
      else
        rig.spot(at, i % 2 == 0 ? -contact.outward : along, range, i % 3 == 1 ? 1e-5 : random.between(0.01, 1.5));
    }
    trials.push_back(rig.on(spec, "centimetres at kilometres"));
  }
  return trials;
}

// Lights at the eye, in slices that begin there.
std::vector<Trial> from_zero_on() {
  std::vector<Trial> trials;
  for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance}) {
    grid::GridSpec spec = frustum_grid({12, 12}, Scheme::list, 0, 0.0, 0.0);
    spec.kind = kind;
    spec.slices.boundaries_m = {0, 1, 10, 100};
    Rig rig;
    for (const double distance : {1e-6, 1e-5, 1e-3, 1.0, 1e3, 1e6})
      for (const double excess : {-1e-9, 0.0, 2e-16, 2e-11, 2e-6, 1e-2}) {
        rig.point({0, 0, -distance}, distance * (1.0 + excess)).point({0, 0, distance}, distance * (1.0 + excess));
        rig.point({0.6 * distance, -0.8 * distance, 0}, distance * (1.0 + excess));
      }
    rig.spot({0, 0, 1e-5}, {0, 0, -1}, 1e-5, 0.3).spot({0, 0, -1e-5}, {0, 0, 1}, 1e-5 + 2e-11, 0.3);
    trials.push_back(rig.on(spec, "slices that begin at 0"));
  }
  return trials;
}

std::vector<Trial> map_scales(std::uint64_t seed) {
  std::vector<Trial> trials = far_and_small(seed);
  for (const Trial& trial : from_zero_on()) trials.push_back(trial);
  SplitMix64 random(seed);
  Rig small, many;
  for (int i = 0; i < 60; ++i) {
    const double x = random.between(-1e-4, 1e-4), y = random.between(-1e-4, 1e-4), z = random.between(-4e-4, 0.0);
    const double range = std::exp(random.between(std::log(1e-7), std::log(1e-4)));
    i % 4 == 3 ? small.spot({x, y, z}, {y, -x, z}, range, 0.01 + 0.02 * i) : small.point({x, y, z}, range);
    const double depth = random.between(0.5, 4000.0);
    many.point({0.3 * x * depth / 1e-4, 0.2 * y * depth / 1e-4, -depth}, range * 1e5);
  }
  small.projection().near_m = 1e-6;
  trials.push_back(small.on(frustum_grid({16, 9}, Scheme::exponential, 12, 1e-6, 5e-4), "micrometres"));
  grid::GridSpec thin = frustum_grid({4, 2}, Scheme::list, 0, 0.0, 0.0);
  for (int i = 0; i <= 4000; ++i) thin.slices.boundaries_m.push_back(i);
  trials.push_back(many.on(thin, "4,000 listed slices"));
  thin.kind = grid::Kind::distance;
  trials.push_back(many.on(thin, "4,000 listed shells"));
  return trials;
}

// More pairs than a list can count must be detected before memory is allocated for them.
std::vector<ToolCheck> too_many_pairs(std::uint64_t) {
  assign::PairBuffer pairs;
  constexpr std::uint32_t k_slices = 65'537, k_lights = 65'600;
  pairs.start(k_slices);
  std::string refusal;
  try {
    assign::Lists lists;
    for (std::uint32_t light = 0; light < k_lights; ++light) pairs.add_row(0, k_slices, light);
    pairs.finish(lists);
  } catch (const Error& error) {
    refusal = error.what();
  }
  return {{"65,600 lights in 65,537 slices are more pairs than lists can hold, and are refused", !refusal.empty(),
           refusal}};
}

Rig beside_the_picture(double right, double top, bool orthographic, std::uint64_t seed) {
  SplitMix64 random(seed);
  Rig rig;
  for (int i = 0; i < 160; ++i) {
    const double depth = random.between(0.5, 90.0), scale = orthographic ? 1.0 : depth;
    const double beyond = 1.0 + std::exp(random.between(std::log(1e-3), std::log(2.0)));
    const double along = random.between(-1.3, 1.3);
    const bool is_column = i % 2 == 0;
    const Vec3d side = is_column ? Vec3d(beyond, along, 0) : Vec3d(along, -beyond, 0);
    const Vec3d position{side.x * right * scale, side.y * top * scale, -depth};
    // From the side of the picture, along the perspective's lean or straight, to the centre.
    const double gap = is_column ? (beyond - 1.0) * right * scale : (beyond - 1.0) * top * scale;
    const double lean = orthographic ? 1.0 : std::sqrt(1.0 + (is_column ? right * right : top * top));
    rig.point(position, gap / lean * (1.0 + (i % 4 < 2 ? 1e-6 : random.between(-1e-5, 0.1))));
    if (i % 5 == 0) rig.spot(position, {-side.x, -side.y, 0.1}, gap / lean * 1.2, 0.4);
  }
  return rig;
}

std::vector<Trial> clipped_tiles(std::uint64_t seed) {
  std::vector<Trial> trials;
  const double top = std::tan(30.0 * k_degree);
  for (const Vec2i& tile : {Vec2i{64, 64}, Vec2i{97, 101}, Vec2i{333, 213}}) {
    const std::string label = std::to_string(tile.x) + " pixels";
    grid::GridSpec spec = pixel_grid(tile);
    spec.slices.far_m = 100.0;
    Rig perspective = beside_the_picture(top * 1000 / 640, top, false, seed);
    perspective.show({1000, 640});
    trials.push_back(perspective.on(spec, label));
    spec.kind = grid::Kind::distance;
    trials.push_back(perspective.on(spec, label));

    Rig parallel = beside_the_picture(5.0, 3.2, true, seed);
    // The lost light that was found first, seen from the camera at (5, 3.2, 0).
    parallel.point({9.0, -0.67, -5.1}, 3.99999).show({1000, 640});
    parallel.projection() = {};
    parallel.projection().orthographic = true;
    parallel.projection().xmag_m = 5.0;
    parallel.projection().ymag_m = 3.2;
    parallel.projection().near_m = 0.0;
    parallel.projection().far_m = 100.0;
    grid::GridSpec linear = frustum_grid({0, 0}, Scheme::linear, 10, 0.0, 100.0);
    linear.tiles = {tile, {0, 0}};
    trials.push_back(parallel.on(linear, label + ", orthographic"));
  }
  return trials;
}

}  // namespace

std::vector<HardCase> map_cases() {
  return {{"H33", "lights on a lattice: ties by the thousand", lattices, lattice_checks},
          {"H34", "scales that maps have: kilometres and centimetres, slices from 0 on, thousands of slices",
           map_scales, too_many_pairs},
          {"H35", "lights beside the picture, whose last tiles are clipped", clipped_tiles, nullptr}};
}

}  // namespace clusterbench::stress
