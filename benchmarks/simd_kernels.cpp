// Every SIMD kernel on every instruction set that this machine has: kernel/TARGET/NAME. On our own scenes (64 px tiles
// at 1920 x 1080, 16 slices); lists also on W1's lights of CLUSTERBENCH_SCENE_LIBRARY, on its grid, with a range of
// 60 m, where lists are long.
//
// `floor`: the time by that of copying what was written once, both taken in turn.

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

#include "assign/bounds/bounds_rows.h"
#include "assign/box_grid/box_levels.h"
#include "assign/box_grid/box_ranges.h"
#include "assign/cone/bounding_spheres.h"
#include "assign/cone/spot_rows.h"
#include "assign/contract/assigner.h"
#include "assign/distance/shell_rows.h"
#include "assign/exact/exact_frame.h"
#include "assign/grid_cull/slice_bins.h"
#include "assign/lists/list_builder.h"
#include "assign/lists/row_lists.h"
#include "assign/rows/slice_rows.h"
#include "assign/storages/list_encodings.h"
#include "benchmarks.h"
#include "geom/single_precision/bounding_volumes.h"
#include "setting.h"

namespace clusterbench {
namespace {

using benchmark::State;

void use_target(std::int64_t target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().DeInit();
}

void items(State& state, std::uint64_t per_iteration) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(per_iteration));
}

grid::GridSpec spec() {
  grid::GridSpec spec;
  spec.slices.near_m = 0.1;
  spec.slices.far_m = 500.0;
  return spec;
}

grid::GridSpec kind_spec(grid::Kind kind) {
  grid::GridSpec of_kind = spec();
  of_kind.kind = kind;
  return of_kind;
}

Setting hall() {
  return make_setting(own_scene("hall-512"), spec(), 0.5);
}
Setting open_world() {
  return make_setting(own_scene("open-world"), spec(), 0.5);
}

// --- Lights ---

assign::VisibleBalls visible_in(const Setting& setting, const assign::RowPlanes& planes) {
  assign::VisibleBalls visible;
  visible.reserve(setting.lights.size());
  assign::cull_balls(planes, assign::given_points(setting.lights), visible);
  return visible;
}

void cull_balls(State& state) {
  const Setting setting = hall();
  const assign::RowPlanes planes(setting.grid.screen());
  assign::VisibleBalls visible = visible_in(setting, planes);
  for (auto _ : state) {
    visible.count = 0;
    assign::cull_balls(planes, assign::given_points(setting.lights), visible);
    benchmark::ClobberMemory();
  }
  items(state, setting.lights.points.count);
}

void find_screen_bounds(State& state) {
  const Setting setting = hall();
  const assign::RowPlanes planes(setting.grid.screen());
  const assign::BoxPlanes box_planes(setting.grid.screen());
  const assign::VisibleBalls visible = visible_in(setting, planes);
  assign::BoundedBalls bounded;
  bounded.reserve(setting.lights.size());
  for (auto _ : state) {
    bounded.count = 0;
    assign::find_screen_bounds(box_planes, visible, 0, assign::given_points(setting.lights), {8.0f, 8.0f}, bounded);
    benchmark::ClobberMemory();
  }
  items(state, visible.count);
}

void find_box_ranges(State& state) {
  const Setting setting = make_setting(own_scene("hall-512"), kind_spec(grid::Kind::world), 0.5);
  const assign::RangeAxes axes(assign::box_levels(setting.grid).front());
  assign::BoundedBalls bounded;
  bounded.reserve(setting.lights.size());
  for (auto _ : state) {
    bounded.count = 0;
    assign::find_box_ranges(axes, assign::given_points(setting.lights), 8.0f, bounded);
    benchmark::ClobberMemory();
  }
  items(state, setting.lights.points.count);
}

void find_shells(State& state) {
  const Setting setting = make_setting(own_scene("hall-512"), kind_spec(grid::Kind::distance), 0.5);
  const assign::ShellPlanes planes(setting.grid.screen());
  assign::BoundedBalls bounded;
  bounded.reserve(setting.lights.size());
  for (auto _ : state) {
    bounded.count = 0;
    assign::find_shells(planes, assign::given_points(setting.lights), 8.0f, bounded);
    benchmark::ClobberMemory();
  }
  items(state, setting.lights.points.count);
}

