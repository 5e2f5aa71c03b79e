// A result that has every field of the schema: each of its values changed alone, as comparison and reader see it.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/schema/documents.h"
#include "config/schema/schema_verdict.h"
#include "core/error.h"
#include "core/random.h"
#include "effort.h"
#include "report/comparing/compare.h"
#include "report/comparing/exact_differences.h"

namespace clusterbench::report::every_leaf {
namespace {

using result::About;
using result::Compares;
using result::Field;
using result::Json;
using result::Kind;
using result::Type;

// Values of a field that the schema accepts. Numbers differ from each other, and can become smaller.
class FullRecord {
 public:
  Json of(const Type& type, const About& about) {
    switch (type.kind) {
      case Kind::boolean:
        return true;
      case Kind::integer:
        return about.constant ? Json(*about.constant) : Json(next_++);
      case Kind::number:
        return about.max ? Json(*about.max / 2.0) : Json(next_++ + 0.25);
      case Kind::text:
        return text(about);
      case Kind::nullable:
        return of(*type.element, about);
      case Kind::list:
        return list(type, about);
      case Kind::by_name:
        return {{"opaque", of(*type.element, about)}, {"volume", of(*type.element, about)}};
      case Kind::object:
        return object(type);
      default:
        return {{"allocation", {{"margin", 2.0}, {"warn_at", 0.5}}}, {"name", "any JSON"}};
    }
  }

 private:
  Json text(const About& about) {
    if (!about.choices.empty()) return about.choices.front();
    return std::string(about.pattern).empty() ? "text " + std::to_string(next_++) : std::string("a");
  }

  Json list(const Type& type, const About& about) {
    Json out = Json::array();
    for (std::size_t i = 0; i < std::max<std::size_t>(type.fixed_size, 2); ++i)
      if (type.fixed_size == 0 || i < type.fixed_size) out.push_back(of(*type.element, about));
    return out;
  }

  Json object(const Type& type) {
    Json out = Json::object();
    for (const Field& field : type.fields) out[field.name] = of(*field.type, field.about);
    return out;
  }

  std::uint64_t next_ = 10;
};

Json full_result() {
  return FullRecord().of(result::type_of<result::Result>(), About());
}

// A value that is no object: a scalar, or a list of scalars, which the comparison names as a whole. Of several objects
// in a list, or by name, those of the last one.
struct Leaf {
  std::string pointer;
  const Type* type = nullptr;
  About about;
  Compares rule = Compares::as_holder;
  bool can_be_absent = false;
};

const Type& without_lists(const Type& type) {
  return type.element == nullptr ? type : without_lists(*type.element);
}

class Leaves {
 public:
  explicit Leaves(const Type& type, Compares rule) { add_fields("", type, rule); }

  std::vector<Leaf> found;

 private:
  void add_fields(const std::string& pointer, const Type& type, Compares rule) {
    for (const Field& field : type.fields) {
      Compares own = field.about.compares;
      if (own == Compares::as_holder) own = without_lists(*field.type).about.compares;
      if (own == Compares::as_holder) own = rule;
      add({pointer + "/" + field.name, field.type, field.about, own, field.optional != nullptr});
    }
  }

