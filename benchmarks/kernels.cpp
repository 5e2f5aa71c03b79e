// What the scalar predicates, the building of lists by scattering and their storage cost each, apart from any method.
// Items per second are predicate calls or pairs.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>

#include "assign/contract/lists.h"
#include "assign/contract/storage.h"
#include "core/random.h"
#include "geom/projection/disk_tangents.h"
#include "geom/single_precision/bounding_volumes.h"
#include "geom/single_precision/plane.h"
#include "geom/single_precision/touch_tests.h"

namespace clusterbench {
namespace {

// Small enough to stay in the first-level cache, large enough that branches cannot be learnt.
constexpr std::size_t k_inputs = 1024;

float between(SplitMix64& random, double lo, double hi) {
  return static_cast<float>(random.between(lo, hi));
}

struct Inputs {
  std::vector<geom::Ball> balls;
  std::vector<geom::SphericalCone> cones;
  std::vector<geom::FrustumCell> cells;
  std::vector<geom::Box> boxes;
  std::vector<geom::Ball> cell_balls;
  std::vector<geom::Plane> planes;  // six per cell
};

geom::SphericalCone random_cone(SplitMix64& random, const geom::Ball& ball) {
  const Vec3f direction{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1) - 1.5f};
  const float angle = between(random, 0.1, 1.2);
  return {ball.center, ball.radius, direction / std::sqrt(glm::dot(direction, direction)), std::cos(angle),
          std::sin(angle)};
}

geom::FrustumCell random_cell(SplitMix64& random) {
  const float x = between(random, -1, 0.9), y = between(random, -0.6, 0.5), depth = between(random, 1, 60);
  return {x, x + 0.06f, y, y + 0.07f, depth, depth * 1.5f, false};
}

// Cells and lights of metres to tens of metres in the first 90 m of a view: about as many hits as misses near by.
Inputs random_inputs() {
  SplitMix64 random(1);
  Inputs inputs;
  for (std::size_t i = 0; i < k_inputs; ++i) {
    const geom::FrustumCell cell = random_cell(random);
    const geom::Ball around = geom::ball_around(cell);
    const float reach = around.radius + between(random, 0.5, 15);
    const Vec3f offset{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    inputs.cells.push_back(cell);
    inputs.boxes.push_back(geom::box_around(cell));
    inputs.cell_balls.push_back(around);
    inputs.balls.push_back({around.center + reach * offset, reach - around.radius});
    inputs.cones.push_back(random_cone(random, inputs.balls.back()));
    geom::Plane planes[6];
    geom::outward_planes(cell, planes);
    inputs.planes.insert(inputs.planes.end(), std::begin(planes), std::end(planes));
  }
  return inputs;
}

template <class Kernel>
void for_each_input(benchmark::State& state, Kernel&& kernel) {
  const Inputs inputs = random_inputs();
  for (auto _ : state)
    for (std::size_t i = 0; i < k_inputs; ++i) benchmark::DoNotOptimize(kernel(inputs, i));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k_inputs));
}

void ball_touches_box(benchmark::State& state) {
  for_each_input(state,
                 [](const Inputs& in, std::size_t i) { return geom::ball_touches_box(in.balls[i], in.boxes[i]); });
}
BENCHMARK(ball_touches_box)->Name("kernel/scalar/ball_touches_box");

void ball_touches_planes(benchmark::State& state) {
  for_each_input(state, [](const Inputs& in, std::size_t i) {
    return geom::ball_touches_planes(in.balls[i], &in.planes[6 * i], 6);
  });
}
BENCHMARK(ball_touches_planes)->Name("kernel/scalar/ball_touches_planes");

void cone_touches_ball(benchmark::State& state) {
  for_each_input(
      state, [](const Inputs& in, std::size_t i) { return geom::cone_touches_ball(in.cones[i], in.cell_balls[i]); });
}
BENCHMARK(cone_touches_ball)->Name("kernel/scalar/cone_touches_ball");

void bounding_ball(benchmark::State& state) {
  for_each_input(state, [](const Inputs& in, std::size_t i) { return geom::bounding_ball(in.cones[i]); });
}
BENCHMARK(bounding_ball)->Name("kernel/scalar/bounding_ball");

void slope_range(benchmark::State& state) {
  for_each_input(state, [](const Inputs& in, std::size_t i) {
    const geom::Ball& ball = in.balls[i];
    return geom::slope_range(ball.center.x, -ball.center.z, ball.radius, 0.1f, 500.0f);
  });
}
BENCHMARK(slope_range)->Name("kernel/scalar/slope_range");

