#include "run/cases/case_names.h"

#include <gtest/gtest.h>

namespace clusterbench::run {
namespace {

const CaseNames k_case{"street/walk/640x360 frustum 64px/bvh/no lists/half",
                       "0123456789ab",
                       "street",
                       "walk",
                       "640x360",
                       "frustum 64px",
                       "bvh half",
                       "own"};

TEST(CaseNames, every_name_that_is_printed_for_a_case_selects_it) {
  for (const char* name :
       {"street/walk/640x360 frustum 64px/bvh/no lists/half", "frustum 64px/bvh", "^street/.*/half$", "0123456789ab",
        "street/640x360 frustum 64px/bvh/no lists/half", "street/frustum 64px/bvh/no lists/half",
        "frustum 64px/bvh/no lists/half", "street/frustum 64px", "bvh half", "bvh half / no lists",
        "bvh half / no lists, frustum 64px", "frustum 64px / bvh half / no lists",
        "frustum 64px, camera walk, 640x360"})
    EXPECT_TRUE(is_selected(Pattern(name, ""), k_case)) << name;
  for (const char* name : {"street/frustum 32px", "street/bvh", "0123456789", "frustum 64px, camera idle, 640x360"})
    EXPECT_FALSE(is_selected(Pattern(name, ""), k_case)) << name;
}

TEST(CaseNames, filters_and_names_of_earlier_versions_still_mean_structures_without_lists) {
  for (const char* name : {"bvh/own", "/own/", "street/walk/640x360 frustum 64px/bvh/own/half", "bvh half / own"})
    EXPECT_TRUE(is_selected(Pattern(name, ""), k_case)) << name;
  EXPECT_EQ(current_name("street/walk/frustum/bvh/own"), "street/walk/frustum/bvh/no lists");
  EXPECT_EQ(current_name("street/walk/frustum/bvh/own/half"), "street/walk/frustum/bvh/no lists/half");
  EXPECT_EQ(current_name("street/walk/frustum/tiled-2.5d(test=both)/own"),
            "street/walk/frustum/tiled-2.5d(test=both)/own lists");
  EXPECT_EQ(current_name("street/walk/frustum/tiled/no lists"), "street/walk/frustum/tiled/own lists");
  EXPECT_EQ(current_name("own/own/own/own/packed"), "own/own/own/own/packed") << "of scene, camera, grid and method";
}

TEST(CaseNames, lists_of_tiles_are_a_methods_own_by_all_names_that_they_had) {
  const CaseNames tiled{"street/walk/frustum 64px/tiled/own lists",
                        "0123456789ab",
                        "street",
                        "walk",
                        "640x360",
                        "frustum 64px",
                        "tiled",
                        "own"};
  for (const char* name : {"tiled/own lists", "tiled/no lists", "tiled/own", "tiled / own lists"})
    EXPECT_TRUE(is_selected(Pattern(name, ""), tiled)) << name;
}

// A choice and a structure were renamed, not on the same day.
TEST(CaseNames, all_that_a_case_was_ever_called_selects_it) {
  const CaseNames tiled{"street/walk/frustum 64px/tiled(spot=sphere)/own lists",
                        "0123456789ab",
                        "street",
                        "walk",
                        "640x360",
                        "frustum 64px",
                        "tiled(spot=sphere)",
                        "own"};
  for (const char* spot : {"sphere", "ball"})
    for (const char* structure : {"own", "no lists", "own lists"})
      for (const char* before : {"", "street/walk/frustum 64px/", "street/frustum 64px/", "frustum 64px/"}) {
        const std::string name = std::string(before) + "tiled(spot=" + spot + ")/" + structure;
        EXPECT_TRUE(is_selected(Pattern(name, ""), tiled)) << name;
      }
}

TEST(CaseNames, choices_that_were_called_otherwise_are_found_by_both_names) {
  CaseNames spots = k_case;
  spots.name = "street/walk/frustum 64px/aabb(spot=sphere)/packed";
  for (const char* name : {"aabb(spot=sphere)", "aabb(spot=ball)", "street/walk/frustum 64px/aabb(spot=ball)/packed"})
    EXPECT_TRUE(is_selected(Pattern(name, ""), spots)) << name;
  EXPECT_EQ(current_name("street/walk/frustum 64px/aabb(spot=ball,inflation=2)/packed"),
            "street/walk/frustum 64px/aabb(spot=sphere,inflation=2)/packed");
  EXPECT_EQ(current_name("street/walk/frustum 64px/naive-cone(flaw=flat-cap-ball)/packed"),
            "street/walk/frustum 64px/naive-cone(flaw=flat-cap-sphere)/packed");
  EXPECT_EQ(current_name("a(spot=ball)/b/c/exact/packed"), "a(spot=ball)/b/c/exact/packed") << "a scene's name";
}

TEST(UniqueNames, take_the_smallest_suffix_that_is_free) {
  UniqueNames names;
  EXPECT_EQ(names.add("a"), "a");
  EXPECT_EQ(names.add("a-3"), "a-3");
  EXPECT_EQ(names.add("a"), "a-2");
  EXPECT_EQ(names.add("a"), "a-4");
  EXPECT_EQ(names.add("a-3"), "a-3-2");
}

}  // namespace
}  // namespace clusterbench::run
