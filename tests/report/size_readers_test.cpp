// The functions of `size` for shaders that read a cell's lights, on buffers of each form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>
#include <utility>

#include "assign/contract/storage.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/shader_compiler.h"
#include "report/size_report/size_report.h"

namespace clusterbench::report {
namespace {

using testing::case_by_hand;
using testing::ShaderTest;

// Lists of some cells in one of the forms that buffers have, in words of 32 bits.
struct Encoded {
  std::string name, storage;
  std::vector<std::pair<std::string, std::vector<std::uint32_t>>> buffers;  // in the structure's order
  std::vector<std::uint32_t> element_bytes, elements;
};

using CellLists = std::vector<std::vector<std::uint32_t>>;
constexpr std::uint32_t k_lights = 40;  // 20 points, then spots; with boxes 10 of these

std::vector<std::uint32_t> packed_indices(const CellLists& lists, std::uint32_t bytes) {
  std::vector<std::uint32_t> words(64, 0);
  std::uint32_t entry = 0;
  for (const auto& list : lists)
    for (const std::uint32_t light : list) {
      words[entry * bytes / 4] |= light << (8 * (entry * bytes % 4));
      ++entry;
    }
  return words;
}

// Points are the lights below 20, boxes those from 30 on.
std::vector<std::uint32_t> header_of(const std::vector<std::uint32_t>& list, std::uint32_t offset, bool is_wide,
                                     bool has_boxes) {
  std::uint32_t points = 0, spots = 0, boxes = 0;
  for (const std::uint32_t light : list) ++(light < 20 ? points : has_boxes && light >= 30 ? boxes : spots);
  std::vector<std::uint32_t> words{offset};
  if (is_wide)
    words.insert(words.end(), {points, spots});
  else
    words.push_back(points | spots << 16);
  if (has_boxes) words.push_back(boxes);
  return words;
}

Encoded packed(const CellLists& lists, std::uint32_t bytes, bool is_wide, bool has_boxes, bool is_sparse) {
  std::vector<std::uint32_t> headers, blocks{0, 0};
  std::uint32_t offset = 0;
  for (std::uint32_t cell = 0; cell < lists.size(); ++cell) {
    if (!is_sparse || !lists[cell].empty()) {
      const std::vector<std::uint32_t> header = header_of(lists[cell], offset, is_wide, has_boxes);
      headers.insert(headers.end(), header.begin(), header.end());
      blocks[0] |= 1u << cell;
    }
    offset += static_cast<std::uint32_t>(lists[cell].size());
  }
  const std::uint32_t header_bytes = (is_wide ? 12u : 8u) + (has_boxes ? 4u : 0u);
  Encoded out{"packed " + std::to_string(bytes) + (is_wide ? " wide" : "") + (is_sparse ? " sparse" : "") +
                  (has_boxes ? " boxes" : ""),
              is_sparse ? "packed(headers=sparse)" : "packed",
              {{"indices", packed_indices(lists, bytes)}, {"headers", headers}},
              {bytes, header_bytes},
              {offset, static_cast<std::uint32_t>(headers.size() * 4 / header_bytes)}};
  if (is_sparse) {
    out.buffers.emplace_back("header_blocks", blocks);
    out.element_bytes.push_back(8);
    out.elements.push_back(1);
  }
  return out;
}

// The same headers of 8 words, whose last ones are of no light.
Encoded with_room_in_headers(Encoded wide) {
  const std::vector<std::uint32_t> tight = wide.buffers[1].second;
  const std::size_t words = wide.element_bytes[1] / 4;
  wide.buffers[1].second.clear();
  for (std::size_t i = 0; i < tight.size(); ++i) {
    wide.buffers[1].second.push_back(tight[i]);
    if (i % words + 1 == words) wide.buffers[1].second.insert(wide.buffers[1].second.end(), 8 - words, 77);
  }
  wide.element_bytes[1] = 32;
  wide.name += " in 32 bytes";
  return wide;
}

// Appends a number of so many bytes to words that hold `count` of them so far.
void append_number(std::vector<std::uint32_t>& words, std::uint32_t& count, std::uint32_t bytes, std::uint32_t number) {
  if (count * bytes / 4 >= words.size()) words.push_back(0);
  words[count * bytes / 4] |= number << (8 * (count * bytes % 4));
  ++count;
}

// A run is its first light and how many follow it; none goes on from points to spots or from spots to boxes.
Encoded runs(const CellLists& lists, std::uint32_t bytes, bool is_wide, bool has_boxes) {
  std::vector<std::uint32_t> headers, words;
  std::uint32_t numbers = 0;
  for (const auto& list : lists) {
    std::uint32_t of_type[3] = {0, 0, 0};
    const std::uint32_t offset = numbers / 2;
    const auto type_of = [&](std::uint32_t light) { return light < 20 ? 0 : has_boxes && light >= 30 ? 2 : 1; };
    for (std::size_t from = 0, to = 0; from < list.size(); from = to) {
      for (to = from + 1; to < list.size() && list[to] == list[to - 1] + 1 && type_of(list[to]) == type_of(list[from]);)
        ++to;
      append_number(words, numbers, bytes, list[from]);
      append_number(words, numbers, bytes, static_cast<std::uint32_t>(to - from - 1));
      ++of_type[type_of(list[from])];
    }
    headers.push_back(offset);
    if (is_wide)
      headers.insert(headers.end(), {of_type[0], of_type[1]});
    else
      headers.push_back(of_type[0] | of_type[1] << 16);
    if (has_boxes) headers.push_back(of_type[2]);
  }
  words.push_back(0);
  return {"runs " + std::to_string(bytes) + (is_wide ? " wide" : "") + (has_boxes ? " boxes" : ""),
          "runs",
          {{"runs", words}, {"headers", headers}},
          {2 * bytes, (is_wide ? 12u : 8u) + (has_boxes ? 4u : 0u)},
          {numbers / 2, static_cast<std::uint32_t>(lists.size())}};
}

// Room for 7 in each cell: a list that is full has no end mark.
Encoded ended(const CellLists& lists, std::uint32_t bytes) {
  const auto cells = static_cast<std::uint32_t>(lists.size());
  std::vector<std::uint32_t> words;
  std::uint32_t numbers = 0;
  for (const auto& list : lists)
    for (std::uint32_t i = 0; i < 7; ++i)
      append_number(words, numbers, bytes, i < list.size() ? list[i] : i == list.size() ? k_lights : 0);
  return {"ended " + std::to_string(bytes), "fixed(cap=7,counts=none)", {{"indices", words}}, {bytes}, {cells * 7}};
}

std::vector<Encoded> encodings(const CellLists& lists, bool has_boxes) {
  std::vector<Encoded> all;
  for (const std::uint32_t bytes : {1u, 2u, 4u})
    for (const bool is_wide : {false, true})
      for (const bool is_sparse : {false, true}) all.push_back(packed(lists, bytes, is_wide, has_boxes, is_sparse));
  for (const bool is_sparse : {false, true})
    all.push_back(with_room_in_headers(packed(lists, 4, true, has_boxes, is_sparse)));
  const auto cells = static_cast<std::uint32_t>(lists.size());
  Encoded fixed{"fixed", "fixed(cap=8)", {}, {1, 4}, {cells * 8, cells}},
      bits{"bits", "bitfield", {}, {4}, {cells * 2}}, linked{"linked", "linked", {}, {8, 4}, {0, cells}};
  std::vector<std::uint32_t> room(2 * cells, 0), counts, words(2 * cells, 0), nodes, heads;
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    counts.push_back(static_cast<std::uint32_t>(lists[cell].size()));
    heads.push_back(lists[cell].empty() ? 0xffffffffu : static_cast<std::uint32_t>(nodes.size() / 2));
    for (std::uint32_t i = 0; i < lists[cell].size(); ++i) {
      const std::uint32_t light = lists[cell][i], next = static_cast<std::uint32_t>(nodes.size() / 2 + 1);
      room[2 * cell + i / 4] |= light << (8 * (i % 4));
      words[2 * cell + light / 32] |= 1u << light % 32;
      nodes.insert(nodes.end(), {light, i + 1 < lists[cell].size() ? next : 0xffffffffu});
    }
  }
  linked.elements[0] = static_cast<std::uint32_t>(nodes.size() / 2);
  fixed.buffers = {{"indices", room}, {"counts", counts}};
  bits.buffers = {{"words", words}};
  linked.buffers = {{"nodes", nodes}, {"heads", heads}};
  if (!has_boxes) all.insert(all.end(), {fixed, bits, linked});
  for (const std::uint32_t bytes : {1u, 2u, 4u}) {
    for (const bool is_wide : {false, true}) all.push_back(runs(lists, bytes, is_wide, has_boxes));
    if (!has_boxes) all.push_back(ended(lists, bytes));
  }
  return all;
}

run::Result result_of_encodings(const std::vector<Encoded>& all, int cells, bool has_boxes) {
  run::Result result = testing::result_by_hand();
  result.cases.clear();
  result.planned_ids.clear();
  result.scenes[0].boxes = has_boxes ? 5 : 0;
  for (const Encoded& one : all) {
    run::CaseResult entry = case_by_hand(one.name, "aabb", 1.0);
    entry.name = "hall/walk/" + one.name + "/aabb/packed";
    entry.grid["cells"] = {cells, 1, 1};
    entry.storage_label = one.storage;
    entry.lights = k_lights;
    entry.buffers.each.clear();
    for (std::size_t i = 0; i < one.buffers.size(); ++i) {
      measure::BufferHighWater buffer;
      buffer.name = one.buffers[i].first;
      buffer.element_bytes = one.element_bytes[i];
      buffer.high_water = buffer.theoretical_max = one.elements[i];
      buffer.along_path.add_frame(one.elements[i]);
      entry.buffers.each.push_back(buffer);
    }
    result.cases.push_back(entry);
    result.planned_ids.push_back(one.name);
  }
  return result;
}

assign::Lists as_lists(const CellLists& cells) {
  assign::Lists lists;
  lists.begin.push_back(0);
  for (const auto& cell : cells) {
    lists.lights.insert(lists.lights.end(), cell.begin(), cell.end());
    lists.begin.push_back(static_cast<std::uint32_t>(lists.lights.size()));
  }
  return lists;
}

// "fixed(cap=7,counts=none)", made as the tool makes it.
std::unique_ptr<assign::Storage> storage_of_label(const std::string& label) {
  const std::size_t open = label.find('(');
  const assign::StorageDescriptor& found = *assign::find_storage(label.substr(0, open));
  std::map<std::string, assign::ParamValue> values = assign::Params(found.params).values();
  std::string rest = open == std::string::npos ? "" : label.substr(open + 1, label.size() - open - 2);
  for (std::size_t end = 0; !rest.empty(); rest = end == std::string::npos ? "" : rest.substr(end + 1)) {
    end = rest.find(',');
    const std::string one = rest.substr(0, end), key = one.substr(0, one.find('=')),
                      value = one.substr(one.find('=') + 1);
    values[key] = std::isdigit(static_cast<unsigned char>(value[0])) != 0 ? assign::ParamValue(std::stod(value))
                                                                          : assign::ParamValue(value);
  }
  return found.make(assign::Params(found.params, values));
}

// A compute shader of one thread that reads `samples` and writes `cells`, behind what an include asks for.
std::string program_of(const std::string& included, const std::string& body, bool is_hlsl) {
  const std::string start = is_hlsl ? "RWStructuredBuffer<uint> samples : register(u0);\n"
                                      "RWStructuredBuffer<int> cells : register(u1);\n"
                                    : "#version 450\nlayout(local_size_x = 1) in;\n"
                                      "layout(std430, binding = 0) buffer In { uint samples[]; };\n"
                                      "layout(std430, binding = 1) buffer Out { int cells[]; };\n";
  return start + included + (is_hlsl ? "[numthreads(1, 1, 1)] void main() {\n" : "void main() {\n") + body + "}\n";
}

// The words that the shaders read are made here, by hand: of what is stored the tool's own storages have as many
// elements, in as many bytes, and read the same lists.
TEST(SizeEncodings, are_what_the_storages_themselves_need_and_read) {
  const CellLists lists{{}, {3}, {0, 1, 19, 20, 29}, {}, {30, 34}, {5, 6, 7, 8, 21, 22, 31}, {33}};
  for (const bool has_boxes : {false, true}) {
    std::size_t compared = 0;
    for (const Encoded& one : encodings(lists, has_boxes)) {
      const auto storage = storage_of_label(one.storage);
      storage->start(static_cast<std::uint32_t>(lists.size()),
                     has_boxes ? view::LightRanges(20, 10, 10) : view::LightRanges(20, 20));
      storage->store(as_lists(lists));
      for (std::uint32_t cell = 0; cell < lists.size(); ++cell) {
        std::vector<std::uint32_t> read;
        storage->read_cell(cell, read);
        EXPECT_EQ(read, lists[cell]) << one.name;
      }
      // 40 lights are numbered in a byte and counted in two.
      const bool is_other_width = one.name.find(" wide") != std::string::npos ||
                                  one.name.find(" 2") != std::string::npos || one.name.find(" 4") != std::string::npos;
      if (is_other_width || one.name == "fixed") continue;  // whose room here is one more than the longest list
      ++compared;
      const std::vector<assign::BufferNeed> needs = storage->buffers();
      ASSERT_EQ(needs.size(), one.buffers.size()) << one.name;
      for (std::size_t i = 0; i < needs.size(); ++i) {
        EXPECT_EQ(needs[i].name, one.buffers[i].first) << one.name;
        EXPECT_EQ(needs[i].element_bytes, one.element_bytes[i]) << one.name;
        EXPECT_EQ(needs[i].elements, one.elements[i]) << one.name;
      }
    }
    EXPECT_GE(compared, 3u);
  }
}

TEST(SizeEncodings, every_storage_of_lists_has_a_reader_and_what_has_none_says_why) {
  for (const assign::StorageDescriptor* storage : assign::storage_descriptors()) {
    const CellLists lists{{}, {3}};
    const auto all = encodings(lists, false);
    EXPECT_TRUE(std::ranges::any_of(all, [&](const Encoded& one) { return one.storage.starts_with(storage->name); }))
        << storage->name;
  }
  run::Result result = testing::result_by_hand();
  for (run::CaseResult& one : result.cases) one.storage_label = "own";
  const std::string own = size_report(record_of(result, {}), {"", true, "glsl"});
  EXPECT_NE(own.find("// no function here reads its lists: it has no lists of cells"), std::string::npos) << own;
  const nlohmann::json json = nlohmann::json::parse(size_report(record_of(result, {}), {"", true, "json"}));
  EXPECT_NE(json["structures"][0]["no_reader"].get<std::string>().find("it has no lists of cells"), std::string::npos);
}

class SizeReaders : public ShaderTest, public ::testing::WithParamInterface<bool> {};

// Number of lights and then each light of each cell, from words that are elsewhere than the include would have them.
TEST_P(SizeReaders, read_the_nth_light_of_a_cell_out_of_each_form_of_buffers) {
  const CellLists lists{{}, {3}, {0, 1, 19, 20, 29}, {}, {30, 34}, {5, 6, 7, 8, 21, 22, 31}, {33}};
  constexpr std::size_t k_most = 8;
  for (const bool has_boxes : {false, true}) {
    const std::vector<Encoded> all = encodings(lists, has_boxes);
    const run::Result result = result_of_encodings(all, static_cast<int>(lists.size()), has_boxes);
    SizeRequest request{"", false, "json"};
    request.margin = 1.0;
    request.rounding = "none";
    const result::Result record = record_of(result, {});
    const auto structures = nlohmann::json::parse(size_report(record, request))["structures"];
    request.format = GetParam() ? "hlsl" : "glsl";
    std::vector<std::uint32_t> words;
    std::string defines, body;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto name = structures[i]["identifier"].get<std::string>(), n = std::to_string(i);
      for (const auto& [buffer, content] : all[i].buffers) {
        defines += "#define " + name + "_" + buffer + "_word(i) samples[(i) + " + std::to_string(words.size()) + "u]\n";
        words.insert(words.end(), content.begin(), content.end());
      }
      const std::string at = std::to_string(i * lists.size() * k_most);
      body += "  for (int c" + n + " = 0; c" + n + " < " + std::to_string(lists.size()) + "; ++c" + n + ") {\n    " +
              name + "_list list" + n + " = " + name + "_list_of(c" + n + ");\n    cells[" + at + " + 8 * c" + n +
              "] = int(list" + n + ".lights);\n    for (uint k" + n + " = 0u; k" + n + " < list" + n + ".lights; ++k" +
              n + ") cells[" + at + " + 8 * c" + n + " + 1 + int(k" + n + ")] = int(" + name + "_index_at(c" + n +
              ", k" + n + "));\n  }\n";
    }
    ASSERT_TRUE(compiles(program_of(defines + size_report(record, request), body, GetParam()), GetParam()));
    const std::vector<std::int32_t> read = answers(words, all.size() * lists.size() * k_most);
    ASSERT_EQ(read.size(), all.size() * lists.size() * k_most);
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t cell = 0; cell < lists.size(); ++cell) {
        const std::int32_t* at = &read[(i * lists.size() + cell) * k_most];
        const std::vector<std::uint32_t> found(at + 1, at + 1 + at[0]);
        EXPECT_EQ(found, lists[cell]) << all[i].name << ", cell " << cell;
      }
  }
}

