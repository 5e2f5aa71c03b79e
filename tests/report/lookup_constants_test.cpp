// What a shader gets to look cells up with.

#include "report/shader_code/lookup_constants.h"

#include <gtest/gtest.h>

#include "records.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

Json case_by_hand() {
  return {{"viewport", {640, 360}},
          {"grid",
           {{"kind", "frustum"},
            {"cells", {10, 6, 2}},
            {"tiles", {{"pixels", {64, 64}}}},
            {"slices",
             {{"scheme", "exponential"},
              {"boundaries", {1, 10, 100}},
              {"lookup", {{"form", "log2"}, {"scale", 0.3}, {"bias", 0.0}}}}}}}};
}

std::string glsl_of(const Json& result_case) {
  return lookup_glsl("x", lookup_constants(test::case_of(result_case)));
}
std::string hlsl_of(const Json& result_case) {
  return lookup_hlsl("x", lookup_constants(test::case_of(result_case)));
}
std::string cpp_of(const Json& result_case) {
  return lookup_cpp("x", lookup_constants(test::case_of(result_case)));
}

TEST(LookupConstants, what_a_grid_keeps_over_a_path_is_constant) {
  EXPECT_NE(glsl_of(case_by_hand()).find("const float x_slice_far = 100.0;"), std::string::npos);
  EXPECT_NE(hlsl_of(case_by_hand()).find("static const float x_slice_far = 100.0;"), std::string::npos);
  EXPECT_NE(cpp_of(case_by_hand()).find("inline constexpr float slice_far = 100.0f;"), std::string::npos);
}

TEST(LookupConstants, what_changes_from_frame_to_frame_is_a_variable_that_the_shader_sets) {
  Json fitted = case_by_hand();
  fitted["grid"]["slices"]["scheme"] = "fit";
  EXPECT_NE(glsl_of(fitted).find("\nfloat x_slice_far = 100.0;"), std::string::npos) << glsl_of(fitted);
  EXPECT_NE(hlsl_of(fitted).find("\nstatic float x_slice_scale = "), std::string::npos) << hlsl_of(fitted);
  EXPECT_NE(glsl_of(fitted).find("const vec2 x_tile_scale"), std::string::npos) << "tiles stay";
  EXPECT_NE(cpp_of(fitted).find("inline float slice_far = 100.0f;"), std::string::npos);
  EXPECT_NE(lookup_note(test::case_of(fitted)).find("set this frame's before a lookup"), std::string::npos);

  Json reacts = case_by_hand();
  reacts["react"] = Json::object();
  EXPECT_NE(glsl_of(reacts).find("ivec3 x_cells = "), std::string::npos);
  EXPECT_EQ(glsl_of(reacts).find("const ivec3 x_cells"), std::string::npos);
  EXPECT_NE(glsl_of(reacts).find("const float x_slice_far"), std::string::npos) << "slices stay";
}

}  // namespace
}  // namespace clusterbench::report
