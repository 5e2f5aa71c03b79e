#include "grid/slicing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace clusterbench::grid {
namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();

Slicing slicing(Scheme scheme, int count, double near_m, double far_m) {
  Slicing out;
  out.scheme = scheme;
  out.count = count;
  out.near_m = near_m;
  out.far_m = far_m;
  return out;
}

Slices make(const Slicing& asked) {
  return make_slices(asked, {asked.near_m, asked.far_m, 0.0, 0.0}, false);
}

// Decimal places of a printed number: "31.5" has one.
int places(const std::string& printed) {
  const std::size_t point = printed.find('.');
  return point == std::string::npos ? 0 : static_cast<int>(printed.size() - point - 1);
}

// Persson 2015, "Practical Clustered Shading", slides on depth slicing. The slides round some numbers and cut others
// off (293.56 stands as 293), so a printed number holds if it is within one unit of its last digit.
void expect_printed(const Slices& slices, const std::vector<std::string>& printed) {
  ASSERT_EQ(slices.boundaries.size(), printed.size());
  for (std::size_t i = 0; i < printed.size(); ++i) {
    const double unit = std::pow(10.0, -places(printed[i]));
    EXPECT_LT(std::abs(slices.boundaries[i] - std::stod(printed[i])), unit) << "boundary " << i << " of " << printed[i];
  }
}

TEST(Slicing, exponential_gives_perssons_default_list_to_50_km) {
  expect_printed(make(slicing(Scheme::exponential, 16, 0.1, 50000.0)),
                 {"0.1", "0.23", "0.52", "1.2", "2.7", "6.0", "14", "31", "71", "161", "365", "828", "1880", "4270",
                  "9696", "22018", "50000"});
}

TEST(Slicing, exponential_gives_perssons_list_to_500_m) {
  expect_printed(make(slicing(Scheme::exponential, 16, 0.1, 500.0)),
                 {"0.1", "0.17", "0.29", "0.49", "0.84", "1.43", "2.44", "4.15", "7.07", "12.0", "20.5", "35", "59",
                  "101", "172", "293", "500"});
}

TEST(Slicing, exponential_first_gives_perssons_list_with_a_special_near_cluster) {
  Slicing asked = slicing(Scheme::exponential_first, 16, 0.1, 500.0);
  asked.first_m = 5.0;
  expect_printed(make(asked), {"0.1", "5.0", "6.8", "9.2", "12.6", "17.1", "23.2", "31.5", "42.9", "58.3", "79.2",
                               "108", "146", "199", "271", "368", "500"});
}

TEST(Slicing, linear_and_power_meet_at_lambda_0_and_power_is_exponential_at_1) {
  Slicing power = slicing(Scheme::power, 8, 1.0, 65.0);
  power.lambda = 0.0;
  EXPECT_EQ(make(power).boundaries, make(slicing(Scheme::linear, 8, 1.0, 65.0)).boundaries);
  power.lambda = 1.0;
  EXPECT_EQ(make(power).boundaries, make(slicing(Scheme::exponential, 8, 1.0, 65.0)).boundaries);
  power.lambda = 0.5;
  EXPECT_FLOAT_EQ(make(power).boundaries[4], static_cast<float>(0.5 * std::sqrt(65.0) + 0.5 * 33.0));
}

TEST(Slicing, fit_covers_the_lights_in_view_and_nothing_else) {
  const Slices slices = make_slices(slicing(Scheme::fit, 4, 0.1, 500.0), {0.1, 1000.0, 10.0, 160.0}, false);
  EXPECT_FLOAT_EQ(slices.boundaries[1], 20.0f);
  EXPECT_FLOAT_EQ(slices.boundaries.back(), 160.0f);
  EXPECT_LE(slices.boundaries.front(), 0.1f) << "what is nearer than all lights looks itself up in slice 0";
}

