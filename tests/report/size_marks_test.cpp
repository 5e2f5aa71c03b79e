// What `size` says a capacity rests on: the most seen, the most that a search found, and the most that can be; and of
// several views and viewports.

#include <gtest/gtest.h>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/random.h"
#include "records.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/size_report/size_report.h"

namespace clusterbench::report {
namespace {

using MarksJson = nlohmann::json;

// Of aabb alone, to the byte.
SizeRequest marks_request(const std::string& format) {
  return {"/aabb/", false, format, "none"};
}

std::string marks_of(const run::Result& result, const SizeRequest& request) {
  return size_report(record_of(result, {}), request);
}

MarksJson sized_json(const run::Result& result, SizeRequest request) {
  request.format = "json";
  const MarksJson json = MarksJson::parse(marks_of(result, request));
  EXPECT_EQ(config::schema_violations(config::row_of(config::Document::size).schema(), json),
            std::vector<std::string>{});
  return json["structures"][0];
}

FoundFrame found_frame(std::uint64_t indices) {
  FoundFrame found;
  found.case_name = "hall/walk/frustum 64px/aabb/packed";
  found.evaluations = 5000;
  found.space_flags = "--keep-height";
  found.eye_m = {1.0, 2.0, 3.0};
  found.direction = {0.0, 0.0, -1.0};
  found.value = indices;
  found.needs = {{"indices", indices, 480}, {"headers", 24, 24}};
  return found;
}

constexpr const char* k_formats[] = {"table", "cpp", "hlsl", "glsl"};

TEST(SizeMarks, every_format_says_the_most_seen_what_was_searched_and_the_most_that_can_be) {
  for (const char* format : k_formats) {
    const std::string text = marks_of(testing::result_by_hand(), marks_request(format));
    for (const char* part : {"most seen", "indices: 40 in 2 frames", "most found by a search",
                             "not searched: --worst-case", "can never overflow", "indices: 480 elements, 480 bytes"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  }
  const MarksJson buffer = sized_json(testing::result_by_hand(), marks_request("json"))["buffers"][0];
  EXPECT_EQ(buffer["never_overflows"], MarksJson({{"elements", 480}, {"bytes", 480}}));
  EXPECT_FALSE(buffer.contains("found"));
}

TEST(SizeMarks, a_capacity_is_made_of_what_a_search_found_where_that_is_more_and_says_so) {
  for (const char* format : k_formats) {
    SizeRequest request = marks_request(format);
    request.scope.found = {found_frame(100)};
    const std::string text = marks_of(testing::result_by_hand(), request);
    for (const char* part :
         {"indices: 40 in 2 frames", "indices: 100 in 5000 frames tried (seed 1, --keep-height), 2.50 times the most",
          "at (1, 2, 3) m along (0, 0, -1)", "found by the search x 2"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
    EXPECT_EQ(text.find("not searched"), std::string::npos) << text;
    request.scope.found = {found_frame(30)};
    EXPECT_NE(marks_of(testing::result_by_hand(), request).find("high water x 2"), std::string::npos);
  }
  SizeRequest request = marks_request("json");
  request.margin = 1.0;
  for (const std::uint64_t found : {30u, 100u, 480u}) {
    request.scope.found = {found_frame(found)};
    const MarksJson structure = sized_json(testing::result_by_hand(), request);
    EXPECT_EQ(structure["buffers"][0]["capacity"], std::max<std::uint64_t>(40, found));
    EXPECT_EQ(structure["buffers"][0]["found"], found);
    EXPECT_EQ(structure["search"]["evaluations"], 5000);
    EXPECT_EQ(structure["search"]["flags"], "--keep-height");
    EXPECT_EQ(structure["search"]["direction"], MarksJson({0.0, 0.0, -1.0}));
  }
}

TEST(SizeMarks, a_case_that_cannot_be_searched_says_why) {
  SizeRequest request = marks_request("table");
  request.scope.found = {found_frame(100)};
  request.scope.found[0].refusal = "its lists follow visible surfaces";
  request.scope.found[0].needs.clear();
  const std::string text = marks_of(testing::result_by_hand(), request);
  EXPECT_NE(text.find("not searched: its lists follow visible surfaces"), std::string::npos) << text;
  EXPECT_EQ(sized_json(testing::result_by_hand(), request)["search"]["refusal"], "its lists follow visible surfaces");
}

// Lights that a cull leaves in other frames, and cells of other depths, can be more.
TEST(SizeMarks, behind_a_pre_cull_and_with_cells_of_surfaces_nothing_is_said_to_never_overflow) {
  const auto table_of = [](auto change) {
    run::Result result = testing::result_by_hand();
    for (run::CaseResult& one : result.cases) change(one);
    return marks_of(result, {"/aabb/", false, "table", "none"});
  };
  const std::string culled = table_of([](run::CaseResult&one) { one.pre_cull.emplace(); }),
                    tiled = table_of([](run::CaseResult&one) { one.assigner = "tiled"; });
  for (const std::string& text : {culled, tiled}) {
    EXPECT_NE(text.find("can never overflow: indices: not known"), std::string::npos) << text;
    EXPECT_EQ(text.find("480 elements"), std::string::npos) << text;
  }
}

measure::BufferHighWater series_of_marks(const std::vector<std::uint64_t>& elements, std::uint64_t most,
                                         std::uint64_t step = 1) {
  measure::BufferHighWater buffer;
  buffer.name = "indices";
  buffer.element_bytes = 2;
  buffer.theoretical_max = most;
  buffer.step = step;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    buffer.along_path.add_frame(elements[i]);
    if (elements[i] <= buffer.high_water) continue;
    buffer.high_water = elements[i];
    buffer.worst_frame = static_cast<int>(i);
  }
  return buffer;
}

run::CaseResult camera_of_marks(const std::string& name, const std::vector<std::uint64_t>& elements,
                                std::uint64_t step = 1, const std::string& viewport = "") {
  run::CaseResult out = testing::case_by_hand(name + viewport, "aabb", 1.0);
  out.camera = name;
  out.name = "hall/" + name + "/" + viewport + "frustum 64px/aabb/packed";
  out.frames = static_cast<int>(elements.size());
  out.buffers.each = {series_of_marks(elements, 1000, step)};
  return out;
}

run::Result result_of_cameras(const std::vector<run::CaseResult>& cases) {
  run::Result result = testing::result_by_hand();
  result.cases = cases;
  result.planned_ids.clear();
  for (const run::CaseResult& one : cases) result.planned_ids.push_back(one.id);
  return result;
}

TEST(SizeMarks, high_water_of_fewer_frames_shows_whether_more_would_find_more) {
  std::vector<std::uint64_t> calm(33, 50), wild(33, 50);
  calm[3] = 49;
  wild[8] = 60, wild[4] = 70, wild[2] = 80, wild[1] = 90;
  const MarksJson growth = sized_json(result_of_cameras({camera_of_marks("walk", wild)}),
                                      marks_request("json"))["buffers"][0]["high_water_of_every"];
  EXPECT_EQ(growth, MarksJson::parse(R"([{"every": 8, "high_water": 60}, {"every": 4, "high_water": 70},
                                    {"every": 2, "high_water": 80}, {"every": 1, "high_water": 90}])"));
  const std::string grows = marks_of(result_of_cameras({camera_of_marks("walk", wild)}), marks_request("table")),
                    stays = marks_of(result_of_cameras({camera_of_marks("walk", calm)}), marks_request("table"));
  EXPECT_NE(grows.find("90 in 33 frames; of every 8th frame 60, 4th 70, 2nd 80: STILL GROWING"), std::string::npos)
      << grows;
  EXPECT_NE(stays.find("of every 8th frame 50, 4th 50, 2nd 50\n"), std::string::npos) << stays;
  for (const std::size_t frames : {std::size_t{1}, std::size_t{20}, std::size_t{29}}) {
    std::vector<std::uint64_t> few(frames, 50);
    few.back() = 49 + (frames == 1);
    const std::string text = marks_of(result_of_cameras({camera_of_marks("walk", few)}), marks_request("table"));
    EXPECT_NE(text.find(": too few to tell whether other frames need more\n"), std::string::npos) << text;
  }
}

SizeRequest with_views(const std::vector<std::string>& views) {
  SizeRequest request = marks_request("json");
  request.scope.views = views;
  return request;
}

TEST(SizeMarks, views_of_one_buffer_are_added_frame_by_frame) {
  const run::Result result =
      result_of_cameras({camera_of_marks("left", {10, 40, 20}), camera_of_marks("right", {30, 5, 21}),
                         camera_of_marks("map", {33}), camera_of_marks("other", {60, 1, 1})});
  const MarksJson eyes = sized_json(result, with_views({"left,right"}));
  EXPECT_EQ(eyes["views"], MarksJson::parse(R"([["left", "right"]])"));
  EXPECT_EQ(eyes["buffers"][0]["high_water"], 60) << "the other camera alone; the eyes need 45";
  EXPECT_EQ(eyes["frames"], 3 + 1 + 3);
  const MarksJson all = sized_json(result, with_views({"*"}))["buffers"][0];
  EXPECT_EQ(all["high_water"], 10 + 30 + 33 + 60) << "a camera that stands still is in every frame";
  EXPECT_EQ(all["views_apart"], 40 + 30 + 33 + 60);
  EXPECT_EQ(all["worst"], MarksJson::parse(R"({"camera": "left+right+map+other", "frame": 0})"));
  EXPECT_EQ(all["theoretical_max"], 4000);
  EXPECT_EQ(all["frames"]["min"], 20 + 21 + 33 + 1);
}

TEST(SizeMarks, frames_of_cameras_in_one_frame_and_of_single_ones_are_not_mixed) {
  const run::Result result =
      result_of_cameras({camera_of_marks("left", {10, 40, 20}), camera_of_marks("right", {30, 5, 21}),
                         camera_of_marks("map", {33, 2, 3}), camera_of_marks("other", {1, 1, 1})});
  SizeRequest request = with_views({"left,right"});
  const MarksJson buffer = sized_json(result, request)["buffers"][0];
  EXPECT_EQ(buffer["high_water"], 45);
  EXPECT_EQ(buffer["frames"]["min"], 40) << "of both eyes: 40, 45 and 41";
  EXPECT_EQ(buffer["frames"]["p50"], 41);
  ASSERT_EQ(buffer["groups"].size(), 3u);
  EXPECT_EQ(buffer["groups"][0]["cameras"], MarksJson({"left", "right"}));
  EXPECT_EQ(buffer["groups"][0]["frames"], buffer["frames"]);
  EXPECT_EQ(buffer["groups"][0]["count"], 3);
  EXPECT_EQ(buffer["groups"][1]["cameras"], MarksJson({"map"}));
  EXPECT_EQ(buffer["groups"][1]["frames"]["min"], 2);
  EXPECT_EQ(buffer["groups"][1]["high_water"], 33);
  EXPECT_EQ(buffer["groups"][2]["frames"]["max"], 1);
  EXPECT_FALSE(sized_json(result, with_views({}))["buffers"][0].contains("groups"));
  request.format = "table";
  const std::string table = marks_of(result, request);
  EXPECT_NE(table.find("45 in 3 frames of left+right"), std::string::npos) << table;
  EXPECT_NE(table.find("left + right          indices       3   40      41   45   45          45\n"), std::string::npos)
      << table;
  request.format = "cpp";
  const std::string code = marks_of(result, request);
  EXPECT_NE(code.find("frames    of map: min 2, median 3, p90 33, p99 33, max 33\n"), std::string::npos) << code;
}

TEST(SizeMarks, views_whose_paths_differ_need_the_sum_of_their_marks) {
  const run::Result result = result_of_cameras({camera_of_marks("one", {10, 40, 20}), camera_of_marks("two", {30, 5})});
  SizeRequest request = with_views({"one,two"});
  EXPECT_EQ(sized_json(result, request)["buffers"][0]["high_water"], 70);
  request.format = "table";
  const std::string table = marks_of(result, request);
  EXPECT_NE(table.find("70 in 3 frames of one+two, if each view needs its most at the same time"), std::string::npos)
      << table;
}

// Room for the longest list in every cell: 10 cells each, of which the longest lists have 4 and 3 lights.
TEST(SizeMarks, views_with_room_per_cell_have_room_for_the_longest_list_of_any) {
  const run::Result result =
      result_of_cameras({camera_of_marks("left", {40, 20}, 10), camera_of_marks("right", {30, 30}, 10)});
  EXPECT_EQ(sized_json(result, with_views({"left,right"}))["buffers"][0]["high_water"], 20 * 4);
}

TEST(SizeMarks, a_search_counts_for_each_view) {
  SizeRequest request = with_views({"left,right"});
  FoundFrame found = found_frame(50);
  found.case_name = "hall/left/frustum 64px/aabb/packed";
  request.scope.found = {found};
  const run::Result result = result_of_cameras({camera_of_marks("left", {10, 40}), camera_of_marks("right", {10, 30})});
  EXPECT_EQ(sized_json(result, request)["buffers"][0]["found"], 100) << "the other view in as bad a place";
  FoundFrame right = found_frame(70);
  right.case_name = "hall/right/frustum 64px/aabb/packed";
  request.scope.found.push_back(right);
  EXPECT_EQ(sized_json(result, request)["buffers"][0]["found"], 120) << "each in its own";
  request.format = "table";
  const std::string text = marks_of(result, request);
  EXPECT_NE(
      text.find("indices: 120 in 5000 frames tried (seed 1, --keep-height) for each of 2 cameras, 2 views together, "
                "each in its own worst frame, 1.71 times the most seen; the worst: camera right at (1, 2, 3) m"),
      std::string::npos)
      << text;
  FoundFrame refused = right;
  refused.refusal = "the scene changed";
  request.scope.found.push_back(refused);
  EXPECT_EQ(marks_of(result, request), text) << "a search that was not made says nothing of the others";
  request.scope.found[1].evaluations = 4999;
  const std::string unequal = marks_of(result, request);
  EXPECT_NE(unequal.find(", by one of the searches of 2 cameras, 2 views together"), std::string::npos) << unequal;
}

TEST(SizeMarks, each_camera_is_searched_and_of_its_viewports_the_one_that_needs_most) {
  run::CaseResult small = camera_of_marks("left", {10, 40}), large = camera_of_marks("left", {10, 50});
  small.buffers.index_entries.high_water = 40, large.buffers.index_entries.high_water = 50;
  small.viewport = {640, 360}, large.viewport = {1920, 1080};
  small.name = "hall/left/640x360 frustum 64px/aabb/packed";
  large.name = "hall/left/1920x1080 frustum 64px/aabb/packed";
  SizeRequest request = marks_request("json");
  request.scope.over_viewports = true;
  const auto names_of = [&](const run::Result& result) {
    std::vector<std::string> names;
    for (const SizedCase& sized : sized_cases(record_of(result, {}), request)) names.push_back(sized.name);
    return names;
  };
  EXPECT_EQ(names_of(result_of_cameras({small, large})), std::vector{large.name});
  request.scope.over_viewports = false;
  const run::Result two = result_of_cameras({camera_of_marks("left", {10, 40}), camera_of_marks("right", {10, 30})});
  EXPECT_EQ(names_of(two), (std::vector{two.cases[0].name, two.cases[1].name}));
}

TEST(SizeMarks, cells_that_stay_in_the_world_say_as_much_of_all_views) {
  run::CaseResult still = camera_of_marks("walk", {40, 40, 40});
  EXPECT_NE(marks_of(result_of_cameras({still}), marks_request("table")).find("as of a camera that stands still"),
            std::string::npos);
  still.grid["kind"] = "world";
  EXPECT_EQ(marks_of(result_of_cameras({still}), marks_request("table")).find("stands still"), std::string::npos);
  still.grid["follow"] = "lights";
  EXPECT_NE(marks_of(result_of_cameras({still}), marks_request("table")).find("stands still"), std::string::npos);
}

// Of one case or of two cameras, each with a place of its own.
std::vector<FoundFrame> shuffled_finds(const std::vector<std::string>& cameras, SplitMix64& random) {
  std::vector<FoundFrame> all;
  const std::uint64_t count = 1 + random.below(6);
  for (std::uint64_t i = 0; i < count; ++i) {
    FoundFrame found = found_frame(1 + random.below(400));
    found.case_name = "hall/" + cameras[random.below(cameras.size())] + "/frustum 64px/aabb/packed";
    found.seed = i;
    if (random.below(4) == 0) {
      found.refusal = "its lists follow visible surfaces";
      found.needs.clear();
      found.value = 0;
    }
    all.push_back(found);
  }
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
  return all;
}

TEST(SizeMarks, of_any_finds_in_any_order_the_largest_decides_and_is_named) {
  SplitMix64 random(7);
  const run::Result result = result_of_cameras({camera_of_marks("left", {10, 40}), camera_of_marks("right", {35, 20})});
  SizeRequest request = marks_request("json");
  request.margin = 1.0;
  for (int round = 0; round < 200; ++round) {
    request.scope.found = shuffled_finds({"left", "right"}, random);
    const auto value_of = [](const FoundFrame& found) { return found.value; };
    const auto largest = std::ranges::max_element(request.scope.found, {}, value_of);
    const MarksJson structure = sized_json(result, request);
    EXPECT_EQ(structure["buffers"][0]["capacity"], std::max<std::uint64_t>(40, largest->value));
    if (largest->value == 0) {
      EXPECT_FALSE(structure["buffers"][0].contains("found"));
      EXPECT_TRUE(structure["search"].contains("refusal"));
      continue;
    }
    EXPECT_EQ(structure["buffers"][0]["found"], largest->value);
    EXPECT_EQ(structure["search"]["seed"], largest->seed) << round;
    EXPECT_EQ(structure["buffers"][0]["found_by"], structure["search"]);
  }
}

TEST(SizeMarks, an_engines_setting_names_the_largest_of_several_finds) {
  run::Result result = result_of_cameras({camera_of_marks("walk", {10, 40})});
  FoundFrame less = found_frame(50), more = found_frame(60), refused = found_frame(0);
  less.seed = 3, more.seed = 4;
  refused.refusal = "its seconds were over";
  SizeRequest request = marks_request("table");
  request.engine = "bevy";
  result.cases[0].preset = "bevy";
  std::vector<std::vector<FoundFrame>> orders{{less, more}, {more, less}, {refused, less, more}, {more, refused, less}};
  for (const std::vector<FoundFrame>& order : orders) {
    request.scope.found = order;
    const std::string text = marks_of(result, request);
    EXPECT_NE(text.find("60 entries in all lists in 5000 frames tried (seed 4, --keep-height)"), std::string::npos)
        << text;
  }
}

TEST(SizeMarks, views_that_name_no_camera_or_no_two_are_refused_with_those_that_there_are) {
  const run::Result result = result_of_cameras({camera_of_marks("left", {10}), camera_of_marks("right", {30})});
  const std::pair<const char*, const char*> refused[] = {
      {"left", "'left' names no two cameras of a scene; hall/frustum 64px/aabb/packed has left, right"},
      {"left,rihgt", "'rihgt' matches no camera; there are left, right"},
      {"left,typo,right", "'typo' matches no camera; there are left, right"},
      {"left,right,", "'' matches no camera"},
      {"*,up*,left,down", "'up*', 'down' match no camera"}};
  for (const auto& [views, message] : refused) {
    try {
      sized_json(result, with_views({"left,right", views}));
      ADD_FAILURE() << views;
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), "--views");
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(sized_json(result, with_views({"left,rig*"}))["views"][0], MarksJson({"left", "right"}));
}

TEST(SizeMarks, an_engines_own_value_without_room_for_the_margin_is_not_called_enough) {
  nlohmann::ordered_json json = result::to_json(record_of(result_of_cameras({camera_of_marks("walk", {10, 40})}), {}));
  SizeRequest request = marks_request("table");
  request.engine = "playcanvas";
  json["cases"][0]["preset"] = "playcanvas";
  json["cases"][0]["lights"] = 2000;
  const auto told = [&](int longest) {
    json["cases"][0]["occupancy"]["lights_per_cell"]["max"] = longest;
    return size_report(test::result_of(json), request);
  };
  EXPECT_NE(
      told(200).find("maxLightsPerCell: 255 (the engine's own 255 is enough for what was seen, not for the margin)"),
      std::string::npos)
      << told(200);
  EXPECT_NE(told(100).find("maxLightsPerCell: 200 (the engine's own 255 is enough: leave it)"), std::string::npos)
      << told(100);
  EXPECT_NE(told(100).find("    with the margin: 100 x 2\n"), std::string::npos) << told(100);
  EXPECT_NE(told(100).find("\nNothing to set: what the engine comes with is enough"), std::string::npos) << told(100);
}

// Bevy's tiles follow the viewport, so each has a structure of its own; its setting is one of the whole program.
TEST(SizeMarks, of_several_structures_that_share_an_engines_setting_the_largest_value_is_told_to_be_set) {
  nlohmann::ordered_json json = result::to_json(record_of(
      result_of_cameras({camera_of_marks("walk", {10, 40}, 1, "960x540 "), camera_of_marks("walk", {10, 40})}), {}));
  for (std::size_t i = 0; i < 2; ++i) {
    json["cases"][i]["preset"] = "bevy";
    json["cases"][i]["buffers"]["index_entries"]["high_water"] = 40000 - 10000 * i;
  }
  SizeRequest request = marks_request("table");
  request.engine = "bevy";
  const std::string text = size_report(test::result_of(json), request);
  EXPECT_NE(
      text.find("The engine has one setting for all 2 above, which is the largest:\n"
                "  GlobalClusterSettings::view_cluster_bindings_max_indices: 80000 (the engine comes with 16384)"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("the fallback on the CPU, whose lists are uploaded; the default since 0.19 is bevy-gpu"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  ClusterConfig: leave it alone"), std::string::npos) << text;
  request.format = "json";
  const MarksJson structures = MarksJson::parse(size_report(test::result_of(json), request))["structures"];
  for (const MarksJson& structure : structures)
    EXPECT_EQ(structure["settings"]["limits"][0]["value_for_all"], 80000) << structure;
  json["cases"].erase(1);
  request.format = "table";
  EXPECT_EQ(size_report(test::result_of(json), request).find("one setting for all"), std::string::npos);
}

TEST(SizeMarks, a_camera_whose_name_has_a_comma_is_told_how_to_be_named) {
  const run::Result result = result_of_cameras({camera_of_marks("left, up", {10}), camera_of_marks("right", {30})});
  try {
    sized_json(result, with_views({"left, up,right"}));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("write ? for that of 'left, up', as in 'left? up'"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(sized_json(result, with_views({"left? up,right"}))["views"][0], MarksJson({"left, up", "right"}));
}

TEST(SizeMarks, a_camera_that_has_no_part_in_the_grid_of_others_makes_no_mark_of_it) {
  run::CaseResult right = camera_of_marks("right", {30, 10});
  right.grid["note"] = "the grid of right";
  const run::Result result =
      result_of_cameras({camera_of_marks("walk", {500, 600}), camera_of_marks("left", {10, 20}), right});
  SizeRequest request = with_views({"left,right"});
  request.scope.grid_of = "left";
  EXPECT_EQ(sized_json(result, request)["buffers"][0]["high_water"], 20);
  EXPECT_EQ(sized_json(result, request)["frames"], 2);
  request.format = "table";
  GuestSamples lacking{result.cases[1].name, "right", 1000, 50, 400, 20, 20, 1};
  request.scope.guests = {lacking};
  std::string text = marks_of(result, request);
  EXPECT_NE(
      text.find("(1 camera, 2 frames; in its grid, without lists of their own: right; not counted, since they have "
                "no part in it: walk)"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("  WARNING: samples of right in this grid"), std::string::npos) << text;
  EXPECT_NE(text.find("\nNext: one grid that holds all views"), std::string::npos) << text;
  EXPECT_NE(text.find("--add both=0,0,BACK"), std::string::npos) << text;
  EXPECT_EQ(text.find("the grid of right"), std::string::npos) << text;
  // Up to a thousandth is what looking up in single precision can lose.
  for (const std::uint64_t missed : {0u, 1u}) {
    request.scope.guests[0].needed = 1000;
    request.scope.guests[0].missed = request.scope.guests[0].missed_outside = missed;
    text = marks_of(result, request);
    EXPECT_EQ(text.find("WARNING"), std::string::npos) << text;
    EXPECT_EQ(text.find("one grid that holds"), std::string::npos) << text;
  }
}

TEST(SizeMarks, notes_of_the_grid_name_the_cameras_that_they_are_of) {
  run::CaseResult left = camera_of_marks("left", {10}), right = camera_of_marks("right", {30}),
                  map = camera_of_marks("map", {5});
  left.grid["note"] = right.grid["note"] = "the grid ends at 91.32 m";
  map.grid["note"] = "the grid ends at 40 m";
  SizeRequest request = marks_request("table");
  const std::string both = marks_of(result_of_cameras({left, right}), request);
  EXPECT_NE(both.find("  grid: the grid ends at 91.32 m\n"), std::string::npos) << both;
  for (const char* format : k_formats) {
    request.format = format;
    const std::string text = marks_of(result_of_cameras({left, right, map}), request);
    EXPECT_NE(text.find("  grid: cameras left, right: the grid ends at 91.32 m\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  grid: camera map: the grid ends at 40 m\n"), std::string::npos) << text;
  }
}

TEST(SizeMarks, one_allocation_serves_all_viewports_where_it_is_asked_for) {
  run::CaseResult small = camera_of_marks("walk", {10, 40, 20}, 1, "960x540 "),
                  large = camera_of_marks("walk", {70, 30, 20}, 1, "1920x1080 ");
  small.viewport = {960, 540};
  large.viewport = {1920, 1080};
  const run::Result result = result_of_cameras({small, large});
  SizeRequest request = marks_request("json");
  request.all = true;
  EXPECT_EQ(MarksJson::parse(marks_of(result, request))["structures"].size(), 2u);
  request.scope.over_viewports = true;
  const MarksJson structure = sized_json(result, request);
  EXPECT_EQ(structure["name"], "hall/frustum 64px/aabb/packed");
  EXPECT_EQ(structure["buffers"][0]["high_water"], 70);
  EXPECT_EQ(structure["buffers"][0]["frames"]["min"], 20);
  EXPECT_EQ(structure["buffers"][0]["frames"]["p50"], 40) << "each frame in its largest viewport";
  EXPECT_EQ(structure["cameras"], MarksJson({"walk"}));
  EXPECT_EQ(structure["frames"], 3) << "the same frames, larger or smaller";
  EXPECT_FALSE(structure.contains("grid_notes"));
}

// As 3610 entries at 1920x1080 and 960x540, and 3696 at 1872x1053: what is between is cut into other tiles.
TEST(SizeMarks, tiles_of_pixels_in_several_viewports_are_not_said_to_hold_for_those_between) {
  run::CaseResult small = camera_of_marks("walk", {10}, 1, "960x540 "),
                  large = camera_of_marks("walk", {70}, 1, "1920x1080 ");
  small.viewport = {960, 540};
  large.viewport = {1920, 1080};
  for (run::CaseResult* one : {&small, &large}) one->grid["tiles"] = {{"pixels", {64, 64}}};
  SizeRequest request = marks_request("json");
  request.scope.over_viewports = true;
  const MarksJson notes = sized_json(result_of_cameras({small, large}), request)["grid_notes"];
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].get<std::string>().find("name the sizes that occur, or keep a margin"), std::string::npos);
  EXPECT_FALSE(sized_json(result_of_cameras({large}), request).contains("grid_notes"));
  for (run::CaseResult* one : {&small, &large}) one->grid["tiles"] = {{"count", {16, 9}}};
  EXPECT_FALSE(sized_json(result_of_cameras({small, large}), request).contains("grid_notes"));
}

// Of two methods with the same lists, what a search found for one of them.
TEST(SizeMarks, a_find_does_not_change_which_structure_is_printed_and_what_was_searched_is) {
  run::Result result = testing::result_by_hand();
  for (run::CaseResult& one : result.cases) one.timing.reset();
  SizeRequest request{"", false, "json", "none"};
  const auto printed = [&](const std::string& searched) {
    request.scope.found = {found_frame(100)};
    request.scope.found[0].case_name = "hall/walk/frustum 64px/" + searched + "/packed";
    return sized_json(result, request);
  };
  for (const char* searched : {"brute-force", "aabb"}) {
    const MarksJson structure = printed(searched);
    EXPECT_EQ(structure["assigner"], searched) << "its capacity is the larger one";
    EXPECT_EQ(structure["buffers"][0]["capacity"], 200);
  }
  request.format = "table";
  const std::string table = marks_of(result, request);
  EXPECT_EQ(table.find("not searched"), std::string::npos) << table;
  EXPECT_NE(table.find("Capacity: the larger of high water and find x 2"), std::string::npos) << table;
  EXPECT_NE(table.find("Allocate these capacities"), std::string::npos) << table;
}

TEST(SizeMarks, a_search_for_something_else_says_so_and_does_not_end_the_search) {
  for (const char* measure : {"lights", "longest"}) {
    SizeRequest request = marks_request("table");
    request.scope.found = {found_frame(30)};
    request.scope.found[0].measure = measure;
    const std::string table = marks_of(testing::result_by_hand(), request);
    EXPECT_NE(table.find(std::string("30 in the worst frame of a search with --measure ") + measure), std::string::npos)
        << table;
    EXPECT_NE(table.find("was not searched for: --worst-case"), std::string::npos) << table;
    EXPECT_NE(table.find("searches for frames that need more"), std::string::npos) << table;
  }
}

TEST(SizeMarks, of_cameras_that_stand_still_it_is_said_that_they_tell_nothing_of_other_views) {
  const auto table = [](const std::vector<run::CaseResult>& cameras) {
    return marks_of(result_of_cameras(cameras), marks_request("table"));
  };
  const std::string one = table({camera_of_marks("stands", {33})}), same = table({camera_of_marks("stands", {33, 33})}),
                    two = table({camera_of_marks("here", {33}), camera_of_marks("there", {40, 40})}),
                    moves = table({camera_of_marks("here", {33}), camera_of_marks("walk", {40, 39})});
  EXPECT_NE(one.find("beyond the path: indices: one frame says nothing of other views; animate the camera"),
            std::string::npos)
      << one;
  EXPECT_NE(same.find("all 2 frames need the same, as of a camera that stands still"), std::string::npos) << same;
  EXPECT_NE(two.find("each camera needs the same in all its frames, as one that stands still"), std::string::npos)
      << two;
  EXPECT_EQ(moves.find("nothing of other views"), std::string::npos) << moves;
  const MarksJson tail = sized_json(result_of_cameras({camera_of_marks("stands", {33})}),
                                    marks_request("json"))["buffers"][0]["beyond_the_path"];
  EXPECT_TRUE(tail.contains("refusal")) << tail;
}

TEST(SizeMarks, frames_of_one_number_that_are_at_other_times_are_not_added) {
  nlohmann::ordered_json result = result::to_json(
      record_of(result_of_cameras({camera_of_marks("one", {10, 40, 20}), camera_of_marks("two", {30, 5, 21})}), {}));
  SizeRequest request = with_views({"one,two"});
  const auto buffer = [&] {
    return MarksJson::parse(size_report(test::result_of(result), request))["structures"][0]["buffers"][0];
  };
  const auto table = [&] {
    SizeRequest asked = request;
    asked.format = "table";
    return size_report(test::result_of(result), asked);
  };
  const char* untold = "does not tell whether frames of one number are of one time";
  for (nlohmann::ordered_json& one : result["cases"]) one.erase("camera_path");
  EXPECT_NE(table().find(untold), std::string::npos) << table();
  for (nlohmann::ordered_json& one : result["cases"]) one["camera_path"] = {{"from_s", 0.0}, {"to_s", 20.0}};
  EXPECT_EQ(buffer()["high_water"], 45);
  EXPECT_EQ(table().find(untold), std::string::npos) << table();
  result["cases"][1]["camera_path"]["to_s"] = 40.0;
  EXPECT_EQ(buffer()["high_water"], 70);
  EXPECT_EQ(buffer()["views_not_paired"], "their paths go from 0 s to 20 s and from 0 s to 40 s");
  EXPECT_NE(table().find("if each view needs its most at the same time (their paths go from 0 s"), std::string::npos)
      << table();
}

}  // namespace
}  // namespace clusterbench::report
