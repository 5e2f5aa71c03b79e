// Counts that multiply are refused before memory is taken, whatever method would have taken it.

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/contract/storage.h"
#include "assign/dense_check.h"
#include "assign/lists/list_builder.h"
#include "assign/rows/slice_rows.h"
#include "core/error.h"
#include "core/memory.h"

namespace clusterbench::assign {
namespace {

constexpr std::uint64_t k_mib = std::uint64_t{1} << 20;

// So many slices in one tile, and so many points or spots that reach all of them.
struct LongTile {
  view::Frame frame;
  grid::Grid grid;

  LongTile(int slices, int lights, bool spots) {
    grid::GridSpec spec;
    spec.tiles = {{0, 0}, {1, 1}};
    spec.slices.scheme = grid::Scheme::list;
    for (int i = 0; i <= slices; ++i) spec.slices.boundaries_m.push_back(1.0 + 0.001 * i);
    const scene::WorldLight point = testing::point_light({0, 0, -2}, 5000);
    const scene::WorldLight spot = testing::spot_light({0, 0, 1000}, 5000, {0, 0, -1}, 0.5);
    frame = testing::frame_of(testing::perspective(1.0, 1.0, 0.1, 100), {64, 64},
                              std::vector<scene::WorldLight>(static_cast<std::size_t>(lights), spots ? spot : point));
    grid = testing::grid_of(spec, frame);
  }
};

// What the error says, "" if there is none. A method that keeps some lights in a cell keeps as many as it can be asked
// to.
std::string refusal(const std::string& assigner, const LongTile& tile) {
  std::map<std::string, ParamValue> params;
  for (const ParamSpec& spec : find_assigner(assigner)->params)
    if (spec.name == "most") params[spec.name] = spec.max;
  try {
    testing::lists_by(assigner, tile.frame, tile.grid, params);
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "limits.memory_mib") << error.what();
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.message();
  }
  return "";
}

TEST(Memory, of_lights_times_slices_beyond_32_bits_is_refused_before_it_is_taken) {
  const LongTile tile(65'536, 65'600, false);
  for (const char* assigner : {"exact-fast", "bounds-fast"})
    EXPECT_NE(refusal(assigner, tile).find("4299161"), std::string::npos) << assigner << refusal(assigner, tile);
}

TEST(Memory, of_every_method_is_bounded_by_the_limit_and_no_more_is_asked_of_small_frames) {
  const MemoryLimitScope little(4 * k_mib);
  for (const bool spots : {false, true}) {
    const LongTile small(100, 10, spots), large(1500, 1500, spots);
    for (const AssignerDescriptor* row : assigner_descriptors()) {
      if (!row->takes(grid::Kind::frustum) || row->needs.depth)
        continue;  // a tile has one list, of 1500 lights at most
      if (answers_with_cells(*row, Params(row->params)).empty()) continue;
      EXPECT_EQ(refusal(row->name, small), "") << row->name;
      EXPECT_NE(refusal(row->name, large).find("and 4 MiB are allowed"), std::string::npos)
          << row->name << (spots ? ", spots" : ", points");
    }
  }
}

// What a method that fills lists throws where it is given lists as large as these to fill; "" if nothing.
std::string refusal_in(const AssignerDescriptor& row, const LongTile& tile, std::size_t lists) {
  AssignerRun run(row, Params(row.params), Answer::lists);
  Lists given;
  given.lights.resize(lists);
  run.use_memory_of(std::move(given));
  const view::LightArrays lights = view::lights_in(tile.frame, grid::space_of(tile.grid, tile.frame));
  try {
    run.build(tile.grid, kinds_of(lights));
    run.assign({tile.frame, lights, nullptr});
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

TEST(Memory, limit_does_not_depend_on_the_lists_that_a_method_is_given) {
  const LongTile tile(300, 100, false);  // 30,000 pairs: 117 KiB
  int refused = 0;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    if (!row->takes(grid::Kind::frustum) || row->needs.depth || !row->answers(Answer::lists)) continue;
    for (std::uint64_t limit = 16 << 10; limit < (512 << 10); limit += limit / 16) {
      const MemoryLimitScope little(limit);
      const std::string in_none = refusal_in(*row, tile, 0);
      refused += in_none.empty() ? 0 : 1;
      EXPECT_EQ(refusal_in(*row, tile, 30'000), in_none) << row->name << " with " << limit << " bytes";
      EXPECT_EQ(refusal_in(*row, tile, 1'000'000), in_none) << row->name << " with " << limit << " bytes";
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Memory, of_storages_is_bounded_by_the_limit) {
  const MemoryLimitScope little(4 * k_mib);
  for (const StorageDescriptor* row : storage_descriptors()) {
    const auto storage = row->make(Params(row->params));
    storage->start(100, {100, 100});
    EXPECT_THROW(storage->start(2'000'000, {100'000, 100'000}), Error) << row->name;
  }
}

TEST(Memory, of_a_product_that_no_64_bits_hold_is_refused) {
  EXPECT_THROW(check_memory("things", std::uint64_t{1} << 62, 8), Error);
  EXPECT_NO_THROW(check_memory("things", 0, 8));
}

// As many columns and rows of as many lights as a vector holds as make 2^32 pairs.
TEST(ListBuilder, count_the_pairs_of_a_batch_beyond_32_bits) {
  constexpr std::uint32_t k_wide = 1u << 14;
  const std::uint32_t lanes = balls_per_batch(), high = (1u << 18) / lanes;
  const std::vector<std::uint32_t> columns(std::size_t{high} * lanes, ColumnSpan::of(0, k_wide - 1));
  std::vector<std::uint32_t> lights(k_most_lanes);
  for (std::uint32_t i = 0; i < lights.size(); ++i) lights[i] = i;
  std::vector<std::uint8_t> is_left(high);
  ListBuilder spans;
  Lists lists;
  spans.start(0, high, k_wide, lists);  // no band has room: none is to be finished
  spans.add_batch(0, static_cast<int>(high) - 1, columns.data(), lights.data(), is_left.data());
  EXPECT_THROW(spans.finish_band(), Error);
}

}  // namespace
}  // namespace clusterbench::assign
