#include "core/error.h"

#include <gtest/gtest.h>

namespace clusterbench {
namespace {

TEST(Error, names_file_and_place_before_the_message) {
  EXPECT_STREQ(Error("a.json", "3:4 /grids", "is not an array").what(), "a.json: 3:4 /grids: is not an array");
}

TEST(Error, leaves_out_what_is_not_known) {
  EXPECT_STREQ(Error("", "slices.near", "must be below far").what(), "slices.near: must be below far");
  EXPECT_STREQ(Error("a.glb", "", "cannot be read").what(), "a.glb: cannot be read");
  EXPECT_STREQ(Error("", "", "nothing to do").what(), "nothing to do");
}

}  // namespace
}  // namespace clusterbench