// Each camera with half of what both need together.
run::Result result_of_views(const std::vector<Encoded>& all, int cells) {
  run::Result result = result_of_encodings(all, cells, false);
  const std::vector<run::CaseResult> one_camera = std::exchange(result.cases, {});
  result.planned_ids.clear();
  for (const std::string camera : {"left", "right"})
    for (run::CaseResult entry : one_camera) {
      entry.camera = camera;
      entry.name.replace(entry.name.find("walk"), 4, camera);
      entry.id += camera;
      for (measure::BufferHighWater& buffer : entry.buffers.each) {
        buffer.high_water = buffer.theoretical_max = (buffer.high_water + (camera == "left" ? 1 : 0)) / 2;
        buffer.along_path = measure::PathSeries();
        buffer.along_path.add_frame(buffer.high_water);
      }
      result.cases.push_back(entry);
      result.planned_ids.push_back(entry.id);
    }
  return result;
}

// Of the second of two views; a sample outside of its grid has no list, and not one of the first view.
TEST_P(SizeReaders, read_the_lists_of_the_vth_view_and_nothing_outside_of_its_grid) {
  const CellLists lists{
      {0, 39}, {3}, {0, 1, 19, 20, 29}, {}, {30, 34}, {5, 6, 7, 8, 21, 22, 31}, {33}, {12, 13}, {}, {38}, {},
      {1, 2},  {4}, {9, 11, 35}};
  constexpr int k_cells = 7, k_stride = 8;
  const std::vector<Encoded> all = encodings(lists, false);
  const result::Result record = record_of(result_of_views(all, k_cells), {});
  SizeRequest request{"", false, "json"};
  request.margin = 1.0;
  request.rounding = "none";
  request.scope.views = {"left,right"};
  const auto structures = nlohmann::json::parse(size_report(record, request))["structures"];
  request.format = GetParam() ? "hlsl" : "glsl";
  std::vector<std::uint32_t> words;
  std::string defines, body;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto name = structures[i]["identifier"].get<std::string>(), at = std::to_string(i * 2 * 8 * k_stride);
    for (const auto& [buffer, content] : all[i].buffers) {
      defines += "#define " + name + "_" + buffer + "_word(i) samples[(i) + " + std::to_string(words.size()) + "u]\n";
      words.insert(words.end(), content.begin(), content.end());
    }
    body += "  for (int v = 0; v < 2; ++v)\n    for (int c = -1; c < " + name +
            "_cells_of_view; ++c) {\n      int at = " + at + " + 8 * (8 * v + c + 1);\n      cells[at] = int(" + name +
            "_list_of(v, c).lights);\n      for (int k = 0; k < cells[at]; ++k) cells[at + 1 + k] = int(" + name +
            "_index_at(v, c, uint(k)));\n    }\n";
    EXPECT_NE(size_report(record, request).find(name + "_cells_of_view = 7;"), std::string::npos);
  }
  ASSERT_TRUE(compiles(program_of(defines + size_report(record, request), body, GetParam()), GetParam()));
  const std::vector<std::int32_t> read = answers(words, all.size() * 2 * 8 * k_stride);
  ASSERT_EQ(read.size(), all.size() * 2 * 8 * k_stride);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (int view = 0; view < 2; ++view)
      for (int cell = -1; cell < k_cells; ++cell) {
        const auto* at = &read[(i * 16 + static_cast<std::size_t>(8 * view + cell + 1)) * k_stride];
        const std::vector<std::uint32_t> found(at + 1, at + 1 + at[0]);
        const std::size_t listed = static_cast<std::size_t>(view * k_cells + cell);
        EXPECT_EQ(found, cell < 0 ? std::vector<std::uint32_t>{} : lists[listed])
            << all[i].name << ", view " << view << ", cell " << cell;
      }
}

// Buffers that nothing is said of are declared, and each has its own binding.
TEST_P(SizeReaders, compile_with_the_buffers_that_the_include_declares) {
  const CellLists lists{{1, 2}, {}, {3}};
  const std::vector<Encoded> all = encodings(lists, false);
  const result::Result record = record_of(result_of_encodings(all, 3, false), {});
  const std::string text = size_report(record, {"", false, GetParam() ? "hlsl" : "glsl"});
  EXPECT_TRUE(compiles((GetParam() ? "" : "#version 450\nlayout(local_size_x = 1) in;\n") + text + text +
                           (GetParam() ? "[numthreads(1, 1, 1)] void main() {}\n" : "void main() {}\n"),
                       GetParam()))
      << "included twice";
  for (int slot = 0; slot < 4; ++slot) {
    const std::string place =
        GetParam() ? "register(t" + std::to_string(slot) + ")" : "binding = " + std::to_string(slot) + ")";
    EXPECT_EQ(text.find(place), text.rfind(place)) << place;
    EXPECT_NE(text.find(place), std::string::npos) << place;
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, SizeReaders, ::testing::Bool(),
                         [](const auto& of) { return std::string(of.param ? "hlsl" : "glsl"); });

}  // namespace
}  // namespace clusterbench::report
