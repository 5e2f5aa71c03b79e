// The templates of engines, filled in with lists that transcriptions of their code make and that are written in their
// own layout by code that shares nothing with the decoder.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "assign/contract/assigner_run.h"
#include "core/error.h"
#include "dump/dump_template.h"
#include "dump/made_dump.h"
#include "layout/encoders.h"
#include "measure/truth/list_errors.h"

namespace clusterbench::dump {
namespace {

using namespace testing;
using Json = nlohmann::ordered_json;

Json template_of(const std::string& engine) {
  for (const DumpTemplate& row : dump_templates())
    if (row.name == engine) return Json::parse(row.text, nullptr, true, true);
  return {};
}

Json numbers(const Mat4d& m) {
  Json out = Json::array();
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) out.push_back(m[c][r]);
  return out;
}

// A camera in the middle of the lights; near 0.5 m, far 60 m, by the convention of the template.
void fill_camera(Json& dump, Vec2i viewport) {
  dump["viewport"] = {viewport.x, viewport.y};
  Mat4d view(1.0);
  view[3] = Vec4d(0.0, -2.0, 0.0, 1.0);
  Json& camera = dump["camera"];
  if (camera.contains("world_to_view")) camera["world_to_view"] = numbers(view);
  const double aspect = static_cast<double>(viewport.x) / viewport.y, near = 0.5, far = 60.0;
  const std::string depth = camera["depth"];
  const double at_near = depth == "-1..1" ? -1.0 : depth == "1..0" ? 1.0 : 0.0, at_far = depth == "1..0" ? 0.0 : 1.0;
  const double a = (at_far * far - at_near * near) / (far - near);
  Mat4d projection(0.0);
  projection[0][0] = 1.5 / aspect;
  projection[1][1] = camera.contains("clip_y") ? -1.5 : 1.5;
  projection[2] = {0.0, 0.0, -a, -1.0};
  projection[3][2] = (at_near - a) * near;
  camera["projection"] = numbers(projection);
  camera["far_m"] = far;
}

struct Lamp {
  Vec3d position{0.0}, direction{0.0};
  double range_m = 0.0, half_angle_rad = 0.0;  // 0: a point
};

// Around the camera, so that some are behind the eye and reach into view.
std::vector<Lamp> lamps(double spots) {
  SplitMix64 random(7);
  const auto drawn = [&random](double lo, double hi) {
    return static_cast<double>(static_cast<float>(random.between(lo, hi)));
  };
  std::vector<Lamp> out(200);
  for (Lamp& lamp : out) {
    lamp.position = {drawn(-20.0, 20.0), drawn(0.0, 6.0), drawn(-40.0, 5.0)};
    lamp.direction = glm::normalize(Vec3d(drawn(-1.0, 1.0), drawn(-1.0, 1.0), drawn(-1.0, 1.0)));
    lamp.range_m = drawn(2.0, 6.0);
    lamp.half_angle_rad = random.unit() < spots ? drawn(0.2, 1.0) : 0.0;
  }
  return out;
}

void list_lights(Json& dump, const std::vector<Lamp>& all) {
  Json& listed = dump["lights"]["listed"] = Json::array();
  for (const Lamp& lamp : all) {
    const Vec3d &p = lamp.position, &d = lamp.direction;
    Json light{{"position", {p.x, p.y, p.z}}, {"range_m", lamp.range_m}};
    if (lamp.half_angle_rad > 0.0) {
      light["direction"] = {d.x, d.y, d.z};
      light["half_angle_deg"] = lamp.half_angle_rad * 180.0 / M_PI;
    }
    listed.push_back(light);
  }
}

layout::Buffer floats(const std::string& name, const std::vector<float>& values) {
  layout::Buffer out{name, name + ".bin", 0, {}};
  for (std::size_t i = 0; i < values.size(); ++i) layout::testing::put(out.bytes, 4 * i, values[i]);
  return out;
}

using Write = std::function<layout::Described(const assign::Lists&, const DumpFrame&, const layout::CellOrder&)>;

struct Judged {
  result::CheckedDump checked;
  measure::ErrorCounts counted;  // by the measures of `run`
  std::string text;
};

// The lists of a method on the dump's frame, in the engine's layout.
Judged judged(const Json& json, std::vector<layout::Buffer> buffers, const std::string& method, const Write& write) {
  DumpFile dump{"engine.json", parse_dump(json.dump(), "engine.json"), std::move(buffers)};
  const DumpFrame frame = frame_of(dump);
  const assign::AssignerDescriptor* row = assign::find_assigner(method);
  assign::AssignerRun run(*row, assign::Params(row->params), assign::Answer::lists);
  const view::LightArrays lights = view::lights_in(frame.frame, grid::space_of(frame.grid, frame.frame));
  run.build(frame.grid, assign::kinds_of(lights));
  run.assign({frame.frame, lights});
  Judged out;
  measure::add_frame(out.counted, frame.frame, frame.grid, measure::find_truth(frame.frame, frame.grid, 1),
                     run.cell_lists());
  assign::Lists listed = run.cell_lists();
  for (std::uint32_t& light : listed.lights) light = frame.dump_index[light];
  const layout::CellOrder order = order_of(dump.record.grid);
  for (layout::Buffer& buffer : write(layout::in_order(listed, frame.grid.cells(), order), frame, order).buffers)
    dump.buffers.push_back(std::move(buffer));
  out.checked = judge(dump, {});
  out.text = check_text(out.checked, 3);
  return out;
}

void expect_counts(const Judged& judged, const char* engine) {
  const result::CheckedSet& set = judged.checked.sets.front();
  ASSERT_TRUE(set.error) << engine << judged.text;
  EXPECT_EQ(set.error->lost_pairs, judged.counted.false_negatives) << engine;
  EXPECT_EQ(set.error->false_positives, judged.counted.false_positives) << engine;
  EXPECT_EQ(set.error->true_pairs, judged.counted.true_pairs) << engine;
  EXPECT_NEAR(set.error->deepest_percent, 100.0 * judged.counted.deepest_miss, 1e-9) << engine;
  EXPECT_FALSE(set.other_reading) << engine << judged.text;
}

Judged filament_with(const std::string& method) {
  Json json = template_of("filament");
  fill_camera(json, {1280, 700});
  json["grid"]["tiles"]["pixels"] = {64, 64};  // 700 is no multiple: the row that is cut off is at the top
  const std::vector<Lamp> all = lamps(0.3);
  std::vector<float> numbers;
  for (const Lamp& lamp : all) {
    const bool is_spot = lamp.half_angle_rad > 0.0;
    const auto add = [&](double value) { numbers.push_back(static_cast<float>(value)); };
    for (int i = 0; i < 3; ++i) add(lamp.position[i]);
    add(1.0 / (lamp.range_m * lamp.range_m));
    for (int i = 0; i < 3; ++i) add(lamp.direction[i]);
    for (int i = 0; i < 3; ++i) add(0.0);  // reserved, colour, IES index
    const double scale = 1.0 / (1.0 - std::cos(lamp.half_angle_rad));
    add(is_spot ? scale : 0.0);
    add(is_spot ? -std::cos(lamp.half_angle_rad) * scale : 1.0);
    for (int i = 0; i < 2; ++i) add(0.0);  // reserved, intensity
    add(is_spot ? std::bit_cast<float>(0x711u) : std::bit_cast<float>(0x710u));
    add(0.0);
  }
  json["lights"]["rows"][0]["count"] = all.size();
  return judged(json, {floats("lights", numbers)}, method,
                [](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
                  return layout::testing::filament(lists);
                });
}

TEST(Engines, what_filament_loses_behind_the_eye_is_found_in_its_froxels) {
  const Judged as_shipped = filament_with("filament-refinement"), exact = filament_with("exact");
  expect_counts(as_shipped, "filament");
  EXPECT_EQ(as_shipped.checked.sets[0].verdict, "lost") << as_shipped.text;
  EXPECT_GT(as_shipped.checked.spots, 30u);
  expect_counts(exact, "filament, exact");
  EXPECT_EQ(exact.checked.sets[0].verdict, "right") << exact.text;
}

Judged three_js_with(Vec2i viewport) {
  Json json = template_of("three-js");
  fill_camera(json, viewport);
  json["grid"]["slices"]["count"] = 12;
  const std::vector<Lamp> all = lamps(0.0);
  std::vector<float> numbers;
  for (const Lamp& lamp : all)
    for (const double value : {lamp.position.x, lamp.position.y, lamp.position.z, lamp.range_m})
      numbers.push_back(static_cast<float>(value));
  json["lights"]["rows"][0]["count"] = all.size();
  return judged(json, {floats("lights", numbers)}, "three-js-boxes",
                [](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
                  layout::Described out;
                  out.buffers = {{"indices", "indices.bin", 0, {}}};
                  for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
                    for (std::uint32_t i = 0; i < 64; ++i)
                      layout::testing::put(out.buffers[0].bytes, 4 * (std::size_t{cell} * 64 + i),
                                           i < lists.of(cell).size() ? lists.of(cell)[i] + 1 : 0u);
                  return out;
                });
}

TEST(Engines, what_three_js_loses_where_32_does_not_divide_the_viewport_is_found) {
  const Judged cut_off = three_js_with({1600, 900}), divided = three_js_with({1280, 704});
  expect_counts(cut_off, "three.js");
  EXPECT_EQ(cut_off.checked.sets[0].verdict, "lost") << cut_off.text;
  EXPECT_GT(cut_off.checked.sets[0].error->deepest_percent, 5.0);
  expect_counts(divided, "three.js");
  EXPECT_NE(divided.checked.sets[0].verdict, "lost") << divided.text;
}

TEST(Engines, lists_of_playcanvas_are_right) {
  Json json = template_of("playcanvas");
  fill_camera(json, {1280, 720});
  json["grid"]["bounds"] = {{"lo_m", {-27, -7, -47}}, {"hi_m", {27, 13, 12}}};
  list_lights(json, lamps(0.3));
  const Judged found =
      judged(json, {}, "light-boxes", [](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
        layout::Described out;
        out.buffers = {{"cells", "cells.bin", 0, {}}};
        for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
          for (std::uint32_t i = 0; i < 255; ++i)
            layout::testing::put(out.buffers[0].bytes, std::size_t{cell} * 255 + i,
                                 static_cast<std::uint8_t>(i < lists.of(cell).size() ? lists.of(cell)[i] + 1 : 0));
        return out;
      });
  expect_counts(found, "playcanvas");
  EXPECT_EQ(found.checked.sets[0].verdict, "right") << found.text;
}

TEST(Engines, lists_of_bevy_are_judged_in_their_own_layout) {
  Json json = template_of("bevy");
  fill_camera(json, {1280, 720});
  // calculate_cluster_factors() of 24 slices, the first to 5 m, to 45 m; bias + 1 since its slice 0 is before the
  // first.
  const double scale = 23.0 / std::log(45.0 / 5.0), bias = std::log(5.0) * scale;
  json["grid"]["slices"]["formula"] = {{"function", "ln"}, {"scale", scale}, {"bias", 1.0 - bias}, {"far_m", 45.0}};
  list_lights(json, lamps(0.3));
  for (const char* method : {"bevy-refinement", "exact"}) {
    const Judged found =
        judged(json, {}, method, [](const assign::Lists& lists, const DumpFrame& frame, const layout::CellOrder&) {
          layout::Described out;
          out.buffers = {{"offsets", "offsets.bin", 0, {}}, {"indices", "indices.bin", 0, {}}};
          for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
            std::uint32_t counts[2] = {0, 0};
            for (const int type : {0, 1})
              for (const std::uint32_t light : lists.of(cell)) {
                if (frame.frame.ranges().is_spot(frame.frame_index[light]) != (type == 1)) continue;
                layout::testing::put(out.buffers[1].bytes, out.buffers[1].bytes.size(), light);
                ++counts[type];
              }
            layout::testing::put(out.buffers[0].bytes, 32 * std::size_t{cell} + 28, 0u);
            layout::testing::put(out.buffers[0].bytes, 32 * std::size_t{cell}, lists.begin[cell]);
            for (const std::size_t type : {0u, 1u})
              layout::testing::put(out.buffers[0].bytes, 32 * std::size_t{cell} + 4 + 4 * type, counts[type]);
          }
          return out;
        });
    expect_counts(found, method);
    if (std::string(method) == "exact") {
      EXPECT_EQ(found.checked.sets[0].verdict, "right") << found.text;
    }
  }
}