void find_spot_balls(State& state) {
  const Setting setting = open_world();
  assign::BallArrays balls;
  for (auto _ : state) {
    assign::find_spot_balls(setting.lights, view::k_given_roundoffs, true, balls);
    benchmark::ClobberMemory();
  }
  items(state, setting.lights.spots.count);
}

// --- Rows: items are rows of single balls ---

// Calls find(slice, balls, count) for every `most` balls of a slice; it returns how many rows it looked at.
template <class Find>
void each_batch(State& state, const assign::SliceBins& balls, int slices, std::uint32_t most, Find&& find) {
  std::uint64_t tests = 0;
  for (auto _ : state) {
    tests = 0;
    for (int slice = 0; slice < slices; ++slice) {
      const std::span<const std::uint32_t> all = balls.of(slice);
      for (std::uint32_t begin = 0; begin < all.size(); begin += most)
        tests += find(slice, all.data() + begin, std::min(most, static_cast<std::uint32_t>(all.size()) - begin));
    }
    benchmark::ClobberMemory();
  }
  items(state, tests);
}

void find_rows(State& state) {
  const Setting setting = hall();
  const assign::RowPlanes planes(setting.grid.screen());
  const assign::VisibleBalls visible = visible_in(setting, planes);
  assign::SphereSetup shapes;
  assign::set_up_spheres(visible, visible.count, shapes);
  assign::SliceBins balls;
  balls.sort(visible, planes.slices);
  const assign::ExactFrame frame{setting.grid, planes, setting.lights, visible, visible.count, shapes, balls};
  assign::BatchReader batches;
  std::uint64_t tests = 0;
  for (auto _ : state) {
    tests = 0;
    batches.start(frame, 0, planes.slices);
    for (int slice = 0; slice < planes.slices; ++slice)
      while (const assign::BatchSpans* batch = batches.next(slice)) tests += batch->tests;
    benchmark::ClobberMemory();
  }
  items(state, tests);
}

// Calls find(batch, rows) for every batch of balls with their cell boxes.
template <class Find>
void bounds_rows(State& state, const Setting& setting, Find&& find) {
  const assign::RowPlanes planes(setting.grid.screen());
  const assign::VisibleBalls visible = visible_in(setting, planes);
  assign::BoundedBalls bounded;
  bounded.reserve(setting.lights.size());
  assign::find_screen_bounds(assign::BoxPlanes(setting.grid.screen()), visible, 0, assign::given_points(setting.lights),
                             {8.0f, 8.0f}, bounded);
  assign::SliceBins balls;
  balls.sort(bounded, planes.slices);
  assign::BatchRows rows;
  each_batch(state, balls, planes.slices, assign::balls_per_batch(),
             [&](int slice, const std::uint32_t* batch, std::uint32_t count) {
               find(assign::BallBatch{bounded, slice, batch, count, setting.lights.size()}, rows);
               return rows.tests;
             });
}

void find_bounds_rows(State& state) {
  const Setting setting = hall();
  const int rows = setting.grid.cells().y;
  bounds_rows(state, setting, [&](const assign::BallBatch& batch, assign::BatchRows& out) {
    assign::find_bounds_rows(rows, batch, out);
  });
}

void find_refined_rows(State& state) {
  const Setting setting = hall();
  const assign::RefinementPlanes planes(setting.grid.screen());
  assign::LaneColumns columns;
  bounds_rows(state, setting, [&](const assign::BallBatch& batch, assign::BatchRows& out) {
    assign::find_refined_rows(planes, batch, columns, out);
  });
}

void find_box_rows(State& state) {
  const Setting setting = hall();
  const assign::CellExtents cells = assign::cell_extents(setting.grid);
  assign::LaneColumns columns;
  bounds_rows(state, setting, [&](const assign::BallBatch& batch, assign::BatchRows& out) {
    assign::find_box_rows(cells, batch, columns, out);
  });
}

