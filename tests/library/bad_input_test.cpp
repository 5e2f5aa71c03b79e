#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "library/assign.h"
#include "library/cases.h"

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::frustum_grid;
using testing::settings_for;

struct BadInput {
  const char* error;
  void (*spoil)(Settings& settings, EngineFrame& frame);
};

TEST(LightLists, refuse_bad_input_in_one_sentence_and_go_on) {
  constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();
  constexpr double k_no_end = std::numeric_limits<double>::infinity();
  static constexpr double k_descending[] = {1.0, 0.5};
  static const Parameter k_unknown("index_bit", "16"), k_wrong("index_bits", 16), k_no("index_bits", "17"),
      k_threads("threads", 2), k_twice[] = {{"index_bits", "16"}, {"index_bits", "8"}}, k_nameless("", "16"),
                               k_eight("index_bits", "8");
  static const Parameter k_no_type = [] {
    Parameter parameter("index_bits", "16");
    parameter.type = static_cast<Parameter::Type>(7);
    return parameter;
  }();
  const BadInput inputs[] = {
      {"method: is 'exact-fats' (did you mean 'exact-fast'?)",
       [](Settings& s, EngineFrame&) { s.method = "exact-fats"; }},
      {"storage: is 'pack'", [](Settings& s, EngineFrame&) { s.storage = "pack"; }},
      {"storage_parameters: index_bit: is not a parameter (did you mean 'index_bits'?)",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_unknown, 1};
       }},
      {"storage_parameters: index_bits: is 16; it must be a text, one of: auto, 8, 16, 32",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_wrong, 1};
       }},
      {"storage_parameters: index_bits: is '17' (did you mean '16'?); allowed: auto, 8, 16, 32",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_no, 1};
       }},
      {"storage: is given, and z-binning leaves a structure",
       [](Settings& s, EngineFrame&) { s.method = "z-binning", s.storage = "packed"; }},
      {"threads: is 0; allowed: whole numbers from 1 to 256", [](Settings& s, EngineFrame&) { s.threads = 0; }},
      {"threads: is 2; allowed: 1, since aabb-fast works on one thread; those that share a frame: exact-fast",
       [](Settings& s, EngineFrame&) { s.method = "aabb-fast", s.threads = 2; }},
      {"grid.kind: is world, on which exact-fast does not work; allowed: frustum",
       [](Settings& s, EngineFrame&) { s.grid.kind = Grid::Kind::world; }},
      {"grid.kind: is none", [](Settings& s, EngineFrame&) { s.grid.kind = static_cast<Grid::Kind>(9); }},
      {"method_parameters: have 'threads', which Settings::threads gives; allowed: the other parameters of exact-fast",
       [](Settings& s, EngineFrame&) {
         s.method_parameters = {&k_threads, 1};
       }},
      {"storage_parameters: are given, and storage is not; allowed: none",
       [](Settings& s, EngineFrame&) {
         s.storage_parameters = {k_twice, 1};
       }},
      {"storage_parameters: have 'index_bits' twice; allowed: each once",
       [](Settings& s, EngineFrame&) { s.storage = "packed", s.storage_parameters = k_twice; }},
      {"storage_parameters: have 'index_bits' of no type; allowed: number, text, flag",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_no_type, 1};
       }},
      {"grid.slicing: is none; allowed: linear,",
       [](Settings& s, EngineFrame&) { s.grid.slicing = static_cast<Grid::Slicing>(9); }},
      {"grid.boundaries_m: are given, and grid.slicing is not list; allowed: none",
       [](Settings& s, EngineFrame&) { s.grid.boundaries_m = k_descending; }},
      {"grid.lambda: is 1.5; allowed: 0 to 1",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::power, s.grid.lambda = 1.5; }},
      {"grid.lambda: is nan; allowed: 0 to 1",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::power, s.grid.lambda = std::nan(""); }},
      {"grid.first_m: is 200 m; it must lie between near, 0.1 m, and far, 150 m: name one (grid.first_m), or another "
       "scheme (grid.slicing)",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::exponential_first, s.grid.first_m = 200.0; }},
      {"grid.columns, grid.rows: are 16 and 0; allowed: both 0", [](Settings& s, EngineFrame&) { s.grid.rows = 0; }},
      {"grid.columns: is -1; allowed: 1 to 1048576", [](Settings& s, EngineFrame&) { s.grid.columns = -1; }},
      {"grid.tile_width: is 0; allowed: 1 or more",
       [](Settings& s, EngineFrame&) { s.grid.columns = s.grid.rows = s.grid.tile_width = 0; }},
      {"grid.slices: is -5; allowed: 1 to 4096", [](Settings& s, EngineFrame&) { s.grid.slices = -5; }},
      {"grid.boundaries_m: are 0; allowed: 2 to 4097 numbers",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::list; }},
      {"grid.boundaries_m[1]: is 0.5 after 1; allowed: ascending numbers",
       [](Settings& s, EngineFrame&) { s.grid.slicing = Grid::Slicing::list, s.grid.boundaries_m = k_descending; }},
      {"grid.near_m: is 500 m, which is not below far, 150 m",
       [](Settings& s, EngineFrame&) { s.grid.near_m = 500.0; }},
      {"grid.far_m: is not given, and the camera has no far plane",
       [](Settings&, EngineFrame& f) { f.view.far_m = std::numeric_limits<double>::infinity(); }},
      {"view.width, view.height: are 0 and 720; allowed: 1 to 1048576 pixels",
       [](Settings&, EngineFrame& f) { f.view.width = 0; }},
      {"view.left, view.right: are -1.06666667 and -1.06666667; allowed: left < right",
       [](Settings&, EngineFrame& f) { f.view.right = f.view.left; }},
      {"view.near_m, view.far_m: are -1 and 150; allowed: 0 < near < far",
       [](Settings&, EngineFrame& f) { f.view.near_m = -1.0; }},
      {"view.near_m, view.far_m: are nan and 150", [](Settings&, EngineFrame& f) { f.view.near_m = std::nan(""); }},
      {"view.eye: is (", [](Settings&, EngineFrame& f) { f.view.eye[2] = 2e15; }},
      {"view.to_right, view.to_top, view.forward: are not unit and orthogonal; allowed: products within 1e-3 of 1 and "
       "0",
       [](Settings&, EngineFrame& f) { f.view.to_top[2] += 0.1; }},
      {"view.to_right, view.to_top, view.forward: ",
       [](Settings&, EngineFrame& f) { f.view.forward[0] = std::nan(""); }},
      {"view.top: is 1000000; allowed: slopes from -1e5 to 1e5", [](Settings&, EngineFrame& f) { f.view.top = 1e6; }},
      {"lights.points[3].position: is (nan,", [](Settings&, EngineFrame& f) { f.points[3].position[0] = k_nan; }},
      {"lights.points[2].range: is -1; allowed: 0 or more",
       [](Settings&, EngineFrame& f) { f.points[2].range = -1.0f; }},
      {"lights.points[2].range: is nan", [](Settings&, EngineFrame& f) { f.points[2].range = k_nan; }},
      {"lights.spots[1].direction: is (0, 0, 0)",
       [](Settings&, EngineFrame& f) {
         for (float& number : f.spots[1].direction) number = 0.0f;
       }},
      {"lights.spots[1].outer_angle: is 1.7", [](Settings&, EngineFrame& f) { f.spots[1].outer_angle = 1.7f; }},
      {"view.eye: is (0, nan, 0); allowed: up to 1e15 m from the origin along each axis",
       [](Settings&, EngineFrame& f) { f.view.eye[0] = f.view.eye[2] = 0.0, f.view.eye[1] = std::nan(""); }},
      {"view.left: is -inf; allowed: slopes", [](Settings&, EngineFrame& f) { f.view.left = -k_no_end; }},
      {"view.left: is nan; allowed: slopes", [](Settings&, EngineFrame& f) { f.view.left = std::nan(""); }},
      {"view.bottom, view.top: are -0.6 and -2; allowed: bottom < top",
       [](Settings&, EngineFrame& f) { f.view.top = -2.0; }},
      {"view.bottom: is -2e+15; allowed: -1e15 to 1e15 m",
       [](Settings&, EngineFrame& f) { f.view.is_orthographic = true, f.view.bottom = -2e15; }},
      {"view.far_m: is 1e+300, and the slices end there; allowed: up to 1e15 m, or any with grid.far_m",
       [](Settings&, EngineFrame& f) { f.view.far_m = 1e300; }},
      {"view.near_m, view.far_m: are 0.1 and inf; allowed: ",
       [](Settings&, EngineFrame& f) { f.view.is_orthographic = true, f.view.far_m = k_no_end; }},
      {"view.near_m, view.far_m: are -1e+300 and 150; allowed: ",
       [](Settings& s, EngineFrame& f) {
         f.view.is_orthographic = true, f.view.near_m = -1e300;
         s.grid.near_m = 1.0;
       }},
      {"storage_parameters: have one without a name; allowed: index_bits,",
       [](Settings& s, EngineFrame&) {
         s.storage = "packed", s.storage_parameters = {&k_nameless, 1};
       }},
      {"method_parameters: have one without a name; allowed: ",
       [](Settings& s, EngineFrame&) {
         s.method_parameters = {&k_nameless, 1};
       }},
      {"storage_parameters: index_bits: is 8, but 300 lights need 16 bits",
       [](Settings& s, EngineFrame& f) {
         s.storage = "packed", s.storage_parameters = {&k_eight, 1};
         f = engine_frame(300, 5);
       }},
      {"lights.boxes: are given, and exact-fast takes none; methods on a frustum grid that do: ",
       [](Settings&, EngineFrame& f) { f.boxes.resize(1); }},
  };
  for (const BadInput& input : inputs) {
    Settings settings = settings_for(frustum_grid(), "exact-fast");
    EngineFrame frame = engine_frame(30, 5);
    input.spoil(settings, frame);
    LightLists lists;
    EXPECT_FALSE(lists.start(settings) && lists.update(frame.view, frame.lights())) << input.error;
    EXPECT_TRUE(lists.error().starts_with(input.error)) << lists.error() << "\nexpected: " << input.error;
    EXPECT_TRUE(lists.begins().empty());
    EXPECT_EQ(lists.cell_at(100, 100, 10), -1);
    const EngineFrame good = engine_frame(30, 5);
    ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast"))) << lists.error();
    EXPECT_TRUE(lists.update(good.view, good.lights())) << lists.error();
    EXPECT_EQ(lists.error(), "");
  }
}