// Bits of a tile's lights, and the range of lights of each of its cells: of lights [first, first + count).
struct TileBits {
  std::vector<std::uint32_t> words;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges;  // first and end, per slice
};

TileBits tile_bits(const assign::Lists& lists, std::uint32_t tile, std::uint32_t tiles, std::uint32_t first,
                   std::uint32_t count, std::size_t words) {
  TileBits out{std::vector<std::uint32_t>(words, 0), {}};
  for (std::uint32_t cell = tile; cell < lists.cell_count(); cell += tiles) {
    std::pair<std::uint32_t, std::uint32_t> range{0, 0};
    for (const std::uint32_t light : lists.of(cell)) {
      if (light < first || light >= first + count) continue;
      out.words[(light - first) / 32] |= 1u << (light - first) % 32;
      if (range.second == 0) range.first = light - first;
      range.second = light - first + 1;
    }
    out.ranges.push_back(range);
  }
  return out;
}

TEST(Engines, lists_of_godot_are_judged_in_its_two_parts_of_the_cluster_buffer) {
  Json json = template_of("godot");
  fill_camera(json, {1920, 1080});
  json["grid"]["slices"]["formula"]["scale"] = 32.0 / 60.0;
  std::vector<Lamp> all = lamps(0.3);
  std::ranges::stable_partition(all, [](const Lamp& lamp) { return lamp.half_angle_rad == 0.0; });
  std::vector<float> omnis, spots;
  for (const Lamp& lamp : all) {
    std::vector<float> row(56, 0.0f);
    for (int i = 0; i < 3; ++i) {
      row[static_cast<std::size_t>(i)] = static_cast<float>(lamp.position[i] - (i == 1 ? 2.0 : 0.0));
      row[static_cast<std::size_t>(i) + 4] = static_cast<float>(lamp.direction[i]);
    }
    row[3] = static_cast<float>(1.0 / lamp.range_m);
    row[13] = static_cast<float>(std::cos(lamp.half_angle_rad));
    std::vector<float>& of_type = lamp.half_angle_rad == 0.0 ? omnis : spots;
    of_type.insert(of_type.end(), row.begin(), row.end());
  }
  const auto omni_count = static_cast<std::uint32_t>(omnis.size() / 56);
  const auto spot_count = static_cast<std::uint32_t>(spots.size() / 56);
  ASSERT_GT(spot_count, 30u);
  json["lights"]["rows"][0]["count"] = json["lists"][0]["lights"] = omni_count;
  json["lights"]["rows"][1]["count"] = json["lists"][1]["lights"] = spot_count;
  json["lists"][1]["first_light"] = omni_count;
  const Judged found =
      judged(json, {floats("omnis", omnis), floats("spots", spots)}, "exact",
             [&](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
               layout::Described out;
               out.buffers = {{"clusters", "clusters.bin", 0, {}}};
               constexpr std::uint32_t k_tiles = 60 * 34;
               for (std::uint32_t tile = 0; tile < 2 * k_tiles; ++tile) {
                 const bool is_spots = tile >= k_tiles;
                 const TileBits bits = tile_bits(lists, tile % k_tiles, k_tiles, is_spots ? omni_count : 0,
                                                 is_spots ? spot_count : omni_count, 16);
                 for (std::size_t i = 0; i < 16; ++i)
                   layout::testing::put(out.buffers[0].bytes, 192 * std::size_t{tile} + 4 * i, bits.words[i]);
                 for (std::size_t z = 0; z < 32; ++z)
                   layout::testing::put(out.buffers[0].bytes, 192 * std::size_t{tile} + 64 + 4 * z,
                                        bits.ranges[z].first | bits.ranges[z].second << 16);
               }
               return out;
             });
  const result::CheckedSet& set = found.checked.sets[0];
  EXPECT_EQ(set.verdict, "right") << found.text;
  EXPECT_EQ(set.error->true_pairs, found.counted.true_pairs);
  EXPECT_EQ(found.checked.spots, spot_count);
}

