#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "assign/contract/assigner.h"
#include "assign/contract/storage.h"
#include "core/error.h"

namespace clusterbench::assign {
namespace {

// Words and numbers, which may have a point.
bool is_kebab_case(const std::string& name) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.'; };
  return !name.empty() && name.front() != '-' && name.back() != '-' && std::all_of(name.begin(), name.end(), fits);
}

void expect_valid(const std::vector<ParamSpec>& params) {
  std::set<std::string> names;
  for (const ParamSpec& param : params) {
    EXPECT_TRUE(names.insert(param.name).second) << param.name << " is there twice";
    EXPECT_FALSE(param.summary.empty()) << param.name;
    EXPECT_NO_THROW(Params(params, {{param.name, param.default_value}})) << param.name << " refuses its own default";
  }
}

TEST(Registry, begins_with_the_assigners_in_the_order_in_which_they_are_shown) {
  const std::vector<std::string> expected{"brute-force",       "bounds",   "planes",   "aabb",
                                          "sphere-refinement", "distance", "cascades", "world-grid"};
  const std::vector<std::string> names = assigner_names();
  auto next = expected.begin();
  for (const std::string& name : names)
    if (next != expected.end() && name == *next) ++next;
  EXPECT_EQ(next, expected.end()) << "missing or out of order: " << *next;
}

TEST(Registry, every_row_says_all_that_is_shown_of_it) {
  std::set<std::string> names;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    EXPECT_TRUE(is_kebab_case(row->name)) << row->name;
    EXPECT_TRUE(names.insert(row->name).second) << row->name << " is there twice";
    EXPECT_FALSE(row->summary.empty()) << row->name;
    EXPECT_FALSE(row->source.empty()) << row->name;
    EXPECT_TRUE(row->points || row->spots) << row->name;
    EXPECT_FALSE(row->kinds.empty()) << row->name;
    EXPECT_TRUE(!row->exact || row->conservative) << row->name << ": what is exact loses nothing";
    expect_valid(row->params);
    EXPECT_TRUE(row->answers(Answer::lists) || row->answers(Answer::structure)) << row->name;
    if (row->answers(Answer::lists)) {
      EXPECT_NE(row->make(Params(row->params)), nullptr);
    }
    if (row->answers(Answer::structure)) {
      EXPECT_NE(row->make_own(Params(row->params))->make_structure(), nullptr);
    }
  }
}

TEST(Registry, every_grid_kind_has_an_assigner) {
  for (int kind = 0; kind < grid::k_kind_count; ++kind)
    EXPECT_TRUE(std::any_of(assigner_descriptors().begin(), assigner_descriptors().end(),
                            [&](const AssignerDescriptor* row) { return row->takes(static_cast<grid::Kind>(kind)); }))
        << grid::kind_name(static_cast<grid::Kind>(kind));
}

TEST(Registry, rows_are_found_by_name_and_nothing_else_is) {
  for (const AssignerDescriptor* row : assigner_descriptors()) EXPECT_EQ(find_assigner(row->name), row);
  EXPECT_EQ(find_assigner("brute_force"), nullptr);
  EXPECT_EQ(find_assigner(""), nullptr);
}

TEST(Registry, a_row_takes_the_grid_kinds_that_it_names) {
  const AssignerDescriptor* aabb = find_assigner("aabb");
  EXPECT_TRUE(aabb->takes(grid::Kind::frustum));
  EXPECT_FALSE(aabb->takes(grid::Kind::world));
}

TEST(Registry, what_takes_the_conservative_promise_away_and_what_shares_work_is_data) {
  AssignerDescriptor any = *find_assigner("exact-fast");
  any.params = {{.name = "slack",
                 .summary = "of its tests",
                 .default_value = 2.0,
                 .unit = "",
                 .min = 0.0,
                 .max = 9.0,
                 .choices = {},
                 .conservative_from = 1.5},
                {.name = "workers",
                 .summary = "that share a frame",
                 .default_value = 1.0,
                 .unit = "",
                 .min = 1.0,
                 .max = 9.0,
                 .choices = {},
                 .whole = true,
                 .is_thread_count = true}};
  EXPECT_TRUE(is_conservative(any, Params(any.params)));
  EXPECT_FALSE(is_conservative(any, Params(any.params, {{"slack", 1.25}})));
  EXPECT_EQ(thread_count(any, Params(any.params)), 1);
  EXPECT_EQ(thread_count(any, Params(any.params, {{"workers", 4.0}})), 4);
  EXPECT_FALSE(is_conservative(*find_assigner("aabb"), Params(find_assigner("aabb")->params, {{"inflation", 0.5}})));
  EXPECT_EQ(thread_count(*find_assigner("exact-fast"), Params(find_assigner("exact-fast")->params, {{"threads", 3.0}})),
            3);
}

TEST(Registry, a_method_registered_at_run_time_is_one_of_them_as_long_as_its_registration_lives) {
  const std::size_t before = assigner_descriptors().size();
  {
    AssignerDescriptor mine = *find_assigner("aabb");
    mine.name = "mine";
    const AssignerRegistration registration(mine);
    EXPECT_EQ(find_assigner("mine"), &registration.descriptor());
    EXPECT_EQ(assigner_names().back(), "mine");
    EXPECT_THROW(AssignerRegistration{mine}, Error);
  }
  EXPECT_EQ(find_assigner("mine"), nullptr);
  EXPECT_EQ(assigner_descriptors().size(), before);
}

TEST(Registry, every_storage_says_all_that_is_shown_of_it) {
  ASSERT_GE(storage_names().size(), 2u);
  EXPECT_EQ(storage_names()[0], "packed");
  EXPECT_EQ(storage_names()[1], "fixed");
  for (const StorageDescriptor* row : storage_descriptors()) {
    EXPECT_TRUE(is_kebab_case(row->name)) << row->name;
    EXPECT_FALSE(row->summary.empty() || row->source.empty()) << row->name;
    expect_valid(row->params);
    EXPECT_NE(row->make(Params(row->params)), nullptr);
    EXPECT_EQ(find_storage(row->name), row);
  }
  EXPECT_EQ(find_storage("stack"), nullptr);
}

}  // namespace
}  // namespace clusterbench::assign