void find_shell_rows(State& state) {
  const Setting setting = make_setting(own_scene("hall-512"), kind_spec(grid::Kind::distance), 0.5);
  const assign::ShellPlanes planes(setting.grid.screen());
  assign::BoundedBalls bounded;
  bounded.reserve(setting.lights.size());
  assign::find_shells(planes, assign::given_points(setting.lights), 8.0f, bounded);
  assign::SliceBins balls;
  balls.sort(bounded, setting.grid.cells().z);
  assign::BatchRows rows;
  each_batch(state, balls, setting.grid.cells().z, assign::balls_per_batch(),
             [&](int slice, const std::uint32_t* batch, std::uint32_t count) {
               assign::find_shell_rows(planes, {bounded, slice, batch, count, setting.lights.size()}, rows);
               return rows.tests;
             });
}

// Of all spots in the slices that their balls reach.
void find_spot_rows(State& state) {
  const Setting setting = open_world();
  const assign::RowPlanes planes(setting.grid.screen());
  assign::BallArrays around;
  assign::find_spot_balls(setting.lights, view::k_given_roundoffs, true, around);
  assign::VisibleBalls visible;
  visible.reserve(setting.lights.spots.count);
  assign::cull_balls(planes, assign::given_spots(setting.lights, around), visible);
  assign::SliceBins balls;
  balls.sort(visible, planes.slices);
  assign::SpotSlices slices;
  for (int slice = 0; slice < planes.slices; ++slice)
    for (const std::uint32_t place : balls.of(slice))
      slices.add(visible.light[place] - setting.lights.spots.first, static_cast<std::uint32_t>(slice));
  assign::SpotRows rows;
  for (auto _ : state) {
    assign::find_spot_rows(setting.lights, planes, slices, rows);
    benchmark::ClobberMemory();
  }
  items(state, rows.count);
}

// --- Spots: items are pairs of a spot and a cell ---

// The cells of a slice in the middle of the view, for each spot.
assign::SpotCells some_spot_cells(const Setting& setting, int slice) {
  assign::SpotCells cells;
  const Vec3i size = setting.grid.cells();
  for (std::uint32_t spot = 0; spot < setting.lights.spots.count; ++spot) {
    const view::LightArrays& lights = setting.lights;
    const std::uint32_t light = lights.spots.first + spot;
    const float depth = -lights.z[light];
    if (depth + lights.radius[light] < setting.grid.screen().slices.boundaries[static_cast<std::size_t>(slice)])
      continue;
    for (int row = size.y / 3; row < 2 * size.y / 3; ++row)
      for (int column = size.x / 3; column < 2 * size.x / 3; ++column)
        cells.add({spot, static_cast<std::uint32_t>(slice), static_cast<std::uint32_t>(row),
                   static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(column) + 1});
  }
  return cells;
}

void filter_spot_cells(State& state) {
  constexpr int k_slice = 10;
  const Setting setting = open_world();
  const assign::RowPlanes planes(setting.grid.screen());
  assign::SpotCells cells = some_spot_cells(setting, k_slice);
  for (auto _ : state) {
    assign::filter_spot_cells(setting.lights, planes, cells);
    benchmark::ClobberMemory();
  }
  items(state, cells.count);
}

// Every spot against a row of cells in each slice.
void find_touched_cells(State& state) {
  const Setting setting = open_world();
  const Vec3i size = setting.grid.cells();
  std::vector<geom::Ball> balls;
  for (std::uint32_t cell = 0; cell < setting.grid.cell_count(); ++cell)
    balls.push_back(geom::ball_around(std::get<geom::FrustumCell>(setting.grid.cell(cell))));
  const assign::CellBalls cells{balls};
  const auto columns = static_cast<std::uint32_t>(std::min(size.x, 64)), row = static_cast<std::uint32_t>(size.y / 2);
  std::vector<assign::CellRun> runs;
  for (int slice = 0; slice < size.z; ++slice)
    runs.push_back({row, 0, static_cast<std::uint32_t>((slice * size.y + size.y / 2) * size.x), columns});
  std::vector<std::uint64_t> lit;
  for (auto _ : state)
    for (std::uint32_t spot = setting.lights.spots.first; spot < setting.lights.size(); ++spot) {
      assign::find_touched_cells(setting.lights.cone(spot, 8.0f), cells, runs, lit);
      benchmark::ClobberMemory();
    }
  items(state, std::uint64_t{setting.lights.spots.count} * runs.size() * columns);
}

// --- Lists: items are pairs ---

struct Span {
  std::uint32_t row, first, last, light;
};