  void add(const Leaf& leaf) {
    const Type& type = *leaf.type;
    const auto of_element = [&](const std::string& step) {
      return Leaf{leaf.pointer + step, type.element, leaf.about, leaf.rule};
    };
    if (type.kind == Kind::object) {
      add_fields(leaf.pointer, type, leaf.rule);
    } else if (type.kind == Kind::nullable && without_lists(type).kind == Kind::object) {
      add(of_element(""));
    } else if (type.kind == Kind::by_name) {
      add(of_element("/volume"));
    } else if (type.kind == Kind::list && without_lists(type).kind == Kind::object) {
      add(of_element("/1"));
    } else {
      found.push_back(leaf);
      if (type.kind == Kind::json) found.back().pointer += "/name";
    }
  }
};

// Without those of sets of samples that have the type of another one here.
std::vector<Leaf> leaves_of_a_case() {
  std::vector<Leaf> leaves = Leaves(result::type_of<result::Case>(), Compares::fixed).found;
  std::erase_if(leaves, [](const Leaf& leaf) {
    return leaf.pointer.starts_with("/samples/") && !leaf.pointer.starts_with("/samples/fog/");
  });
  return leaves;
}
std::vector<Leaf> some_leaves_of_a_case() {
  return test::some(leaves_of_a_case(), 3);
}

// The same leaf larger (of numbers), or with another text, another list and so on.
Json larger(const Json& value) {
  if (value.is_number_integer()) return value.get<std::int64_t>() + 1;
  if (value.is_number()) return value.get<double>() + 0.125;
  if (value.is_string()) return value.get<std::string>() + " more";
  if (value.is_boolean()) return !value.get<bool>();
  Json out = value;
  if (value.is_object()) out["another"] = 1;
  if (value.is_array()) out[value.size() - 1] = larger(value.back());
  return out;
}
Json smaller(const Json& value) {
  if (value.is_number_integer()) return value.get<std::int64_t>() - 1;
  if (value.is_number()) return value.get<double>() - 0.125;
  return value;
}

// The words of one difference by the rule of its field. "": none.
std::string expected_word(Compares rule, const Json& base, const Json& next) {
  if (rule == Compares::skipped) return "";
  if (rule == Compares::unjudged || rule == Compares::follows) return "changed";
  if (rule == Compares::fixed) return "worse";
  if (next.is_null()) return "changed";
  return base.is_number() && next < base ? "better" : "worse";
}

// A change that follows from none is worse; one that is not judged changes nothing.
std::string expected_counts(Compares rule, const std::string& word) {
  if (rule == Compares::follows) return "worse";
  return word.empty() || word == "changed" ? "same" : word;
}

class EveryLeaf : public ::testing::Test {
 protected:
  const Json base_ = FullRecord().of(result::type_of<result::Case>(), About());
  const result::Case base_case_ = result::from_json<result::Case>(base_);

  ExactDifferences compared(const Json& next, const SameSettings& same = {}) const {
    return exact_differences(base_case_, result::from_json<result::Case>(next), same);
  }