TEST(Slicing, fit_without_a_light_in_view_still_makes_slices) {
  constexpr double k_endless = std::numeric_limits<double>::infinity();
  const SliceRange dark{0.1, k_endless, k_endless, 0.0};
  EXPECT_EQ(make_slices(slicing(Scheme::fit, 4, 0.1, 0.0), dark, false).count(), 4);
  EXPECT_FLOAT_EQ(make_slices(slicing(Scheme::fit, 4, 0.1, 500.0), dark, false).boundaries.back(), 500.0f);
}

TEST(Slicing, without_a_far_the_camera_decides_and_then_the_lights) {
  EXPECT_FLOAT_EQ(
      make_slices(slicing(Scheme::exponential, 4, 0.1, 0.0), {0.1, 300.0, 0.0, 80.0}, false).boundaries.back(), 300.0f);
  EXPECT_FLOAT_EQ(
      make_slices(slicing(Scheme::exponential, 4, 0.1, 0.0), {0.1, k_infinity, 0.0, 80.0}, false).boundaries.back(),
      80.0f);
}

TEST(Slicing, no_gap_is_left_between_the_cameras_near_plane_and_slice_0) {
  for (const double camera_near : {0.01, 0.1, 0.3})
    EXPECT_LE(static_cast<double>(
                  make_slices(slicing(Scheme::exponential, 8, 0.1, 100.0), {camera_near, 100.0, 0.0, 0.0}, false)
                      .boundaries.front()),
              camera_near);
}

TEST(Slicing, a_depth_on_a_boundary_belongs_to_the_slice_that_begins_there) {
  const Slices slices = make(slicing(Scheme::exponential, 24, 0.1, 400.0));
  for (int k = 0; k < slices.count(); ++k) {
    const float boundary = slices.boundaries[static_cast<std::size_t>(k)];
    EXPECT_EQ(slices.ideal_slice_of(boundary), k);
    EXPECT_EQ(slices.ideal_slice_of(std::nextafter(static_cast<double>(boundary), 0.0)), std::max(k - 1, 0));
  }
  EXPECT_EQ(slices.ideal_slice_of(slices.boundaries.back()), slices.count() - 1);
}

TEST(Slicing, depths_before_the_grid_are_slice_0_and_beyond_it_none) {
  for (const Scheme scheme : {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power}) {
    Slicing asked = slicing(scheme, 16, 0.1, 500.0);
    const Slices slices = make(asked);
    EXPECT_EQ(slices.slice_of(0.0f), 0);
    EXPECT_EQ(slices.slice_of(1e-20f), 0);
    EXPECT_EQ(slices.slice_of(500.0f), 15);
    EXPECT_EQ(slices.slice_of(500.1f), -1);
    EXPECT_EQ(slices.slice_of(k_infinity), -1);
  }
}

TEST(Slicing, the_middle_of_every_slice_looks_itself_up_in_every_scheme) {
  for (const Scheme scheme :
       {Scheme::linear, Scheme::exponential, Scheme::exponential_first, Scheme::power, Scheme::fit, Scheme::list}) {
    Slicing asked = slicing(scheme, 6, 0.5, 500.0);
    asked.boundaries_m = {0.5, 1.0, 8.0, 9.0, 30.0, 31.0, 500.0};
    const Slices slices = make_slices(asked, {0.5, 500.0, 2.0, 300.0}, false);
    for (int k = 0; k < slices.count(); ++k) {
      const float begin = slices.boundaries[static_cast<std::size_t>(k)];
      const float end = slices.boundaries[static_cast<std::size_t>(k) + 1];
      for (const float share : {0.01f, 0.5f, 0.99f}) EXPECT_EQ(slices.slice_of(begin + share * (end - begin)), k);
    }
  }
}

struct Range {
  double near_m, far_m;
  int count;
};

class ShaderLookup : public testing::TestWithParam<Range> {};