TEST(Engines, lists_of_unity_are_judged_in_their_tiles_and_bins) {
  Json json = template_of("unity-urp");
  fill_camera(json, {1280, 720});
  json["grid"]["slices"] = {{"count", 64}, {"formula", {{"function", "log2"}, {"scale", 9.25}, {"bias", 9.25}}}};
  std::vector<Lamp> all = lamps(0.3);
  all.resize(30);
  list_lights(json, all);
  const Judged found = judged(
      json, {}, "exact", [&](const assign::Lists& lists, const DumpFrame& frame, const layout::CellOrder& order) {
        layout::Described out;
        out.buffers = {{"tiles", "tiles.bin", 0, {}}, {"bins", "bins.bin", 0, {}}};
        EXPECT_TRUE(order.is_from_bottom);
        const Vec3i cells = frame.grid.cells();
        const auto tiles = static_cast<std::uint32_t>(cells.x * cells.y);
        std::vector<std::uint32_t> bins(static_cast<std::size_t>(cells.z), 0);
        for (std::uint32_t tile = 0; tile < tiles; ++tile)
          layout::testing::put(out.buffers[0].bytes, 4 * std::size_t{tile},
                               tile_bits(lists, tile, tiles, 0, 30, 1).words[0]);
        for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell)
          for (const std::uint32_t light : lists.of(cell)) bins[cell / tiles] |= 1u << light;
        for (std::size_t z = 0; z < bins.size(); ++z) {
          const auto first = static_cast<std::uint32_t>(std::countr_zero(bins[z]));
          const std::uint32_t last = 31 - static_cast<std::uint32_t>(std::countl_zero(bins[z]));
          layout::testing::put(out.buffers[1].bytes, 12 * z, bins[z] == 0 ? 0x0000'ffffu : first | last << 16);
          layout::testing::put(out.buffers[1].bytes, 12 * z + 4, 0x0000'ffffu);  // no probes
          layout::testing::put(out.buffers[1].bytes, 12 * z + 8, bins[z]);
        }
        return out;
      });
  EXPECT_EQ(found.checked.sets[0].verdict, "right") << found.text;
  EXPECT_EQ(found.checked.sets[0].error->true_pairs, found.counted.true_pairs);
  EXPECT_GT(found.counted.true_pairs, 1000u);
}

TEST(Engines, every_template_says_what_is_to_be_filled_in_and_is_a_dump_once_it_is) {
  EXPECT_GE(dump_templates().size(), 8u);
  for (const DumpTemplate& row : dump_templates()) {
    try {
      parse_dump(row.text, "template.json");
      ADD_FAILURE() << row.name << " has a camera already";
    } catch (const Error& error) {
      EXPECT_TRUE(error.where() == "/camera/world_to_view" || error.where() == "/camera/projection") << error.what();
      EXPECT_EQ(error.message(), "has 0 elements; allowed: at least 16");
    }
    Json json = template_of(std::string(row.name));
    fill_camera(json, {1920, 1080});
    list_lights(json, lamps(0.0));
    json["lights"].erase("rows");
    json["lights"].erase("space");
    if (!json["camera"].contains("world_to_view")) json["camera"]["world_to_view"] = numbers(Mat4d(1.0));
    const DumpFile dump{"template.json", parse_dump(json.dump(), "template.json"), {}};
    EXPECT_GT(frame_of(dump).grid.cell_count(), 100u) << row.name;
  }
}

}  // namespace
}  // namespace clusterbench::dump
