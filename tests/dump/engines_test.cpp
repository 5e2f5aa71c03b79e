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
#include "view/number_formats.h"

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
  const double forward = camera["forward"] == "+z" ? 1.0 : -1.0;
  projection[2] = {0.0, 0.0, forward * a, forward};
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

using Make = std::function<assign::Lists(const DumpFrame&)>;

// Lists of the frame's lights, in the engine's layout.
Judged judged(const Json& json, std::vector<layout::Buffer> buffers, const Make& make, const Write& write) {
  DumpFile dump{"engine.json", parse_dump(json.dump(), "engine.json"), std::move(buffers)};
  const DumpFrame frame = frame_of(dump);
  assign::Lists listed = make(frame);
  Judged out;
  measure::add_frame(out.counted, frame.frame, frame.grid, measure::find_truth(frame.frame, frame.grid, 1), listed);
  for (std::uint32_t& light : listed.lights) light = frame.dump_index[light];
  const layout::CellOrder order = order_of(dump.record.grid);
  for (layout::Buffer& buffer : write(layout::in_order(listed, frame.grid.cells(), order), frame, order).buffers)
    dump.buffers.push_back(std::move(buffer));
  out.checked = judge(dump, {});
  out.text = check_text(out.checked, 3);
  return out;
}

// Those of a method of ours.
Judged judged(const Json& json, std::vector<layout::Buffer> buffers, const std::string& method, const Write& write) {
  const auto made = [&](const DumpFrame& frame) {
    const assign::AssignerDescriptor* row = assign::find_assigner(method);
    assign::AssignerRun run(*row, assign::Params(row->params), assign::Answer::lists);
    const view::LightArrays lights = view::lights_in(frame.frame, grid::space_of(frame.grid, frame.frame));
    run.build(frame.grid, assign::kinds_of(lights));
    run.assign({frame.frame, lights});
    return run.cell_lists();
  };
  return judged(json, std::move(buffers), Make(made), write);
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
  std::stable_partition(all.begin(), all.end(), [](const Lamp& lamp) { return lamp.half_angle_rad == 0.0; });
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

// Of a tile, in clip space.
struct WickedCorner {
  float x, y;
};

// lightCullingCS.hlsl: a ball against the four planes of a tile and the ends of its depth, in view space along +z.
struct WickedBall {
  Vec3f center{0.0f};
  float radius = 0.0f;

  bool touches(const Json& projection, WickedCorner lo, WickedCorner hi, float near, float far) const {
    const float x_scale = projection[0], y_scale = projection[5];
    const auto outside = [&](float x, float y, float z) {  // of the plane through the eye with this inner normal
      return (x * center.x + y * center.y + z * center.z) / std::sqrt(x * x + y * y + z * z) < -radius;
    };
    if (center.z + radius < near || center.z - radius > far) return false;
    return !outside(1.0f, 0.0f, -lo.x / x_scale) && !outside(-1.0f, 0.0f, hi.x / x_scale) &&
           !outside(0.0f, 1.0f, -lo.y / y_scale) && !outside(0.0f, -1.0f, hi.y / y_scale);
  }
};

// wiRenderer.cpp: a spot by the ball through its apex of radius R / (2 cos^2).
WickedBall wicked_ball(const Lamp& lamp) {
  Vec3d center = lamp.position;
  double radius = lamp.range_m;
  if (lamp.half_angle_rad > 0.0) {
    radius = 0.5 * lamp.range_m / std::pow(std::cos(lamp.half_angle_rad), 2.0);
    center += radius * lamp.direction;
  }
  return {{static_cast<float>(center.x), static_cast<float>(center.y - 2.0), static_cast<float>(-center.z)},
          static_cast<float>(radius)};
}

// ShaderEntity: 64 bytes; its world is left-handed.
layout::Buffer wicked_entities(const std::vector<Lamp>& all) {
  layout::Buffer out{"entities", "entities.bin", 0, {}};
  std::size_t row = 0;
  for (const Lamp& lamp : all) {
    const bool is_spot = lamp.half_angle_rad > 0.0;
    const float position[] = {static_cast<float>(lamp.position.x), static_cast<float>(lamp.position.y),
                              static_cast<float>(-lamp.position.z)};
    for (std::size_t i = 0; i < 3; ++i) layout::testing::put(out.bytes, row + 4 * i, position[i]);
    layout::testing::put(out.bytes, row + 12, static_cast<std::uint8_t>(is_spot ? 2 : 1));
    const auto put_half = [&](std::size_t at, double value) {
      layout::testing::put(out.bytes, row + at, view::half_of(static_cast<float>(value)));
    };
    put_half(14, lamp.range_m);
    put_half(16, -lamp.direction.x), put_half(18, -lamp.direction.y), put_half(20, lamp.direction.z);
    put_half(22, is_spot ? std::cos(lamp.half_angle_rad) : 0.0);
    layout::testing::put(out.bytes, row + 60, 0u);
    row += 64;
  }
  return out;
}

// With a half-precision range that is not above the one of the ball.
std::vector<Lamp> wicked_lamps() {
  std::vector<Lamp> all = lamps(0.3);
  for (Lamp& lamp : all) lamp.range_m = std::floor(lamp.range_m * 64.0) / 64.0;
  return all;
}

constexpr std::uint32_t k_wicked_decals = 37;  // so that lights begin in the middle of a word

Judged wicked_without(std::optional<std::uint32_t> forgotten) {
  Json json = template_of("wicked");
  fill_camera(json, {1280, 720});
  constexpr std::uint32_t k_tiles = 40 * 23;
  json["grid"]["slices"]["boundaries_m"] = {0.5, 60.0};
  json["lists"][0]["rows"]["at"] = 32 * k_tiles;
  json["lists"][0]["first_bit"] = k_wicked_decals;
  const std::vector<Lamp> all = wicked_lamps();
  json["lights"]["rows"][0]["count"] = all.size();
  const Json projection = json["camera"]["projection"];
  const Make culled = [&](const DumpFrame& frame) {
    assign::Lists out{{0}, {}};
    for (int y = 0; y < 23; ++y)
      for (int x = 0; x < 40; ++x) {
        const auto clip = [](float pixel, float size) { return 2.0f * pixel / size - 1.0f; };
        const WickedCorner lo{clip(32.0f * static_cast<float>(x), 1280.0f),
                              -clip(32.0f * static_cast<float>(y + 1), 720.0f)};
        const WickedCorner hi{clip(32.0f * static_cast<float>(x + 1), 1280.0f),
                              -clip(32.0f * static_cast<float>(y), 720.0f)};
        for (std::uint32_t light = 0; light < all.size(); ++light) {
          const std::uint32_t of_dump = frame.dump_index[light];
          if (of_dump != forgotten && wicked_ball(all[of_dump]).touches(projection, lo, hi, 0.5f, 60.0f))
            out.lights.push_back(light);
        }
        out.begin.push_back(static_cast<std::uint32_t>(out.lights.size()));
      }
    return out;
  };
  return judged(json, {wicked_entities(all)}, culled,
                [&](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
                  layout::Described out;
                  out.buffers = {{"tiles", "tiles.bin", 0, {}}};
                  for (std::uint32_t tile = 0; tile < k_tiles; ++tile) {
                    std::uint32_t words[8] = {~0u, 0x1fu, 0, 0, 0, 0, 0, 0x8000'0000u};  // decals, and a force field
                    for (const std::uint32_t light : lists.of(tile))
                      words[(light + k_wicked_decals) / 32] |= 1u << (light + k_wicked_decals) % 32;
                    for (std::size_t w = 0; w < 8; ++w)
                      layout::testing::put(out.buffers[0].bytes, 32 * std::size_t{k_tiles + tile} + 4 * w, words[w]);
                  }
                  return out;
                });
}

TEST(Engines, lists_of_wicked_for_transparent_surfaces_are_right_and_a_forgotten_light_is_found) {
  const Judged found = wicked_without(std::nullopt);
  expect_counts(found, "wicked");
  EXPECT_GT(found.checked.spots, 30u);
  EXPECT_EQ(found.checked.sets[0].verdict, "right") << found.text;
  EXPECT_GT(found.counted.false_positives, found.counted.true_pairs / 10) << "balls around cones";
  const std::vector<Lamp> all = wicked_lamps();
  const auto ahead = std::ranges::find_if(all, [](const Lamp& lamp) {
    return lamp.half_angle_rad == 0.0 && lamp.position.z < -15.0 && std::abs(lamp.position.x) < 5.0;
  });
  ASSERT_NE(ahead, all.end());
  const auto forgotten = static_cast<std::uint32_t>(ahead - all.begin());
  const Judged lost = wicked_without(forgotten);
  expect_counts(lost, "wicked");
  EXPECT_EQ(lost.checked.sets[0].verdict, "lost") << lost.text;
  EXPECT_EQ(lost.checked.sets[0].lost.at(0).light, forgotten);
}

TEST(Engines, lists_of_unreal_are_judged_in_their_own_units_and_layout) {
  Json json = template_of("unreal");
  fill_camera(json, {1280, 720});
  // The same camera and lamps in centimetres and a left-handed world.
  json["camera"]["world_to_view"][13] = -200.0;
  json["camera"]["far_m"] = 6000.0;
  json["camera"]["projection"][14] = 100.0 * json["camera"]["projection"][14].get<double>();
  list_lights(json, lamps(0.3));
  for (Json& light : json["lights"]["listed"]) {
    for (Json& number : light["position"]) number = 100.0 * number.get<double>();
    light["position"][2] = -light["position"][2].get<double>();
    light["range_m"] = 100.0 * light["range_m"].get<double>();
    if (light.contains("direction")) light["direction"][2] = -light["direction"][2].get<double>();
  }
  for (const char* method : {"aabb", "exact"}) {
    const Judged found =
        judged(json, {}, method, [](const assign::Lists& lists, const DumpFrame&, const layout::CellOrder&) {
          layout::Described out;
          out.buffers = {{"grid", "grid.bin", 0, {}}, {"data", "data.bin", 0, {}}};
          for (std::uint32_t cell = 0; cell < lists.cell_count(); ++cell) {
            layout::testing::put(out.buffers[0].bytes, 8 * std::size_t{cell},
                                 static_cast<std::uint32_t>(lists.of(cell).size()));
            layout::testing::put(out.buffers[0].bytes, 8 * std::size_t{cell} + 4, lists.begin[cell]);
          }
          for (std::size_t i = 0; i < lists.lights.size(); ++i)
            layout::testing::put(out.buffers[1].bytes, 2 * i, static_cast<std::uint16_t>(lists.lights[i]));
          return out;
        });
    expect_counts(found, method);
    EXPECT_EQ(found.checked.sets[0].verdict, "right") << found.text;
    EXPECT_EQ(found.checked.cells, (result::CellIndex{20, 12, 32}));
  }
}

TEST(Engines, every_template_says_what_is_to_be_filled_in_and_is_a_dump_once_it_is) {
  EXPECT_GE(dump_templates().size(), 10u);
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
