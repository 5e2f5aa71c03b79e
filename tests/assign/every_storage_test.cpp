// What holds of every storage.

#include <gtest/gtest.h>

#include <set>

#include "assign/stored_lists.h"

namespace clusterbench::assign {
namespace {

// A shader reads one format. So from 65,536 lights of a type on, which 16 bits do not count, all figures say 12 bytes.
TEST(EveryStorage, of_lists_has_headers_of_one_size_in_use_limit_buffers_and_reads) {
  const auto check = [](const char* name, const view::LightRanges& lights, std::uint32_t header_bytes) {
    const auto kept = storage(name);
    kept->start(2, lights);
    Ids all(lights.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    for (const Ids& first : {Ids{1, 5}, all, Ids{69999}}) {
      const Lists lists = lists_from({first, {7}});
      kept->store(lists);
      EXPECT_EQ(kept->expanded(), lists);
      const auto buffers = kept->buffers();
      EXPECT_EQ(buffers[1].element_bytes, header_bytes) << name;
      EXPECT_EQ(kept->use().header_bytes, 2u * header_bytes) << name;
      EXPECT_EQ(kept->limit().bytes, buffers[0].most * buffers[0].element_bytes + 2u * header_bytes) << name;
      EXPECT_EQ(kept->reads_of_cell(1).bytes, buffers[0].element_bytes + header_bytes) << name;
    }
  };
  check("packed", {65535, 10000}, 8);
  check("packed", {65536, 10000}, 12);
  check("packed", {10000, 65536}, 12);
  check("runs", {131070, 0}, 8);
  check("runs", {131071, 0}, 12);
}

TEST(EveryStorage, keeps_lists_with_boxes) {
  const Lists lists = random_lists(60, 90, 0.2, 3);
  for (const StorageDescriptor* row : storage_descriptors()) {
    const auto kept = storage(row->name);
    kept->start(60, {40, 20, 30});
    kept->store(lists);
    EXPECT_EQ(kept->expanded(), lists) << row->name;
  }
}

// Of cells with 0, 1, 3 and 4 of 300 lights, of which the last 100 are spots.
std::vector<Reads> reads_of_cells(const std::string& name, const std::map<std::string, ParamValue>& params = {},
                                  view::LightRanges lights = {200, 100}) {
  const auto kept = storage(name, params);
  kept->start(4, lights);
  kept->store(lists_from({{}, {7}, {3, 4, 20}, {1, 2, 3, 20}}));
  std::vector<Reads> reads;
  for (std::uint32_t cell = 0; cell < 4; ++cell) reads.push_back(kept->reads_of_cell(cell));
  return reads;
}

TEST(EveryStorage, reads_what_its_layout_makes_a_shader_fetch) {
  using All = std::vector<Reads>;
  EXPECT_EQ(reads_of_cells("packed"), (All{{1, 8}, {2, 8 + 2}, {4, 8 + 6}, {5, 8 + 8}}));
  EXPECT_EQ(reads_of_cells("packed", {}, {100000, 0}), (All{{1, 12}, {2, 12 + 4}, {4, 12 + 12}, {5, 12 + 16}}))
      << "as wide as the lights can need";
  EXPECT_EQ(reads_of_cells("packed", {{"headers", std::string("sparse")}}),
            (All{{1, 8}, {3, 16 + 2}, {5, 16 + 6}, {6, 16 + 8}}))
      << "a block, and a header where the block has the cell's bit";
  EXPECT_EQ(reads_of_cells("fixed", {{"cap", 4.0}}), (All{{1, 4}, {2, 4 + 2}, {4, 4 + 6}, {5, 4 + 8}}));
  EXPECT_EQ(reads_of_cells("fixed", {{"cap", 4.0}, {"counts", std::string("none")}}),
            (All{{1, 2}, {2, 4}, {4, 8}, {4, 8}}))
      << "up to the mark behind the last light, which a full list has not";
  EXPECT_EQ(reads_of_cells("fixed", {{"cap", 2.0}}), (All{{1, 4}, {2, 4 + 2}, {3, 4 + 4}, {3, 4 + 4}}))
      << "less what is dropped";
  EXPECT_EQ(reads_of_cells("bitfield"), (All(4, {10, 40}))) << "all words of the cell";
  EXPECT_EQ(reads_of_cells("bitfield", {}, {20, 12}), (All(4, {1, 4}))) << "up to 32 lights are a single word";
  EXPECT_EQ(reads_of_cells("linked"), (All{{1, 4}, {2, 4 + 8}, {4, 4 + 24}, {5, 4 + 32}}));
  EXPECT_EQ(reads_of_cells("runs"), (All{{1, 8}, {2, 8 + 4}, {3, 8 + 8}, {3, 8 + 8}}))
      << "3 to 4 and 20; 1 to 3 and 20";
}

TEST(EveryStorage, keeps_lists_in_any_order) {
  for (const StorageDescriptor* row : storage_descriptors())
    for (const std::uint32_t lights : {9u, 60u, 700u})
      for (const double share : {0.1, 0.6, 1.0}) {
        Lists lists = random_lists(60, lights, share, lights);
        const auto kept = row->make(row->name == "linked"  ? Params(row->params, {{"nodes_per_cell", 700.0}})
                                    : row->name == "fixed" ? Params(row->params, {{"cap", 700.0}})
                                                           : Params(row->params));
        kept->start(60, {lights / 2, lights - lights / 2});
        kept->store(shuffled(lists, lights / 2, 5));
        Lists back = kept->expanded();
        EXPECT_EQ(lists_fault(back, 60, {lights / 2, lights - lights / 2}), "") << row->name;
        make_ascending(back);
        EXPECT_EQ(back, lists) << row->name << ", " << lights << " lights, " << share;
      }
}

// All that a storage says of its sizes in the current frame.
std::vector<std::uint64_t> sizes_of(const Storage& kept) {
  const StructureUse use = kept.use();
  const StructureLimit limit = kept.limit();
  std::vector<std::uint64_t> sizes{use.index_entries, use.index_bytes,    use.header_bytes,      use.upload_bytes,
                                   use.traffic_bytes, use.dropped_pairs,  use.overflowing_cells, use.fallback_cells,
                                   limit.bytes,       use.repeated_pairs, limit.index_entries,   kept.index_bits()};
  for (const BufferNeed& need : kept.buffers())
    sizes.insert(sizes.end(), {need.element_bytes, need.elements, need.most, need.step});
  sizes.insert(sizes.end(), use.dropped_lights.begin(), use.dropped_lights.end());
  return sizes;
}

TEST(EveryStorage, counts_the_sizes_that_it_stores) {
  const std::string shared = "shared", sparse = "sparse", none = "none";
  const std::vector<std::pair<std::string, std::map<std::string, ParamValue>>> kinds{
      {"packed", {}},
      {"packed", {{"headers", sparse}}},
      {"packed", {{"headers", sparse}, {"equal_lists", shared}}},
      {"packed", {{"max_entries", 800.0}}},
      {"packed", {{"max_entries", 800.0}, {"headers", sparse}, {"equal_lists", shared}}},
      {"packed", {{"header_size", 30.0}}},
      {"fixed", {{"cap", 3.0}}},
      {"fixed", {{"cap", 700.0}}},
      {"fixed", {{"cap", 40.0}, {"counts", none}}},
      {"bitfield", {}},
      {"linked", {{"nodes_per_cell", 4.0}}},
      {"linked", {{"nodes_per_cell", 700.0}}},
      {"runs", {}}};
  std::set<std::string> met;
  for (const auto& [name, params] : kinds)
    for (const std::uint32_t lights : {0u, 1u, 60u, 700u}) {
      met.insert(name);
      const auto counted = storage(name, params), stored = storage(name, params);
      const view::LightRanges types(lights / 2, lights - lights / 2);
      counted->start(60, types);
      stored->start(60, types);
      std::uint64_t seed = lights;
      for (const double share : {0.3, 0.0, 0.02, 1.0, 0.01, 0.6}) {
        ++seed;
        const Lists lists = shuffled(random_lists(60, lights, share, seed), lights / 2, seed);
        counted->count(lists);
        stored->store(lists);
        EXPECT_EQ(sizes_of(*counted), sizes_of(*stored)) << name << ", " << lights << " lights, " << share;
        if (seed % 2 == 0) continue;
        counted->store(lists);
        EXPECT_EQ(counted->expanded(), stored->expanded()) << name << ": stores after it has counted";
      }
    }
  EXPECT_EQ(met.size(), storage_descriptors().size()) << "a storage that is not counted here";
}

}  // namespace
}  // namespace clusterbench::assign