// The shader's logarithm is single precision: it may be off next to a boundary, by as many ulps as its exponent range
// costs.
TEST_P(ShaderLookup, leaves_the_ideal_slice_only_within_a_few_ulps_of_a_boundary) {
  const Slices slices = make(slicing(Scheme::exponential, GetParam().count, GetParam().near_m, GetParam().far_m));
  constexpr int k_ulps = 64;
  for (int k = 1; k < slices.count(); ++k) {
    float below = slices.boundaries[static_cast<std::size_t>(k)], above = below;
    for (int i = 0; i < k_ulps; ++i) {
      below = std::nextafter(below, 0.0f);
      above = std::nextafter(above, k_infinity);
    }
    EXPECT_EQ(slices.slice_of(below), k - 1);
    EXPECT_EQ(slices.slice_of(above), k);
    for (const float near_boundary :
         {slices.boundaries[static_cast<std::size_t>(k)], std::nextafter(below, k_infinity)})
      EXPECT_LE(std::abs(slices.slice_of(near_boundary) - slices.ideal_slice_of(near_boundary)), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(HardRanges, ShaderLookup,
                         testing::Values(Range{0.1, 400.0, 24}, Range{0.01, 1e4, 32}, Range{1e-3, 1e6, 64}));

// Runs the call and gives the key that it names.
template <class Call>
std::string refused_key(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.where();
  }
  return "not refused";
}

// three.js writes orthographic cameras with znear 0.
TEST(Slicing, an_orthographic_view_from_0_has_slices_of_every_scheme) {
  const SliceRange from_0{0.0, 80.0, -5.0, 60.0};
  const auto boundaries = [&](Scheme scheme, int count, double near_m = 0.0) {
    Slicing asked = slicing(scheme, count, near_m, 80.0);
    return make_slices(asked, from_0, true).boundaries;
  };
  EXPECT_EQ(boundaries(Scheme::linear, 4), (std::vector<float>{0.0f, 20.0f, 40.0f, 60.0f, 80.0f}));
  EXPECT_EQ(boundaries(Scheme::power, 4), boundaries(Scheme::linear, 4));
  // A first slice up to far / count, then exponential ones.
  EXPECT_EQ(boundaries(Scheme::exponential, 4)[0], 0.0f);
  EXPECT_EQ(boundaries(Scheme::exponential, 4)[1], 20.0f);
  EXPECT_NEAR(boundaries(Scheme::exponential, 4)[2], 20.0 * std::pow(4.0, 1.0 / 3.0), 1e-5);
  EXPECT_EQ(boundaries(Scheme::exponential, 1), (std::vector<float>{0.0f, 80.0f}));
  EXPECT_EQ(boundaries(Scheme::exponential_first, 2), (std::vector<float>{0.0f, 5.0f, 80.0f}));
  EXPECT_EQ(boundaries(Scheme::exponential, 4, -8.0)[0], -8.0f);
  EXPECT_EQ(boundaries(Scheme::exponential, 4, -8.0)[1], 20.0f);
  EXPECT_EQ(boundaries(Scheme::fit, 3).size(), 4u);
  for (const Scheme scheme :
       {Scheme::linear, Scheme::power, Scheme::exponential, Scheme::exponential_first, Scheme::fit}) {
    for (const int count : {2, 3, 16}) {
      const Slices slices = make_slices(slicing(scheme, count, 0.0, 80.0), from_0, true);
      EXPECT_EQ(slices.slice_of(-1.0f), 0);
      EXPECT_EQ(slices.slice_of(0.0f), 0);
      for (int k = 0; k < slices.count(); ++k) {
        const auto at = static_cast<std::size_t>(k);
        EXPECT_EQ(slices.slice_of(0.5f * (slices.boundaries[at] + slices.boundaries[at + 1])), k);
      }
    }
  }
  Slicing following = slicing(Scheme::exponential, 4, 0.0, 80.0);
  following.fit = Fit{};
  SliceRange near_needed = from_0;
  near_needed.needed = {0.0, 3.0};
  const Slices follows = make_slices(following, near_needed, true);
  EXPECT_EQ(follows.boundaries.front(), 0.0f);
  EXPECT_NEAR(follows.boundaries.back(), 3.0f, 1e-4);
}

TEST(Slicing, what_cannot_be_is_refused_by_its_key) {
  const SliceRange endless{0.1, k_infinity, 0.0, k_infinity};
  const auto key = [](const Slicing& asked, const SliceRange& range, bool orthographic) {
    return refused_key([&] { make_slices(asked, range, orthographic); });
  };
  EXPECT_EQ(key(slicing(Scheme::exponential, 0, 0.1, 10.0), endless, false), "slices.count");
  EXPECT_EQ(key(slicing(Scheme::exponential, 8, 10.0, 10.0), endless, false), "slices.near");
  EXPECT_EQ(key(slicing(Scheme::exponential, 8, 0.1, 0.0), endless, false), "slices.far");
  EXPECT_EQ(key(slicing(Scheme::exponential, 8, -1.0, 10.0), endless, false), "slices.near");
  EXPECT_EQ(key(slicing(Scheme::exponential, 8, 0.0, 10.0), {0.0, 10.0, 0.0, 0.0}, false), "slices.near");
  EXPECT_EQ(key(slicing(Scheme::linear, 8, -1.0, 10.0), endless, false), "slices.near");
  EXPECT_EQ(key(slicing(Scheme::linear, 8, -1.0, 10.0), endless, true), "not refused");
  EXPECT_EQ(key(slicing(Scheme::exponential, 1 << 20, 1.0, 1.0001), endless, false), "slices");
  Slicing first = slicing(Scheme::exponential_first, 8, 0.1, 4.0);
  EXPECT_EQ(key(first, endless, false), "slices.first");
  Slicing list;
  list.scheme = Scheme::list;
  list.boundaries_m = {1.0, 3.0, 3.0};
  EXPECT_EQ(key(list, endless, false), "slices.boundaries");
  for (const auto& boundaries : {std::vector{-1.0, 2.0}, std::vector{1.0, 1e300}, std::vector{1.0, 2.0, 2.0 + 1e-12}}) {
    list.boundaries_m = boundaries;
    EXPECT_EQ(key(list, endless, false), "slices.boundaries");
  }
}

// Of two ends that do not fit the one that is given is named, with its value.
TEST(Slicing, an_end_that_does_not_fit_the_cameras_is_named) {
  const auto text = [](const Slicing& asked) -> std::string {
    try {
      make_slices(asked, {0.1, 50.0, 0.0, 0.0}, false);
    } catch (const Error& error) {
      return error.where() + ": " + error.message();
    }
    return "not refused";
  };
  EXPECT_EQ(text(slicing(Scheme::linear, 8, 0.0, -5.0)),
            "slices.far: is -5 m, which is not above the camera's near, 0.1 m");
  EXPECT_EQ(text(slicing(Scheme::linear, 8, 60.0, 0.0)), "slices.near: is 60 m, which is not below far, 50 m");
  EXPECT_EQ(text(slicing(Scheme::linear, 8, 0.0, 1e300)),
            "slices.far: is 1e+300 m; allowed: at most 1e15 m; where the camera's far plane is infinite, name one");
}

TEST(Slicing, without_an_end_and_without_lights_behind_their_beginning_are_made_all_the_same) {
  for (const double lights_end_m : {0.0, 0.05, 4.0})
    for (const Scheme scheme :
         {Scheme::linear, Scheme::power, Scheme::exponential, Scheme::exponential_first, Scheme::fit})
      for (const bool orthographic : {false, true}) {
        Slicing asked = slicing(scheme, 8, 0.0, 0.0);
        const SliceRange endless{0.1, k_infinity, 0.0, lights_end_m};
        EXPECT_GE(make_slices(asked, endless, orthographic).boundaries.back(), lights_end_m) << lights_end_m;
      }
  Slicing far = slicing(Scheme::exponential, 8, 50.0, 0.0);
  EXPECT_GT(make_slices(far, {0.1, k_infinity, 0.0, 20.0}, false).boundaries.back(), 50.0f);
}

// Filament: 100 m, or the camera's far plane where that is nearer.
TEST(Slicing, far_at_most_ends_slices_only_where_the_camera_sees_farther) {
  Slicing asked = slicing(Scheme::exponential, 8, 0.0, 0.0);
  asked.far_at_most_m = 100.0;
  const auto far = [&](double camera_far) {
    return make_slices(asked, {0.1, camera_far, 0.0, 700.0}, false).boundaries.back();
  };
  EXPECT_EQ(far(1000.0), 100.0f);
  EXPECT_EQ(far(30.0), 30.0f);
  EXPECT_EQ(far(k_infinity), 100.0f);
  asked.far_m = 300.0;
  EXPECT_EQ(far(1000.0), 300.0f) << "a far that is named is taken";
}

// Godot: its own cameras end at 4000 m, where those of the file do not end.
TEST(Slicing, far_default_ends_slices_only_of_a_camera_that_has_no_far_plane) {
  Slicing asked = slicing(Scheme::linear, 8, 0.0, 0.0);
  asked.far_default_m = 4000.0;
  const auto far = [&](double camera_far) {
    return make_slices(asked, {0.1, camera_far, 0.0, 700.0}, false).boundaries.back();
  };
  EXPECT_EQ(far(k_infinity), 4000.0f);
  EXPECT_EQ(far(90.0), 90.0f);
  EXPECT_EQ(far(9000.0), 9000.0f);
  EXPECT_FALSE(asked.ends_with_lights(k_infinity));
  asked.far_at_most_m = 100.0;
  EXPECT_EQ(far(k_infinity), 100.0f);
  asked.far_m = 300.0;
  EXPECT_EQ(far(k_infinity), 300.0f) << "a far that is named is taken";
  asked = slicing(Scheme::linear, 8, 0.0, 0.0);
  EXPECT_TRUE(asked.ends_with_lights(k_infinity));
  EXPECT_FALSE(asked.ends_with_lights(90.0));
}

// Bevy, Unity URP.
TEST(Slicing, of_an_orthographic_camera_are_linear_where_asked_for) {
  Slicing asked = slicing(Scheme::exponential_first, 4, 0.0, 0.0);
  asked.linear_when_orthographic = true;
  const SliceRange range{1.0, 9.0, 0.0, 0.0};
  EXPECT_EQ(make_slices(asked, range, true).boundaries, (std::vector<float>{1, 3, 5, 7, 9}));
  EXPECT_EQ(make_slices(asked, range, true).lookup.form, SliceLookup::Form::linear);
  EXPECT_EQ(make_slices(asked, range, false).boundaries[1], 5.0f);
}

// Bevy: the first slice ends at 5 m whatever the lights, the last one where the farthest range does.
TEST(Slicing, that_follow_ranges_keep_their_first_slice_and_end_beyond_the_camera) {
  Slicing asked = slicing(Scheme::exponential_first, 24, 0.0, 0.0);
  asked.fit = Fit{Fit::To::ranges, 0.0, 1.0};
  const auto made = [&](double from, double to) {
    return make_slices(asked, {0.1, 200.0, 0.0, 0.0, {from, to}}, false).boundaries;
  };
  EXPECT_EQ(made(40.0, 60.0)[1], 5.0f);
  EXPECT_NEAR(made(40.0, 60.0).back(), 60.0f, 1e-4);
  EXPECT_NEAR(made(40.0, 500.0).back(), 500.0f, 1e-3);
  EXPECT_EQ(made(0.5, 2.0)[1], 5.0f);
  EXPECT_NEAR(made(0.5, 2.0).back(), 5.05f, 1e-4) << "all before the first slice's end";
}

}  // namespace
}  // namespace clusterbench::grid