TEST(LightLists, name_the_pixel_of_a_bad_depth) {
  EngineFrame frame = engine_frame(30, 5);
  std::vector<float> depths(921600, 20.0f);
  frame.view.depths = depths;
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "tiled"))) << lists.error();
  depths[641] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  EXPECT_EQ(lists.error(), "view.depths[641]: is nan; allowed: 0 m or more, and +inf without a surface");
}

// A job system that keeps no promise: it skips the parts before `from` and calls `more` that it has called or that are
// none.
struct PartsCalled {
  std::uint32_t from, more;
};

void call_parts(void* user, std::uint32_t count, void (*part)(void*, std::uint32_t), void* context) {
  const PartsCalled& called = *static_cast<const PartsCalled*>(user);
  for (std::uint32_t i = called.from; i < count; ++i) part(context, i);
  for (std::uint32_t i = 0; i < called.more; ++i) part(context, i % 2 == 0 ? 0 : count);
}

TEST(LightLists, fail_if_a_job_system_skips_or_repeats_a_part) {
  const EngineFrame frame = engine_frame(3000, 17);
  PartsCalled called{0, 0};
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  settings.threads = 4;
  settings.jobs = {&called, call_parts};
  LightLists lists;
  ASSERT_TRUE(lists.start(settings)) << lists.error();
  const auto error_of = [&](PartsCalled now) {
    called = now;
    const bool is_made = lists.update(frame.view, frame.lights());
    EXPECT_EQ(is_made, lists.error().empty());
    EXPECT_EQ(lists.begins().empty(), !lists.error().empty());
    return std::string(lists.error());
  };
  EXPECT_EQ(error_of({0, 0}), "");
  EXPECT_TRUE(error_of({1000, 0}).starts_with("jobs.run: returned after 0 of ")) << lists.error();
  EXPECT_NE(error_of({1, 0}).find("; allowed: to call each part once"), std::string::npos);
  EXPECT_NE(error_of({0, 1}).find(", and called one twice or one that is none"), std::string::npos);
  EXPECT_NE(error_of({1, 2}).find(", and called one twice or one that is none"), std::string::npos);
  EXPECT_EQ(error_of({0, 0}), "");
}

}  // namespace
}  // namespace clusterbench::library
