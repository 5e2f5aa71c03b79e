// The search against scenes whose worst frame is known, and against `run` on what it writes.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "result/figures/case_figure.h"
#include "run/records/records.h"
#include "run/runner.h"
#include "scene/writers/write_gltf.h"
#include "search/replay_config.h"
#include "search/worst_case_fixture.h"

namespace clusterbench::search::test {
namespace {

// Forty lights at one place, and single ones so far from it that no view reaches from them to it.
Json crowd() {
  std::vector<TestLight> lights(40, {{150.0, 0.0, 0.0}, 0.5});
  for (int i = 0; i < 10; ++i) lights.push_back({{-20.0 * i, 0.0, 0.0}, 0.5});
  return scene_json(lights, {{0.0, 0.0, 5.0}});
}

// Some points and spots around a camera.
Json room(const Json& camera = perspective(20.0)) {
  std::vector<TestLight> lights;
  SplitMix64 random(7);
  for (int i = 0; i < 30; ++i)
    lights.push_back({{random.between(-8.0, 8.0), random.between(0.0, 3.0), random.between(-8.0, 8.0)},
                      random.between(0.5, 3.0),
                      i % 3 == 0});
  return scene_json(lights, {{0.0, 1.5, 8.0}}, camera);
}

TEST(WorstCase, finds_the_crowd_that_the_recorded_camera_never_sees) {
  const SearchFolder folder;
  const Searched crowded = searched(folder, crowd());
  WorstCaseRequest request = few(1500);
  request.measure = Measure::longest;
  const WorstCase found = crowded.search(request);
  ASSERT_FALSE(found.frames.empty());
  EXPECT_EQ(found.frames.front().value, 40.0) << "all lights of the crowd and no other";
  EXPECT_LE(found.recorded.max, 2.0);
  EXPECT_EQ(found.theoretical_max, 50.0);
  EXPECT_EQ(found.evaluations, 1500);
}

// Ten points in front of each other and twenty spots, in two places that no camera sees at once.
Json two_crowds() {
  std::vector<TestLight> lights(10, {{100.0, 0.0, 0.0}, 0.5});
  lights.insert(lights.end(), 20, {{-100.0, 0.0, 0.0}, 0.5, true});
  lights.insert(lights.end(), 12, {{-101.0, 0.0, 0.0}, 0.5});
  return scene_json(lights, {{0.0, 0.0, 5.0}});
}

TEST(WorstCase, finds_where_most_lights_are_in_view_and_where_most_of_one_type) {
  const SearchFolder folder;
  const Searched crowds = searched(folder, two_crowds());
  WorstCaseRequest request = few(1500);
  request.measure = Measure::lights;
  const WorstCase all = crowds.search(request);
  EXPECT_EQ(all.frames.front().value, 32.0);
  EXPECT_EQ(all.theoretical_max, 42.0);
  EXPECT_EQ(all.recorded.max, 0.0);
  EXPECT_STREQ(all.buffers.front().name, "indices") << "also of a search that assigns nothing";
  EXPECT_GT(all.buffers.front().elements, 0u);
  request.measure = Measure::lights_of_type;
  const WorstCase of_type = crowds.search(request);
  EXPECT_EQ(of_type.frames.front().value, 20.0);
  EXPECT_EQ(of_type.theoretical_max, 22.0) << "points";
}

TEST(WorstCase, a_camera_that_keeps_direction_and_height_is_never_turned_or_lifted) {
  const SearchFolder folder;
  // It looks along -z at the height of no light; the twelve points behind it are in view only of one that turns.
  const Searched crowds =
      searched(folder, scene_json(std::vector<TestLight>(12, {{0.0, 0.0, 50.0}, 2.0}), {{0.0, 1.5, 40.0}}));
  WorstCaseRequest request = few(600);
  request.frames = 3;
  request.within = Box{{-10.0, 1.0, 0.0}, {10.0, 3.0, 45.0}};
  EXPECT_GT(crowds.search(request).frames.front().value, 0.0);
  request.keep_direction = true;
  const WorstCase blind = crowds.search(request);
  EXPECT_EQ(blind.frames.front().value, 0.0) << "all lights are behind it";
  EXPECT_EQ(blind.random.max, 0.0);
  EXPECT_EQ(blind.directions, 1u);
  request.within.reset();
  request.keep_height = true;
  const WorstCase found = crowds.search(request);
  EXPECT_GT(found.frames.front().value, 0.0) << "from further back";
  EXPECT_EQ(found.eyes.lo.y, 1.5);
  EXPECT_EQ(found.eyes.hi.y, 1.5);
  for (const FoundFrame& frame : found.frames) {
    EXPECT_EQ(direction_of(frame.choice.rotation), Vec3d(0.0, 0.0, -1.0));
    EXPECT_EQ(frame.choice.eye.y, 1.5);
  }
}

TEST(WorstCase, a_light_without_end_is_in_every_cell_of_every_frame) {
  const SearchFolder folder;
  const Searched endless = searched(folder, scene_json({{{0.0, 0.0, 0.0}, 1e16}}, {{0.0, 0.0, 5.0}}));
  WorstCaseRequest request = few(40);
  const WorstCase found = endless.search(request);
  EXPECT_EQ(found.frames.front().value, 4.0 * 3.0 * 6.0);
  EXPECT_EQ(found.random.max, found.frames.front().value);
  EXPECT_EQ(found.random.mean, found.frames.front().value);
  EXPECT_EQ(found.theoretical_max, found.frames.front().value);
  EXPECT_TRUE(found.warnings.empty()) << "nothing can be worse than all that there can be";
}

TEST(WorstCase, a_random_frame_that_is_worse_than_all_that_was_searched_is_what_was_found) {
  const SearchFolder folder;
  const Searched one =
      searched(folder, scene_json({{{0.0, 0.0, 0.0}, 3.0}, {{2.0, 1.0, 4.0}, 3.0}}, {{0.0, 0.0, -20.0}}));
  WorstCaseRequest request = few(1);  // of the recorded frame, which looks away from the lights
  request.random = 300;
  const WorstCase found = one.search(request);
  ASSERT_GT(found.random.max, found.stages.back().best);
  EXPECT_EQ(found.frames.front().value, found.random.max);
  EXPECT_EQ(found.evaluations, 1);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_NE(found.warnings[0].find("is taken in its place"), std::string::npos) << found.warnings[0];
}

TEST(WorstCase, added_lights_that_hold_the_whole_view_fill_every_cell) {
  const SearchFolder folder;
  const Searched empty = searched(folder, scene_json({}, {{0.0, 0.0, 0.0}, {40.0, 0.0, 0.0}}));
  WorstCaseRequest request = few(60);
  request.extra_ranges_m = {500.0, 500.0, 500.0};
  const WorstCase found = empty.search(request);
  EXPECT_EQ(found.frames.front().value, 3.0 * 72.0);
  EXPECT_EQ(found.recorded.max, 0.0);
  EXPECT_EQ(found.frames.front().choice.extra_lights.size(), 3u);
}

TEST(WorstCase, lights_that_may_move_come_to_the_camera) {
  const SearchFolder folder;
  // Too far to be seen from where the camera may stand, but for the last metres that they may be moved.
  std::vector<TestLight> lights(6, {{0.0, 0.0, -40.0}, 2.0});
  const Searched away = searched(folder, scene_json(lights, {{0.0, 0.0, 0.0}}));
  WorstCaseRequest request = few(300);
  request.measure = Measure::longest;
  request.within = Box{{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}};
  EXPECT_EQ(away.search(request).frames.front().value, 0.0);
  request.move_m = 30.0;
  const WorstCase found = away.search(request);
  EXPECT_GE(found.frames.front().value, 4.0);
  for (const auto& [light, position] : found.frames.front().choice.moved)
    EXPECT_LE(glm::length(position - Vec3d(0.0, 0.0, -40.0)), 30.0 + 1e-4) << light;
}

std::string json_pointer_of(std::string dotted) {
  std::ranges::replace(dotted, '.', '/');
  return "/" + dotted;
}

result::Case replayed_case(const SearchFolder& folder, const Searched& of, const WorstCase& found) {
  folder.write("worst.gltf", scene::to_gltf(found.path_scene, "test"));
  const config::Config config =
      config::load_config(folder.write("worst.json", replay_config(of.config, of.case_plan(), "worst.gltf").dump()));
  const run::Plan plan = run::make_plan(config, "");
  const std::atomic<bool> stop{false};
  const run::Result result = run::run_plan(config, plan, {}, {}, stop);
  EXPECT_EQ(result.cases.size(), 1u);
  EXPECT_EQ(result.cases.front().frames, static_cast<int>(found.frames.size()));
  EXPECT_TRUE(result.cases.front().failures.empty());
  EXPECT_EQ(result.cases.front().error->undecided, 0u);
  return run::record_of(result.cases.front());
}

// The number that documents of `worst-case` name: "tests_done", or "shading.evaluated / shading.samples".
double number_at(const Json& json, const std::string& pointer) {
  if (const std::size_t slash = pointer.find(" / "); slash != std::string::npos)
    return number_at(json, pointer.substr(0, slash)) / number_at(json, pointer.substr(slash + 3));
  if (const std::string start = "the largest of "; pointer.starts_with(start)) {
    double most = 0.0;
    for (const auto& [_, value] : json.at(Json::json_pointer(json_pointer_of(pointer.substr(start.size())))).items())
      most = std::max(most, value.get<double>());
    return most;
  }
  return json.at(Json::json_pointer(json_pointer_of(pointer))).get<double>();
}

double replayed(const SearchFolder& folder, const Searched& of, const WorstCase& found, Measure measure) {
  return result::figure_of(replayed_case(folder, of, found), row_of(measure).figure).value();
}

TEST(WorstCase, run_gives_the_same_value_for_the_written_path_in_every_measure) {
  for (const MeasureRow& row : measure_rows()) {
    const SearchFolder folder;
    const Searched one = searched(folder, room());
    WorstCaseRequest request = few(120);
    request.measure = row.measure;
    request.extra_ranges_m = {1.0};
    const WorstCase found = one.search(request);
    const double value = found.frames.front().value;
    EXPECT_GT(value, 0.0) << row.name;
    const result::Case measured = replayed_case(folder, one, found);
    EXPECT_EQ(number_at(result::to_json(measured), row.pointer), value) << row.name;
    if (row.measure == Measure::lights_of_type) continue;
    EXPECT_EQ(result::figure_of(measured, row.figure), value) << row.name << ": " << row.figure;
  }
}

TEST(Measures, name_a_figure_of_the_table_and_have_its_unit_as_in_earlier_documents) {
  std::string units;
  for (const MeasureRow& row : measure_rows()) {
    units += row.unit() + ", ";
    if (row.measure == Measure::lights_of_type) continue;
    EXPECT_NE(result::figure_named(row.figure), nullptr) << row.name;
  }
  EXPECT_EQ(units, "entries, lights, lights, lights per sample, tests, lights, lights, ");
}

// The table says "over all frames", "of any frame" and "in the frame with most".
TEST(Measures, have_words_for_one_frame) {
  for (const MeasureRow& row : measure_rows())
    EXPECT_EQ(std::string(row.meaning).find("frame"), std::string::npos) << row.name << ": " << row.meaning;
}

TEST(WorstCase, run_gives_the_same_value_in_grids_that_follow_from_lights_and_cameras) {
  const Json grids[] = {
      {{"kind", "frustum"}, {"tiles", {{"count", {4, 3}}}}, {"slices", {{"scheme", "fit"}, {"count", 6}}}},
      {{"kind", "distance"}, {"tiles", {{"count", {4, 3}}}}, {"slices", {{"scheme", "exponential"}, {"count", 6}}}},
      {{"kind", "world"}, {"cells", {6, 3, 6}}},
      {{"kind", "cascades"}, {"levels", 3}, {"cells", {8, 8, 8}}}};
  const char* assigners[] = {"aabb-fast", "distance", "world-grid", "cascades"};
  for (std::size_t i = 0; i < std::size(grids); ++i) {
    const SearchFolder folder;
    const Searched one = searched(folder, room(perspective(0.0)), grids[i], assigners[i]);  // without a far plane
    WorstCaseRequest request = few(100);
    request.frames = 3;
    request.extra_ranges_m = {1.0};
    request.move_m = 0.5;
    const WorstCase found = one.search(request);
    ASSERT_GE(found.frames.size(), 2u) << assigners[i];
    double most = 0.0;
    for (const FoundFrame& frame : found.frames) most = std::max(most, frame.value);
    EXPECT_EQ(replayed(folder, one, found, Measure::entries), most) << assigners[i];
  }
}

TEST(WorstCase, an_orthographic_camera_a_storage_of_ones_own_and_half_precision_replay_too) {
  const SearchFolder folder;
  const Searched flat = searched(folder, room(orthographic()));
  const WorstCase found = flat.search(few(100));
  EXPECT_EQ(replayed(folder, flat, found, Measure::entries), found.frames.front().value);
  const Searched bins = searched(folder, room(), frustum(), "z-binning");
  const WorstCase binned = bins.search(few(100));
  EXPECT_EQ(replayed(folder, bins, binned, Measure::entries), binned.frames.front().value);
  const Searched half = searched(folder, room(), frustum(), "aabb",
                                 {{"precision", Json::array({Json{{"packing", "half"}, {"inflate", true}}})},
                                  {"storages", {"linked"}},
                                  {"jitter", Json::array({Json::array({0.3, -0.2})})}});
  const WorstCase packed = half.search(few(100));
  // The jitter is the configuration's, and so the replay's.
  EXPECT_EQ(replayed(folder, half, packed, Measure::entries), packed.frames.front().value);
}

// All that was found.
std::string text_of(const WorstCase& found) {
  std::string text = scene::to_gltf(found.path_scene, "test") + std::to_string(found.evaluations);
  for (const FoundFrame& frame : found.frames) text += " " + Json(frame.value).dump();
  for (const Stage& stage : found.stages) text += " " + std::to_string(stage.evaluations) + Json(stage.best).dump();
  return text + " " + Json(found.random.max).dump() + " " + Json(found.random.mean).dump();
}

TEST(WorstCase, the_same_seed_gives_the_same_result_on_any_number_of_threads) {
  const SearchFolder folder;
  const Searched one = searched(folder, room());
  WorstCaseRequest request = few(700);
  request.frames = 4;
  request.extra_ranges_m = {1.0};
  request.move_m = 0.5;
  const std::string alone = text_of(one.search(request));
  for (const int threads : {3, 16}) {  // 16: more than there are searches, so that some rate frames to compare with
    request.threads = threads;
    EXPECT_EQ(text_of(one.search(request)), alone) << threads << " threads";
  }
  request.seed = 2;
  EXPECT_NE(text_of(one.search(request)), alone);
}

TEST(WorstCase, no_more_than_the_allowed_frames_are_measured) {
  const SearchFolder folder;
  const Searched one = searched(folder, room());
  for (const int evaluations : {1, 2, 3, 10, 49, 333}) {
    const WorstCase found = one.search(few(evaluations));
    EXPECT_GE(found.evaluations, 1);
    EXPECT_LE(found.evaluations, evaluations);
    int sum = 0;
    for (const Stage& stage : found.stages) sum += stage.evaluations;
    EXPECT_EQ(sum, found.evaluations);
    EXPECT_EQ(found.random.frames, 50);
    EXPECT_GE(found.frames.front().value, found.recorded.max) << "the recorded frame is where it begins";
  }
}

TEST(WorstCase, a_stopped_search_has_what_it_found_and_says_why_it_ended) {
  const SearchFolder folder;
  const Searched one = searched(folder, room());
  std::atomic<bool> stop{false};
  WorstCaseListener listener;
  listener.on_progress = [&](const std::string&, int done, int) { stop = done >= 30; };
  const WorstCase halted = find_worst_case(one.config, one.plan, one.case_plan(), few(100000), listener, stop);
  EXPECT_EQ(halted.ended, Ended::signal);
  EXPECT_FALSE(halted.frames.empty());
  EXPECT_LT(halted.evaluations, 100);
  EXPECT_EQ(halted.random.frames, 0);
  WorstCaseRequest brief = few(10'000'000);
  brief.seconds = 0.05;
  const WorstCase short_one = one.search(brief);
  EXPECT_EQ(short_one.ended, Ended::seconds);
  EXPECT_EQ(short_one.random.frames, 50);
}

TEST(WorstCase, several_frames_are_not_nearly_the_same) {
  const SearchFolder folder;
  WorstCaseRequest request = few(400);
  request.frames = 5;
  const WorstCase found = searched(folder, room()).search(request);
  ASSERT_EQ(found.frames.size(), 5u);
  const Vec3d size = found.eyes.hi - found.eyes.lo;
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const FrameChoice &a = found.frames[i].choice, &b = found.frames[k].choice;
      EXPECT_TRUE(glm::length(a.eye - b.eye) > 0.05 * glm::length(size) ||
                  glm::dot(direction_of(a.rotation), direction_of(b.rotation)) < 0.8661);
      EXPECT_LE(found.frames[i].value, found.frames[k].value);
    }
}

std::string refusal_of(const Searched& of, const WorstCaseRequest& request) {
  try {
    of.search(request);
  } catch (const Error& error) {
    return error.what();
  }
  return "found";
}

TEST(WorstCase, what_cannot_be_searched_is_refused_with_a_reason) {
  const SearchFolder folder;
  const Searched dark = searched(folder, scene_json({}, {{0.0, 0.0, 0.0}}));
  EXPECT_NE(refusal_of(dark, few(10)).find("has no point or spot light"), std::string::npos);
  const Searched lit = searched(folder, room());
  WorstCaseRequest request = few(10);
  request.within = Box{{1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}};
  EXPECT_NE(refusal_of(lit, request).find("--within: must have its minimum not above"), std::string::npos);
  request.within = Box{{0.0, 0.0, 0.0}, {0.0, 1e16, 1.0}};
  EXPECT_NE(refusal_of(lit, request).find("--within: must be within 1e15 m"), std::string::npos);
  request.within.reset();
  request.walkable = true;
  EXPECT_NE(refusal_of(lit, request).find("--walkable: the scene has no triangles"), std::string::npos);
  request.keep_height = true;
  EXPECT_NE(refusal_of(lit, request).find("--keep-height: says how high the camera stands, as"), std::string::npos);
  request.keep_height = false;
  const Searched unsampled = searched(folder, room(), frustum(), "aabb", {{"shading", {{"samples", 0}}}});
  request.walkable = false;
  request.measure = Measure::evaluated;
  EXPECT_NE(refusal_of(unsampled, request).find("evaluated needs samples"), std::string::npos);
  Searched hierarchy = searched(folder, room(), frustum(), "bvh");
  hierarchy.plan = run::make_plan(hierarchy.config, "/own$");
  request.measure = Measure::longest;
  EXPECT_NE(refusal_of(hierarchy, request).find("has no cells"), std::string::npos);
}

TEST(WorstCase, a_scene_of_one_light_and_no_camera_or_of_one_point_is_searched) {
  const SearchFolder folder;
  const Searched alone = searched(folder, scene_json({{{3.0, 1.0, 2.0}, 5.0}}, {}));
  EXPECT_GT(alone.search(few(60)).frames.front().value, 0.0);
  const Searched point = searched(folder, scene_json({{{3.0, 1.0, 2.0}, 5.0}}, {{3.0, 1.0, 2.0}}));
  const WorstCase found = point.search(few(60));
  EXPECT_EQ(found.eyes.lo, found.eyes.hi);
  EXPECT_EQ(found.frames.front().choice.eye, Vec3d(3.0, 1.0, 2.0));
  EXPECT_GT(found.frames.front().value, 0.0);
}

TEST(WorstCase, lights_that_reach_nothing_widen_no_box) {
  const SearchFolder folder;
  Json scene = scene_json({{{3.0, 1.0, 2.0}, 5.0}, {{500.0, -900.0, 0.0}, 5.0}}, {{3.0, 1.0, 2.0}});
  scene["extensions"]["KHR_lights_punctual"]["lights"][1] = {{"type", "point"}, {"intensity", 0.0}};
  EXPECT_EQ(searched(folder, scene).search(few(20)).eyes.hi, Vec3d(3.0, 1.0, 2.0));
}

}  // namespace
}  // namespace clusterbench::search::test
