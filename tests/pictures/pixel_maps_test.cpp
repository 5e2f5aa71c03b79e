// What pixels find, against a double loop over pixels and lights.

#include "pictures/pixel_maps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "measure/samples/shading.h"
#include "pictures/room.h"

namespace clusterbench::pictures {
namespace {

using test::look_at;
using test::Looked;
using test::Room;
using test::room;
using test::room_of;

// Straight from the definition; the scene has no ties.
bool shines_on(const scene::WorldLight& light, const Vec3d& point) {
  const Vec3d way = point - light.position;
  const double distance = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
  if (distance > light.range_m) return false;
  if (light.type != scene::LightType::spot) return true;
  const double along = way.x * light.direction.x + way.y * light.direction.y + way.z * light.direction.z;
  return std::acos(along / distance) <= light.outer_cone_rad;
}

// Where the camera, which stands at the origin and looks down -z, sees the wall in a pixel; NaN where it does not.
Vec3d wall_at(int x, int y) {
  const double top = std::tan(0.5), right = top * 64.0 / 48.0;
  const Vec3d along(right * ((x + 0.5) / 32.0 - 1.0), top * (1.0 - (y + 0.5) / 24.0), -1.0);
  const double straight = 8.0, leaning = 8.0 / (1.0 + 1.5 * along.y);  // z = -8, or z = 1.5 y - 8
  const Vec3d upper = along * straight, lower = along * leaning;
  if (upper.y >= 0.0 && upper.y <= 2.0 && std::abs(upper.x) <= 3.0) return upper;
  if (lower.y < 0.0 && lower.y >= -2.0 && std::abs(lower.x) <= 3.0) return lower;
  return Vec3d(NAN);
}

struct ByHand {
  std::uint32_t points = 0, spots = 0, false_positives = 0, missed = 0;
};

ByHand count_by_hand(const Looked& looked, const Vec3d& point, const grid::Sample& sample) {
  std::vector<std::uint32_t> given;
  looked.structure().lights_at(sample, grid::Log2::rounded, given);
  const std::set<std::uint32_t> evaluated(given.begin(), given.end());
  ByHand out;
  for (std::uint32_t i = 0; i < looked.frame.lights.size(); ++i) {
    const scene::WorldLight& light = looked.frame.lights[i];
    const bool is_given = evaluated.contains(i), is_needed = shines_on(light, point);
    if (is_given) ++(light.type == scene::LightType::spot ? out.spots : out.points);
    if (is_given && !is_needed) ++out.false_positives;
    if (is_needed && !is_given) ++out.missed;
  }
  return out;
}

struct Sums {
  std::uint64_t surfaces = 0, spots = 0, false_positives = 0, missed = 0;
};

Sums expect_maps_of_the_double_loop(const Looked& looked) {
  const PixelMaps maps = pixel_maps(looked.surface, NeededAt(looked.frame, looked.surface, 1),
                                    looked.frame.ranges().spots.first, looked.structure(), 1);
  Sums sums;
  std::size_t sample = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * 64 + static_cast<std::size_t>(x);
      const Vec3d point = wall_at(x, y);
      EXPECT_EQ(maps.state[pixel] == PixelMaps::State::no_surface, std::isnan(point.x)) << x << ' ' << y;
      if (maps.state[pixel] == PixelMaps::State::no_surface) continue;
      const ByHand count = count_by_hand(looked, point, looked.surface.samples[sample++]);
      EXPECT_EQ(maps.points[pixel], count.points) << x << ' ' << y;
      EXPECT_EQ(maps.spots[pixel], count.spots) << x << ' ' << y;
      EXPECT_EQ(maps.false_positives[pixel], count.false_positives) << x << ' ' << y;
      EXPECT_EQ(maps.missed[pixel], count.missed) << x << ' ' << y;
      ++sums.surfaces;
      sums.spots += count.spots;
      sums.false_positives += count.false_positives;
      sums.missed += count.missed;
    }
  EXPECT_EQ(maps.surfaces, sums.surfaces);
  EXPECT_EQ(maps.spots_total, sums.spots);
  EXPECT_EQ(maps.false_positives_total.sum, sums.false_positives);
  EXPECT_EQ(maps.missed_total.sum, sums.missed);
  return sums;
}

TEST(PixelMaps, are_those_of_a_double_loop_over_pixels_and_lights) {
  const Sums conservative = expect_maps_of_the_double_loop(look_at(room_of(room())));
  EXPECT_GT(conservative.surfaces, 500u);
  EXPECT_LT(conservative.surfaces, 64u * 48u);
  EXPECT_GT(conservative.spots, 100u);
  EXPECT_GT(conservative.false_positives, 100u);
  EXPECT_EQ(conservative.missed, 0u);
}

TEST(PixelMaps, show_as_missed_what_a_storage_has_dropped) {
  const Sums dropping = expect_maps_of_the_double_loop(
      look_at(room_of(room(), R"("aabb")", R"(, "storages": [{"name": "fixed", "cap": 3}])")));
  EXPECT_GT(dropping.missed, 100u);
}

TEST(PixelMaps, have_the_sums_of_the_samples_own_measure_on_any_number_of_threads) {
  // More samples than one part, so that threads share them.
  Room large = room_of(room(), R"("aabb")", R"(, "storages": [{"name": "fixed", "cap": 3}])");
  large.config.viewports = {{640, 480}};
  const Looked looked = look_at(large);
  ASSERT_GT(looked.surface.samples.size(), 2 * NeededAt::k_part);
  measure::ShadingCounts counts;
  measure::add_samples(counts, 0, looked.surface.samples, measure::needed_lights(looked.frame, looked.surface.samples),
                       looked.structure());
  for (const int threads : {1, 3}) {
    const NeededAt needed(looked.frame, looked.surface, threads);
    const PixelMaps maps =
        pixel_maps(looked.surface, needed, looked.frame.ranges().spots.first, looked.structure(), threads);
    EXPECT_EQ(needed.total(), counts.needed);
    EXPECT_EQ(maps.surfaces, counts.samples);
    EXPECT_EQ(maps.lights_total.sum, counts.evaluated);
    EXPECT_EQ(maps.missed_total.sum, counts.missed);
    EXPECT_EQ(maps.false_positives_total.sum, counts.evaluated - (counts.needed - counts.missed));
    EXPECT_EQ(maps.unanswered, counts.unanswered);
    EXPECT_EQ(maps.lights(maps.lights_total.most_at), maps.lights_total.most);
  }
}

TEST(PixelMaps, know_pixels_beyond_the_grid_from_pixels_without_lights) {
  Room cut = room_of(room());
  cut.config.grids.front().slices.far_m = 9.0;
  const Looked looked = look_at(cut);
  const PixelMaps maps = pixel_maps(looked.surface, NeededAt(looked.frame, looked.surface, 1),
                                    looked.frame.ranges().spots.first, looked.structure(), 1);
  EXPECT_GT(maps.unanswered, 30u);
  EXPECT_LT(maps.unanswered, maps.surfaces);
  std::uint64_t missed = 0;
  for (std::size_t i = 0; i < maps.state.size(); ++i) {
    if (maps.state[i] != PixelMaps::State::no_answer) continue;
    EXPECT_EQ(maps.lights(i), 0u);
    missed += maps.missed[i];
  }
  EXPECT_EQ(missed, maps.missed_total.sum);
}

TEST(ListMap, has_one_number_for_equal_lists_and_two_for_others) {
  const Looked looked = look_at(room_of(room()), 2);
  const ListMap map = list_map(looked.surface, looked.structure());
  std::vector<std::vector<std::uint32_t>> lists(looked.surface.samples.size());
  for (std::size_t i = 0; i < lists.size(); ++i) {
    looked.structure().lights_at(looked.surface.samples[i], grid::Log2::rounded, lists[i]);
    std::sort(lists[i].begin(), lists[i].end());
  }
  const auto number = [&](std::size_t sample) { return map.list[looked.surface.pixel_of_sample[sample]]; };
  for (std::size_t a = 0; a < lists.size(); ++a) {
    EXPECT_EQ(number(a) == 0, lists[a].empty());
    for (std::size_t b = 0; b < a; ++b) ASSERT_EQ(number(a) == number(b), lists[a] == lists[b]) << a << ' ' << b;
  }
  const std::set<std::vector<std::uint32_t>> distinct(lists.begin(), lists.end());
  EXPECT_EQ(map.lists, distinct.size() - (distinct.contains({}) ? 1 : 0));
  EXPECT_GT(map.lists, 4u);
}

TEST(UsualMost, leaves_out_one_pixel_of_a_hundred_but_never_two_thirds_of_the_range) {
  PixelMaps maps;
  maps.state.assign(1000, PixelMaps::State::answered);
  maps.surfaces = 1000;
  EXPECT_EQ(usual_most(maps, [](std::size_t i) { return i < 10 ? 20u : 12u; }), 12u);
  EXPECT_EQ(usual_most(maps, [](std::size_t i) { return i < 11 ? 20u : 12u; }), 20u);
  EXPECT_EQ(usual_most(maps, [](std::size_t i) { return i == 0 ? 100u : 1u; }), 34u);
  maps.state.assign(1000, PixelMaps::State::no_surface);
  maps.surfaces = 0;
  EXPECT_EQ(usual_most(maps, [](std::size_t) { return 1u; }), 0u);
}

}  // namespace
}  // namespace clusterbench::pictures