// A frame's true lists and the spans that make them, row by row.
struct FrameLists {
  std::uint32_t rows = 0, columns = 0, lights = 0;
  assign::Lists lists;
  std::vector<Span> spans;
};

void add_spans(FrameLists& frame, std::uint32_t row) {
  std::vector<Span> of_light(frame.lights, Span{row, 1, 0, 0});
  for (std::uint32_t column = 0; column < frame.columns; ++column)
    for (const std::uint32_t light : frame.lists.of(row * frame.columns + column)) {
      Span& span = of_light[light];
      if (span.first > span.last) span = {row, column, column, light};
      span.last = column;
    }
  for (const Span& span : of_light)
    if (span.first <= span.last) frame.spans.push_back(span);
}

// Of the lights below `most_lights`.
FrameLists frame_lists(const Setting& setting, std::uint32_t most_lights) {
  const Vec3i cells = setting.grid.cells();
  FrameLists frame{static_cast<std::uint32_t>(cells.y * cells.z),
                   static_cast<std::uint32_t>(cells.x),
                   std::min(most_lights, setting.lights.size()),
                   {},
                   {}};
  const assign::AssignerDescriptor& row = *assign::find_assigner("exact-fast");
  const auto assigner = row.make(assign::Params(row.params));
  assign::Lists all;
  assigner->build(setting.grid);
  assigner->assign({setting.frame, setting.lights}, all);
  frame.lists.begin.push_back(0);
  for (std::uint32_t cell = 0; cell < all.cell_count(); ++cell) {
    for (const std::uint32_t light : all.of(cell))
      if (light < frame.lights) frame.lists.lights.push_back(light);
    frame.lists.begin.push_back(frame.lists.pair_count());
  }
  for (std::uint32_t r = 0; r < frame.rows; ++r) add_spans(frame, r);
  return frame;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Times write() beside copying as many bytes.
template <class Write>
void against_copy(State& state, std::size_t bytes, std::uint64_t pairs, Write&& write) {
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  std::vector<double> writing, copying;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    write();
    benchmark::ClobberMemory();
    writing.push_back(seconds_since(start));
    state.SetIterationTime(writing.back());
    const auto copy_start = std::chrono::steady_clock::now();
    if (bytes > 0) std::memcpy(to.data(), from.data(), bytes);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
    copying.push_back(seconds_since(copy_start));
  }
  items(state, pairs);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
  state.counters["floor"] = median(writing) / median(copying);
  state.counters["pairs"] = static_cast<double>(pairs);
}

void span_lists(State& state, const FrameLists& frame) {
  assign::ListBuilder builder;
  assign::Lists lists;
  const std::size_t bytes = (frame.lists.begin.size() + frame.lists.lights.size()) * sizeof(std::uint32_t);
  against_copy(state, bytes, frame.lists.pair_count(), [&] {
    builder.start(1, frame.rows, frame.columns, lists);
    for (const Span& span : frame.spans) builder.add(span.row, span.first, span.last, span.light);
    builder.finish_band();
    builder.finish();
  });
}

// All rows' spans side by side, with room to read beyond the last.
struct SpanArrays {
  std::vector<std::uint32_t> lights, spans, sizes;  // sizes: of each row
  std::uint32_t columns, width;

  explicit SpanArrays(const FrameLists& frame)
      : sizes(frame.rows, 0),
        columns(frame.columns),
        width(static_cast<std::uint32_t>(frame.lists.pair_count() / std::max<std::size_t>(1, frame.spans.size()))) {
    for (const Span& span : frame.spans) {
      lights.push_back(span.light);
      spans.push_back(assign::ColumnSpan::of(span.first, span.last));
      ++sizes[span.row];
    }
    lights.resize(lights.size() + assign::k_most_lanes);
    spans.resize(lights.size());
  }
};

// Each row a band of its own.
void row_lists(State& state, const FrameLists& frame) {
  SpanArrays spans(frame);
  assign::FewColumns few;
  std::vector<std::uint32_t> lights(frame.lists.pair_count() + assign::k_most_lanes);
  std::vector<std::uint32_t> begin(frame.lists.begin.size());
  const std::size_t bytes = (begin.size() + frame.lists.pair_count()) * sizeof(std::uint32_t);
  against_copy(state, bytes, frame.lists.pair_count(), [&] {
    std::uint32_t* to = lights.data();
    assign::BandSpans band{spans.sizes.data(), spans.spans.data(), spans.lights.data(), 0, 1,
                           spans.columns,      spans.width};
    for (std::size_t row = 0; row < frame.rows; ++row) {
      to = assign::write_band_lists(band, {}, few, to, lights.data(), begin.data() + row * frame.columns);
      band.columns += *band.sizes;
      band.lights += *band.sizes++;
    }
  });
}