  // Of this leaf, or none if its rule skips it.
  void expect_one_difference(const Leaf& leaf, const Json& value) const {
    const Json::json_pointer pointer(leaf.pointer);
    const Json& old = base_[pointer];
    Json next = base_;
    next[pointer] = value;
    const ExactDifferences found = compared(next);
    const std::string word = expected_word(leaf.rule, old, value);
    EXPECT_EQ(found.counts, expected_counts(leaf.rule, word)) << leaf.pointer << " " << value;
    ASSERT_EQ(found.differences.size(), word.empty() ? 0u : 1u) << leaf.pointer << " " << value;
    if (word.empty()) return;
    const result::Difference& one = found.differences[0];
    EXPECT_EQ(one.what, leaf.pointer);
    EXPECT_EQ(one.is, word) << leaf.pointer << " " << value;
    EXPECT_EQ(one.base, old) << leaf.pointer;
    EXPECT_EQ(one.next, value) << leaf.pointer;
  }
};

TEST_F(EveryLeaf, that_is_larger_or_another_is_named_alone_and_judged_by_its_rule) {
  std::set<Compares> rules;
  for (const Leaf& leaf : some_leaves_of_a_case()) {
    expect_one_difference(leaf, larger(base_[Json::json_pointer(leaf.pointer)]));
    rules.insert(leaf.rule);
  }
  EXPECT_EQ(rules.size(), 5u) << "a field of each rule";
}

TEST_F(EveryLeaf, that_is_smaller_is_named_alone_and_judged_by_its_rule) {
  for (const Leaf& leaf : some_leaves_of_a_case())
    if (const Json& old = base_[Json::json_pointer(leaf.pointer)]; old.is_number())
      expect_one_difference(leaf, smaller(old));
}

TEST_F(EveryLeaf, that_is_null_is_named_alone_and_judged_by_its_rule) {
  for (const Leaf& leaf : some_leaves_of_a_case())
    if (leaf.type->kind == Kind::number || leaf.type->kind == Kind::nullable) expect_one_difference(leaf, Json());
}

TEST_F(EveryLeaf, that_one_result_does_not_have_is_passed_over) {
  int removed = 0;
  for (const Leaf& leaf : some_leaves_of_a_case()) {
    if (!leaf.can_be_absent) continue;
    Json next = base_;
    const Json::json_pointer pointer(leaf.pointer);
    next[pointer.parent_pointer()].erase(pointer.back());
    EXPECT_TRUE(compared(next).differences.empty()) << leaf.pointer;
    EXPECT_EQ(compared(next).counts, "same") << leaf.pointer;
    ++removed;
  }
  EXPECT_GT(removed, test::k_sanitized ? 15 : 50);
}

// With another allocation.margin recommended sizes differ, with other prices modelled costs, and nothing else does.
TEST_F(EveryLeaf, follows_no_setting_but_recommended_sizes_the_margin_and_costs_the_prices) {
  const auto passed_over = [&](const SameSettings& same) {
    std::set<std::string> pointers;
    for (const Leaf& leaf : some_leaves_of_a_case()) {
      Json next = base_;
      Json& value = next[Json::json_pointer(leaf.pointer)];
      value = larger(value);
      if (leaf.rule != Compares::skipped && compared(next, same).differences.empty()) pointers.insert(leaf.pointer);
    }
    return pointers;
  };
  const auto some = [](std::set<std::string> pointers) {
    const std::vector<Leaf> tried = some_leaves_of_a_case();
    std::erase_if(pointers,
                  [&](const std::string& one) { return std::ranges::find(tried, one, &Leaf::pointer) == tried.end(); });
    return pointers;
  };
  EXPECT_EQ(passed_over({}), std::set<std::string>());
  EXPECT_EQ(passed_over({.margin = false}), some({"/buffers/bytes/recommended", "/buffers/index_entries/recommended",
                                                  "/buffers/used_share/max", "/buffers/used_share/mean"}));
  std::set<std::string> times{"/cost/gpu_ns",  "/cost/upload_ns", "/cost/traffic_ns",
                              "/cost/read_ns", "/cost/shade_ns",  "/cost/sets/volume/ns"};
  EXPECT_EQ(passed_over({.prices = false}), some(times));
  times.insert("/cost/sets/volume/divergence");
  EXPECT_EQ(passed_over({.prices = false, .waves = false}), some(times));
}

// Of each list, the whole one is named where its length differs.
TEST_F(EveryLeaf, of_a_list_that_is_longer_is_in_the_list_that_is_named) {
  std::set<std::string> lists;
  for (const Leaf& leaf : leaves_of_a_case())
    if (const std::size_t first = leaf.pointer.find("/1/");
        first != std::string::npos && leaf.rule != Compares::skipped)
      lists.insert(leaf.pointer.substr(0, first));
  EXPECT_GE(lists.size(), 8u);
  for (const std::string& list : lists) {
    Json next = base_;
    Json& elements = next[Json::json_pointer(list)];
    elements.push_back(elements.back());
    const ExactDifferences differences = compared(next);
    ASSERT_EQ(differences.differences.size(), 1u) << list;
    EXPECT_EQ(differences.differences[0].what, list);
  }
}

// Fields beside the cases: of machine, program, configuration, scenes and conclusions.
TEST_F(EveryLeaf, beside_the_cases_is_no_difference_of_a_case) {
  const Json base = full_result();
  const result::Result base_result = result::from_json<result::Result>(base);
  int tried = 0;
  for (const Leaf& leaf : Leaves(result::type_of<result::Result>(), Compares::fixed).found) {
    if (leaf.pointer.starts_with("/cases/")) continue;
    Json next = base;
    Json& value = next[Json::json_pointer(leaf.pointer)];
    value = larger(value);
    const result::Comparison comparison = compare_results(base_result, result::from_json<result::Result>(next), 0.02);
    EXPECT_EQ(comparison.cases.size(), 2u) << leaf.pointer;
    for (const result::ComparedCase& one : comparison.cases) EXPECT_TRUE(one.differences.empty()) << leaf.pointer;
    ++tried;
  }
  EXPECT_GT(tried, 100);
}

struct Mangled {
  std::string pointer;
  Json result;
  bool is_gone = false;  // the value is missing, or has another name
};

// One value of another kind, out of range, missing or of another name.
Mangled mangled(const Json& base, const std::string& leaf, SplitMix64& random) {
  const Json strange[] = {nullptr,       true,          -1, 0.5, 1e300, 18446744073709551615u, "a text",
                          Json::array(), Json::object()};
  Mangled out{leaf, base};
  const Json::json_pointer pointer(leaf);
  Json& holder = out.result[pointer.parent_pointer()];
  const std::uint64_t draw = random.below(std::size(strange) + 2);
  out.is_gone = draw >= std::size(strange);
  if (!out.is_gone)
    holder[pointer.back()] = strange[draw];
  else
    holder.erase(pointer.back());
  if (draw > std::size(strange)) holder[pointer.back() + "_2"] = 1;
  return out;
}

bool is_at(const std::string& place, const std::string& pointer) {
  return place == pointer || place.starts_with(pointer + "/") || place == pointer + "_2";
}

TEST_F(EveryLeaf, that_is_mangled_is_refused_with_its_place_or_read_as_it_is) {
  const Json base = full_result();
  const nlohmann::json schema = config::result_schema();
  ASSERT_TRUE(config::schema_violations(schema, nlohmann::json(base)).empty())
      << config::schema_violations(schema, nlohmann::json(base)).front();
  const result::Result base_result = result::from_json<result::Result>(base);
  const std::vector<Leaf> leaves = Leaves(result::type_of<result::Result>(), Compares::fixed).found;
  SplitMix64 random(1);
  int read = 0, refused = 0;
  for (int i = 0; i < test::tries(100); ++i) {
    const Mangled one = mangled(base, leaves[random.below(leaves.size())].pointer, random);
    const std::vector<std::string> violations = config::schema_violations(schema, nlohmann::json(one.result));
    const std::string said = one.pointer + ": " + one.result.value(Json::json_pointer(one.pointer), Json()).dump();
    try {
      const result::Result next = result::from_json<result::Result>(one.result);
      if (violations.empty() && !one.is_gone) {
        EXPECT_EQ(result::to_json(next), one.result) << said;
      }
      EXPECT_FALSE(comparison_text(compare_results(base_result, next, 0.02)).empty()) << said;
      ++read;
    } catch (const Error& error) {
      EXPECT_TRUE(is_at(error.where(), one.pointer)) << said << ": " << error.where();
      // Signed numbers end with 64 bits, for which JSON Schema has no word.
      const bool is_beyond_signed = error.message().find("-9223372036854775808") != std::string::npos;
      EXPECT_TRUE(!violations.empty() || is_beyond_signed) << said << ": " << error.message();
      ++refused;
    }
    const std::string holder = one.pointer.substr(0, one.pointer.rfind('/'));
    if (!violations.empty()) {  // the first one is in the message for users
      EXPECT_TRUE(violations.front().starts_with(holder)) << said << violations.front();
    }
  }
  EXPECT_GT(read, test::tries(20));
  EXPECT_GT(refused, test::tries(50));
}

}  // namespace
}  // namespace clusterbench::report::every_leaf
