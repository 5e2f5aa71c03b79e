#include <gtest/gtest.h>

#include <limits>

#include "assign/contract/assigner.h"
#include "core/error.h"

namespace clusterbench::assign {
namespace {

const std::vector<ParamSpec> k_specs{
    {.name = "spot",
     .summary = "",
     .default_value = std::string("both"),
     .unit = "",
     .choices = {"sphere", "both"},
     .former = {{"ball", "sphere"}}},
    {.name = "margin", .summary = "", .default_value = 2.0, .unit = "m", .min = 0.5, .max = 4.0, .choices = {}},
    {.name = "cap",
     .summary = "",
     .default_value = 100.0,
     .unit = "lights",
     .min = 1,
     .max = 65535,
     .choices = {},
     .whole = true},
    {.name = "fast", .summary = "", .default_value = true, .unit = "", .choices = {}}};

// The refusal of one value, as "where: message".
std::string refusal(const std::string& name, const ParamValue& value) {
  try {
    Params(k_specs, {{name, value}});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.where() + ": " + error.message();
  }
  return "taken";
}

TEST(Params, what_is_not_given_has_its_default) {
  const Params params(k_specs, {{"margin", 3.5}});
  EXPECT_EQ(params.text("spot"), "both");
  EXPECT_EQ(params.number("margin"), 3.5);
  EXPECT_EQ(params.number("cap"), 100.0);
  EXPECT_TRUE(params.flag("fast"));
  EXPECT_EQ(params.values().size(), 4u);
  EXPECT_EQ(Params(k_specs).values(), Params(k_specs, {}).values());
}

TEST(Params, given_values_replace_defaults) {
  const Params params(k_specs, {{"spot", std::string("sphere")}, {"fast", false}, {"cap", 1.0}, {"margin", 0.5}});
  EXPECT_EQ(params.text("spot"), "sphere");
  EXPECT_FALSE(params.flag("fast"));
  EXPECT_EQ(params.number("cap"), 1.0);
  EXPECT_EQ(params.number("margin"), 0.5);
}

TEST(Params, a_former_name_of_a_choice_means_the_choice) {
  EXPECT_EQ(Params(k_specs, {{"spot", std::string("ball")}}).text("spot"), "sphere");
  EXPECT_EQ(first_value(k_specs[0], std::string("sphere")), ParamValue(std::string("ball")));
  EXPECT_EQ(first_value(k_specs[0], std::string("both")), ParamValue(std::string("both")));
}

TEST(Params, an_unknown_name_is_refused_with_the_likely_one_and_all_that_exist) {
  EXPECT_EQ(refusal("spots", std::string("ball")),
            "spots: is not a parameter (did you mean 'spot'?); there are: spot, margin, cap, fast");
}

TEST(Params, a_method_without_parameters_says_so) {
  EXPECT_THROW(
      {
        try {
          Params(std::vector<ParamSpec>{}, {{"spot", true}});
        } catch (const Error& error) {
          EXPECT_EQ(error.message(), "is not a parameter; there are none");
          throw;
        }
      },
      Error);
}

TEST(Params, a_wrong_type_is_refused_with_what_was_found_and_what_it_must_be) {
  EXPECT_EQ(refusal("spot", 1.0), "spot: is 1; it must be a text, one of: sphere, both");
  EXPECT_EQ(refusal("margin", std::string("wide")), "margin: is 'wide'; it must be a number");
  EXPECT_EQ(refusal("fast", 1.0), "fast: is 1; it must be true or false");
  EXPECT_EQ(refusal("cap", true), "cap: is true; it must be a number");
}

TEST(Params, a_choice_that_does_not_exist_is_refused_with_the_choices) {
  EXPECT_EQ(refusal("spot", std::string("bal")), "spot: is 'bal'; allowed: sphere, both");
  EXPECT_EQ(refusal("spot", std::string("spher")), "spot: is 'spher' (did you mean 'sphere'?); allowed: sphere, both");
}

TEST(Params, a_number_out_of_range_or_no_number_is_refused_with_the_range) {
  EXPECT_EQ(refusal("margin", 0.25), "margin: is 0.25; allowed: 0.5 to 4 m");
  EXPECT_EQ(refusal("margin", 4.5), "margin: is 4.5; allowed: 0.5 to 4 m");
  EXPECT_EQ(refusal("margin", std::numeric_limits<double>::infinity()), "margin: is inf; allowed: 0.5 to 4 m");
  EXPECT_NE(refusal("margin", std::numeric_limits<double>::quiet_NaN()), "taken");
}

TEST(Params, a_count_must_be_whole) {
  EXPECT_EQ(refusal("cap", 2.5), "cap: is 2.5; allowed: whole numbers from 1 to 65535 lights");
  EXPECT_EQ(refusal("cap", 65535.0), "taken");
}

}  // namespace
}  // namespace clusterbench::assign