void box_around(benchmark::State& state) {
  for_each_input(state, [](const Inputs& in, std::size_t i) { return geom::box_around(in.cells[i]); });
}
BENCHMARK(box_around)->Name("kernel/scalar/box_around");

void ball_around(benchmark::State& state) {
  for_each_input(state, [](const Inputs& in, std::size_t i) { return geom::ball_around(in.cells[i]); });
}
BENCHMARK(ball_around)->Name("kernel/scalar/ball_around");

// --- Lists: 500 lights on 30 x 17 x 16 cells, `row_length` cells side by side per light and row ---

constexpr Vec3i k_cells{30, 17, 16};
constexpr std::uint32_t k_lights = 500;

std::uint32_t cell_total() {
  return static_cast<std::uint32_t>(k_cells.x * k_cells.y * k_cells.z);
}

struct Row {
  std::uint32_t first_cell, light;
};

std::vector<Row> random_rows(std::uint32_t row_length) {
  SplitMix64 random(2);
  std::vector<Row> rows;
  const auto row_count = static_cast<std::uint64_t>(k_cells.y * k_cells.z);
  for (std::uint32_t light = 0; light < k_lights; ++light) {
    const std::uint64_t first_row = random.below(row_count - 24);
    const auto x = static_cast<std::uint32_t>(random.below(static_cast<std::uint64_t>(k_cells.x) - row_length + 1));
    for (std::uint64_t row = first_row; row < first_row + 24; ++row)
      rows.push_back({static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(k_cells.x) + x, light});
  }
  return rows;
}

void count_pairs(benchmark::State& state, const assign::Lists& lists) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(lists.pair_count()));
}

void lists_by_cell(benchmark::State& state) {
  const auto length = static_cast<std::uint32_t>(state.range(0));
  const std::vector<Row> rows = random_rows(length);
  assign::PairBuffer pairs;
  assign::Lists lists;
  for (auto _ : state) {
    pairs.start(cell_total());
    for (const Row& row : rows)
      for (std::uint32_t cell = row.first_cell; cell < row.first_cell + length; ++cell) pairs.add(cell, row.light);
    pairs.finish(lists);
    benchmark::DoNotOptimize(lists.lights.data());
  }
  count_pairs(state, lists);
}
BENCHMARK(lists_by_cell)->Name("kernel/scalar/lists_by_cell")->Arg(1)->Arg(4)->Arg(16);

void lists_by_row(benchmark::State& state) {
  const auto length = static_cast<std::uint32_t>(state.range(0));
  const std::vector<Row> rows = random_rows(length);
  assign::PairBuffer pairs;
  assign::Lists lists;
  for (auto _ : state) {
    pairs.start(cell_total());
    for (const Row& row : rows) pairs.add_row(row.first_cell, length, row.light);
    pairs.finish(lists);
    benchmark::DoNotOptimize(lists.lights.data());
  }
  count_pairs(state, lists);
}
BENCHMARK(lists_by_row)->Name("kernel/scalar/lists_by_row")->Arg(1)->Arg(4)->Arg(16);

assign::Lists random_lists() {
  assign::PairBuffer pairs;
  assign::Lists lists;
  pairs.start(cell_total());
  for (const Row& row : random_rows(8)) pairs.add_row(row.first_cell, 8, row.light);
  pairs.finish(lists);
  return lists;
}

void store(benchmark::State& state, const char* name) {
  const assign::StorageDescriptor* row = assign::find_storage(name);
  const auto storage = row->make(assign::Params(row->params));
  const assign::Lists lists = random_lists();
  storage->start(cell_total(), {k_lights, 0});
  for (auto _ : state) {
    storage->store(lists);
    benchmark::ClobberMemory();
  }
  count_pairs(state, lists);
}
BENCHMARK_CAPTURE(store, packed, "packed");
BENCHMARK_CAPTURE(store, fixed, "fixed");
BENCHMARK_CAPTURE(store, bitfield, "bitfield");

// The floor under storing: the same lists copied once.
void copy_lists(benchmark::State& state) {
  const assign::Lists lists = random_lists();
  assign::Lists copy = lists;
  for (auto _ : state) {
    std::memcpy(copy.begin.data(), lists.begin.data(), lists.begin.size() * sizeof(std::uint32_t));
    std::memcpy(copy.lights.data(), lists.lights.data(), lists.lights.size() * sizeof(std::uint32_t));
    benchmark::ClobberMemory();
  }
  count_pairs(state, lists);
}
BENCHMARK(copy_lists);

}  // namespace
}  // namespace clusterbench
