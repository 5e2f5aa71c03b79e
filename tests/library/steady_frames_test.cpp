#include <gtest/gtest.h>

#include <cfenv>
#include <thread>
#include <vector>

#include "assign/allocations.h"
#include "library/assign.h"
#include "library/cases.h"
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace clusterbench::library {
namespace {

using testing::engine_frame;
using testing::EngineFrame;
using testing::FrameForMethod;
using testing::frustum_grid;
using testing::lists_of;
using testing::made_lists;
using testing::settings_for;

// --- What a steady frame costs ---

void run_part_by_part(void*, std::uint32_t count, void (*part)(void*, std::uint32_t), void* context) {
  for (std::uint32_t i = 0; i < count; ++i) part(context, i);
}

// Two places of the camera by turns, and with one thread fewer lights. (The parts that threads share are cut anew with
// each number of lights, so there a part can become larger than ever before.)
std::uint64_t allocations_of_steady_frames(const Settings& settings) {
  EngineFrame frame = engine_frame(1500, 3);
  LightLists lists;
  EXPECT_TRUE(lists.start(settings)) << lists.error();
  const auto update = [&] {
    frame.view.eye[0] = frame.view.eye[0] > 0.0 ? -1.0 : 1.0;
    EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
  };
  for (int warm = 0; warm < 4; ++warm) update();
  if (settings.threads == 1) frame.points.resize(frame.points.size() - 100);
  const std::uint64_t before = assign::testing::allocations();
  for (int i = 0; i < 4; ++i) {
    update();
    EXPECT_GE(lists.cell_at(3.0f, 3.0f, 3.0f), 0);
    EXPECT_GT(lists.memory_bytes(), 0u);
  }
  EXPECT_EQ(lists.builds(), 1u);
  return assign::testing::allocations() - before;
}

TEST(LightLists, of_steady_frames_allocate_nothing) {
  const Parameter sixteen_bits("index_bits", "16");
  for (const char* method : {"exact-fast", "brute-force", "aabb-fast"})
    for (const std::string_view storage : {"", "packed", "fixed", "bitfield", "linked", "runs"}) {
      Settings settings = settings_for(frustum_grid(), method);
      settings.storage = storage;
      if (storage == "packed") settings.storage_parameters = {&sixteen_bits, 1};
      EXPECT_EQ(allocations_of_steady_frames(settings), 0u) << method << " " << storage;
    }
  Settings settings = settings_for(frustum_grid(), "z-binning");
  EXPECT_EQ(allocations_of_steady_frames(settings), 0u);
  settings = settings_for(frustum_grid(), "exact-fast");
  settings.threads = 3;
  settings.jobs.run = run_part_by_part;
  EXPECT_EQ(allocations_of_steady_frames(settings), 0u);
}

// Lights that are off are in no list and take none of the method's memory: what is left are their two copies.
TEST(LightLists, count_lights_as_given_and_as_converted_and_depths) {
  const auto bytes_with = [](const EngineFrame& frame, std::string_view method) {
    LightLists lists;
    EXPECT_TRUE(lists.start(settings_for(frustum_grid(), method))) << lists.error();
    EXPECT_TRUE(lists.update(frame.view, frame.lights())) << lists.error();
    return lists.memory_bytes();
  };
  EngineFrame few = engine_frame(0, 3), many = few;
  few.points.resize(10), many.points.resize(30010);
  constexpr std::size_t k_a_light = sizeof(scene::WorldLight) + 5 * sizeof(float);  // x, y, z, radius, reach
  EXPECT_GE(bytes_with(many, "aabb"), bytes_with(few, "aabb") + 30000 * k_a_light);
  const FrameForMethod tiled(*assign::find_assigner("tiled"));
  EXPECT_GE(bytes_with(tiled.engine, "tiled"), 1280 * 720 * sizeof(float));
}

TEST(LightLists, keep_and_count_their_memory_after_a_frame_that_failed) {
  EngineFrame frame = engine_frame(500, 3);
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  settings.storage = "packed";
  LightLists lists;
  ASSERT_TRUE(lists.start(settings));
  ASSERT_TRUE(lists.update(frame.view, frame.lights()));
  const std::size_t before = lists.memory_bytes();
  frame.points[1].range = -1.0f;
  EXPECT_FALSE(lists.update(frame.view, frame.lights()));
  EXPECT_GE(lists.memory_bytes(), before / 2);
}

TEST(LightLists, do_not_depend_on_threads_or_who_lends_them) {
  const EngineFrame frame = engine_frame(3000, 17);
  Settings settings = settings_for(frustum_grid(), "exact-fast");
  const assign::Lists expected = made_lists(settings, frame);
  settings.threads = 4;
  EXPECT_EQ(made_lists(settings, frame), expected);
  int calls = 0;
  settings.jobs = {&calls, [](void* user, std::uint32_t count, void (*part)(void*, std::uint32_t), void* context) {
                     ++*static_cast<int*>(user);
                     std::vector<std::thread> threads;
                     for (std::uint32_t i = 0; i < count; ++i) threads.emplace_back(part, context, count - 1 - i);
                     for (std::thread& thread : threads) thread.join();
                   }};
  EXPECT_EQ(made_lists(settings, frame), expected);
  EXPECT_EQ(calls, 2);
}

TEST(LightLists, are_built_again_only_for_a_new_picture_or_a_new_kind_of_light) {
  EngineFrame frame = engine_frame(100, 5);
  EngineFrame points_only = frame;
  points_only.spots.clear();
  LightLists lists;
  ASSERT_TRUE(lists.start(settings_for(frustum_grid(), "exact-fast")));
  const auto builds_after = [&](const EngineFrame& of) {
    EXPECT_TRUE(lists.update(of.view, of.lights())) << lists.error();
    return lists.builds();
  };
  EXPECT_EQ(builds_after(points_only), 1u);
  frame.view.eye[1] += 3.0;
  EXPECT_EQ(builds_after(points_only), 1u);
  EXPECT_EQ(builds_after(frame), 2u);
  EXPECT_EQ(builds_after(points_only), 2u);
  frame.view.width /= 2;
  EXPECT_EQ(builds_after(frame), 3u);
  frame.view.left += 0.01;
  EXPECT_EQ(builds_after(frame), 4u);
}

// --- Rounding ---

#if defined(__SSE__)
TEST(LightLists, do_not_depend_on_the_callers_rounding) {
  const EngineFrame frame = engine_frame(300, 23);
  const Settings settings = settings_for(frustum_grid(), "exact-fast");
  const assign::Lists expected = made_lists(settings, frame);
  const unsigned before = _mm_getcsr();
  for (const unsigned mode : {0x8040u, 0x2000u, 0x4000u, 0x6000u}) {  // flush and treat as zero; down; up; to zero
    _mm_setcsr((before & ~0x6000u) | mode);
    LightLists lists;
    const bool is_made = lists.start(settings) && lists.update(frame.view, frame.lights());
    const unsigned after = _mm_getcsr() & ~0x3fu;
    _mm_setcsr(before);
    ASSERT_TRUE(is_made) << lists.error();
    EXPECT_EQ(lists_of(lists), expected) << mode;
    EXPECT_EQ(after & 0xe040u, mode);
  }
}
#endif

}  // namespace
}  // namespace clusterbench::library
