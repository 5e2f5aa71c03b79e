#include "core/text.h"

#include <gtest/gtest.h>

#include <vector>

namespace clusterbench {
namespace {

const std::vector<std::string> k_names{"aabb", "bounds", "planes", "sphere-refinement"};

TEST(NearestName, a_swapped_pair_of_letters_is_one_error) {
  EXPECT_EQ(nearest_name("abab", k_names), "aabb");
}

TEST(NearestName, a_missing_letter_in_a_long_name_is_found) {
  EXPECT_EQ(nearest_name("sphere-refinment", k_names), "sphere-refinement");
}

TEST(NearestName, a_word_like_none_of_them_has_no_nearest_name) {
  EXPECT_EQ(nearest_name("voxels", k_names), "");
  EXPECT_EQ(did_you_mean("voxels", k_names), "");
}

TEST(Sha256, agrees_with_the_examples_of_fips_180) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

}  // namespace
}  // namespace clusterbench