std::uint32_t words_per_cell(const FrameLists& frame) {
  return (frame.lights + 31) / 32;
}

template <class Index>
void narrow(State& state, const FrameLists& frame) {
  const std::vector<std::uint32_t>& lights = frame.lists.lights;
  std::vector<Index> slim(lights.size());
  against_copy(state, slim.size() * sizeof(Index), slim.size(),
               [&] { assign::narrow(lights.data(), lights.size(), slim.data()); });
}

void write_bits(State& state, const FrameLists& frame) {
  std::vector<std::uint32_t> words(std::size_t{frame.lists.cell_count()} * words_per_cell(frame));
  against_copy(state, words.size() * sizeof(std::uint32_t), frame.lists.pair_count(),
               [&] { assign::write_bits(frame.lists, words_per_cell(frame), words.data()); });
}

// --- Registration ---

struct Kernel {
  const char* name;
  void (*run)(State&);
};

constexpr Kernel k_kernels[] = {
    {"cull_balls", cull_balls},
    {"find_screen_bounds", find_screen_bounds},
    {"find_box_ranges", find_box_ranges},
    {"find_shells", find_shells},
    {"find_spot_balls", find_spot_balls},
    {"find_rows", find_rows},
    {"find_bounds_rows", find_bounds_rows},
    {"find_refined_rows", find_refined_rows},
    {"find_box_rows", find_box_rows},
    {"find_shell_rows", find_shell_rows},
    {"find_spot_rows", find_spot_rows},
    {"filter_spot_cells", filter_spot_cells},
    {"find_touched_cells", find_touched_cells},
};

struct ListKernel {
  const char* name;
  void (*run)(State&, const FrameLists&);
  std::uint32_t most_lights = std::numeric_limits<std::uint32_t>::max();
};

constexpr ListKernel k_list_kernels[] = {
    {"span_lists", span_lists},           {"row_lists", row_lists},   {"narrow_8", narrow<std::uint8_t>, 256},
    {"narrow_16", narrow<std::uint16_t>}, {"write_bits", write_bits},
};

struct ListScene {
  std::string name, file;
  grid::GridSpec spec;
  float range_m;
};

grid::GridSpec w1_spec() {
  grid::GridSpec spec;
  spec.tiles = {{0, 0}, {12, 12}};
  spec.slices = {.scheme = grid::Scheme::exponential, .count = 24, .near_m = 0.1, .far_m = 400, .boundaries_m = {}};
  return spec;
}

void register_for(std::int64_t target, const std::string& prefix) {
  const auto add = [&](const std::string& name, const std::function<void(State&)>& run) {
    return benchmark::RegisterBenchmark((prefix + name).c_str(), [=](State& state) {
      use_target(target);
      run(state);
      use_target(0);
    });
  };
  for (const Kernel& kernel : k_kernels) add(kernel.name, kernel.run);
  std::vector<ListScene> scenes{{"hall-512", own_scene("hall-512"), spec(), 0.0f},
                                {"jam", own_scene("jam"), spec(), 0.0f}};
  scenes.push_back({"W1-60m", peer_workload("W1"), w1_spec(), 60.0f});
  for (const ListKernel& kernel : k_list_kernels)
    for (const ListScene& scene : scenes)
      add(std::string(kernel.name) + "/" + scene.name, [=](State& state) {
        kernel.run(state, frame_lists(make_setting(scene.file, scene.spec, 0.5, scene.range_m), kernel.most_lights));
      })->UseManualTime();
}

}  // namespace

void register_simd_kernels() {
  std::set<std::string> registered;
  for (std::int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
    use_target(left & -left);
    const std::string name = assign::simd_target_name();
    use_target(0);
    if (registered.insert(name).second) register_for(left & -left, "kernel/" + name + "/");
  }
}

}  // namespace clusterbench
