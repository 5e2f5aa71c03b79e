// Formulas of a shader's JSON.

#include "gpu/user_shaders/formula.h"

#include <map>

#include <gtest/gtest.h>

#include "core/error.h"

namespace clusterbench::gpu {
namespace {

const std::map<std::string, double> k_known{{"cells", 3456.0}, {"lights", 300.0}, {"far", 1.0 / 0.0}};

double value_of(const std::string& formula) {
  const NumberOf number = [](const std::string& name) {
    const auto found = k_known.find(name);
    return found == k_known.end() ? nullptr : &found->second;
  };
  return number_of_formula(formula, number, "/here");
}

std::string refusal_of(const result::Json& given) {
  const NumberOf number = [](const std::string& name) {
    const auto found = k_known.find(name);
    return found == k_known.end() ? nullptr : &found->second;
  };
  try {
    amount_of(given, number, "/here");
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), "/here");
    return error.message();
  }
  return "";
}

TEST(Formulas, are_computed_by_the_usual_rules) {
  EXPECT_EQ(value_of("2 + 3 * 4"), 14.0);
  EXPECT_EQ(value_of("(2 + 3) * 4"), 20.0);
  EXPECT_EQ(value_of("10 - 4 - 3"), 3.0);
  EXPECT_EQ(value_of("-3 + 5"), 2.0);
  EXPECT_EQ(value_of("7 / 2"), 3.5);
  EXPECT_EQ(value_of("17 % 5"), 2.0);
  EXPECT_EQ(value_of("ceil(lights / 32)"), 10.0);
  EXPECT_EQ(value_of("floor(lights / 32)"), 9.0);
  EXPECT_EQ(value_of("min(lights, 256) + max(1, 2)"), 258.0);
  EXPECT_EQ(value_of(" cells*448 "), 3456.0 * 448.0);
  EXPECT_EQ(value_of("1.5e3"), 1500.0);
}

TEST(Formulas, that_cannot_be_read_are_refused_with_their_place) {
  const std::pair<const char*, const char*> all[] = {
      {"", "ends where a number is missing"},
      {"cells *", "ends where a number is missing"},
      {"(cells", "lacks ')' at column 7"},
      {"cells cells", "has 'c' at column 7"},
      {"cell", "names 'cell', which is not known"},
      {"round(2)", "has a function 'round'; allowed: ceil, floor, min, max"},
      {"min(1)", "lacks ',' at column 6"},
      {"1.2.3", "has '1.2.3', which is no number"},
      {"0x10", "has '0x10', which is no number"},
      {"2 # 3", "has '#' at column 3"},
  };
  for (const auto& [formula, message] : all)
    EXPECT_NE(refusal_of(formula).find(message), std::string::npos) << formula << ": " << refusal_of(formula);
  EXPECT_NE(refusal_of(std::string(200, '(')).find("nested deeper than 64 levels"), std::string::npos);
  EXPECT_NE(refusal_of(std::string(200, '-') + "1").find("nested deeper than 64 levels"), std::string::npos);
  EXPECT_NE(refusal_of(std::string(2000, '1')).find("has more than 1000 characters"), std::string::npos);
}

TEST(Formulas, of_amounts_are_whole_numbers_that_can_be) {
  EXPECT_EQ(refusal_of("lights * 12"), "");
  EXPECT_EQ(refusal_of(12u), "");
  EXPECT_NE(refusal_of("lights / 7").find("a whole number from 0 to 2^53"), std::string::npos);
  EXPECT_NE(refusal_of("lights - 301").find("is -1 here"), std::string::npos);
  EXPECT_NE(refusal_of("cells * 1e300 * 1e300").find("is inf here"), std::string::npos);
  EXPECT_NE(refusal_of("lights / 0").find("divides by 0 at column 8"), std::string::npos);
  EXPECT_NE(refusal_of("far").find("is inf here"), std::string::npos);
  EXPECT_NE(refusal_of(-1).find("allowed: a whole number from 0, or a formula"), std::string::npos);
  EXPECT_NE(refusal_of(1.5).find("allowed: a whole number from 0, or a formula"), std::string::npos);
  EXPECT_NE(refusal_of(nullptr).find("allowed: a whole number from 0, or a formula"), std::string::npos);
}

std::string refusal_before_a_frame(const result::Json& given, std::uint64_t least = 0) {
  try {
    check_amount(given, {"cells"}, "/here", least);
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

TEST(Formulas, that_cannot_be_right_whatever_names_stand_for_are_refused_before_a_frame) {
  const std::pair<const char*, const char*> all[] = {
      {"1 / 0", "divides by 0 at column 3"},           {"cells % 0", "divides by 0 at column 7"},
      {"cells / (4 - 4)", "divides by 0 at column 7"}, {"max(cells, 1 / min(0, 1))", "divides by 0"},
      {"1e999", "beyond all numbers of 64 bits"},      {"1e300 * 1e300", "is inf; allowed: a finite number"},
      {"8 / 3", "is 2.6666666666666665 here; allowed"}};
  for (const auto& [formula, message] : all)
    EXPECT_NE(refusal_before_a_frame(formula).find(message), std::string::npos) << refusal_before_a_frame(formula);
  for (const char* formula : {"cells / (cells - cells)", "cells - 9", "cells / 7", "0"})
    EXPECT_EQ(refusal_before_a_frame(formula), "") << formula;
}

TEST(Formulas, that_are_constant_are_known_before_a_frame) {
  EXPECT_EQ(constant_amount("4 * 16"), 64u);
  EXPECT_EQ(constant_amount(7u), 7u);
  EXPECT_EQ(constant_amount("4 * cells"), std::nullopt);
  EXPECT_EQ(constant_of_formula("1 / 4"), 0.25);
}

TEST(Formulas, of_amounts_say_the_least_that_is_allowed_as_number_and_as_formula) {
  for (const result::Json& given : {result::Json(0u), result::Json("0"), result::Json("-4"), result::Json(-4)})
    EXPECT_NE(refusal_before_a_frame(given, 1).find("allowed: a whole number from 1 to 2^53"), std::string::npos)
        << refusal_before_a_frame(given, 1);
}

TEST(Formulas, that_are_long_are_shown_by_their_beginning) {
  for (const std::string& formula :
       {std::string(10000, '('), std::string(10000, 'a'), std::string(900, 'a') + " + 1"}) {
    EXPECT_LT(refusal_before_a_frame(formula).size(), 300u);
    EXPECT_NE(refusal_before_a_frame(formula).find("..."), std::string::npos);
  }
  EXPECT_EQ(shortened(std::string(79, 'a') + "\u00e9"), std::string(79, 'a') + "...");
}

TEST(Formulas, with_unknown_names_are_told_the_nearest_one) {
  try {
    check_formula("cels * 4", {"cells", "lights"}, "/here");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("'cels' (did you mean 'cells'?)"), std::string::npos) << error.message();
  }
}

}  // namespace
}  // namespace clusterbench::gpu
