// Every conservative assigner against the exact truth: random lights, and lights that touch cells by a hair.

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "effort.h"
#include "measure/truth/truth.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Setting;

// Cell, light and how deep the first lost pair lies; nothing if none is lost.
std::string first_loss(const assign::Lists& found, const assign::Lists& truth, const Setting& setting) {
  for (std::uint32_t cell = 0; cell < truth.cell_count(); ++cell)
    for (const std::uint32_t light : truth.of(cell))
      if (!assign::testing::lists_light(found, cell, light))
        return "cell " + std::to_string(cell) + " lost light " + std::to_string(light) + " at " +
               std::to_string(relative_distance(setting.frame, setting.grid, cell, light)) + " of its range";
  return "";
}

// Each form's lists of the cells.
std::vector<assign::Lists> lists_of(const assign::AssignerDescriptor& row, const assign::Params& params,
                                    const Setting& setting) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  std::vector<assign::Lists> all;
  for (const assign::Answer answer : assign::answers_with_cells(row, params)) {
    assign::AssignerRun run(row, params, answer);
    run.build(setting.grid);
    run.assign(setting.input(lights));
    all.push_back(run.cell_lists());
  }
  return all;
}

TEST(AssignersAgainstTruth, a_conservative_assigner_loses_no_true_pair_in_any_view_with_any_choice) {
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->conservative || row->needs.depth) continue;  // occupied_cells_test.cpp
    for (int i = 0; i < test::tries(2); ++i)
      for (const Setting& setting : assign::testing::settings_for(*row, 31 + static_cast<std::uint64_t>(i))) {
        const Truth truth = find_truth(setting.frame, setting.grid, 2);
        EXPECT_EQ(truth.undecided, 0u) << setting.name;
        for (const assign::Params& params : assign::testing::params_of(*row))
          for (const assign::Lists& found : lists_of(*row, params, setting))
            EXPECT_EQ(first_loss(found, truth.lists, setting), "") << row->name << " on " << setting.name;
      }
  }
}

TEST(AssignersAgainstTruth, an_exact_assigner_lists_the_true_pairs_alone) {
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors()) {
    if (!row->exact) continue;
    for (const Setting& setting : assign::testing::settings_for(*row, 33))
      for (const assign::Params& params : assign::testing::params_of(*row))
        for (const assign::Lists& found : lists_of(*row, params, setting))
          EXPECT_EQ(found, find_truth(setting.frame, setting.grid, 2).lists) << row->name << " on " << setting.name;
  }
}

TEST(AssignersAgainstTruth, the_truth_holds_every_light_that_touches_by_a_hair) {
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    for (const Setting& setting : assign::testing::settings_for(*row, 34)) {
      const Truth truth = find_truth(setting.frame, setting.grid, 2);
      for (const auto& [cell, light] : setting.touches)
        EXPECT_TRUE(assign::testing::lists_light(truth.lists, cell, light)) << setting.name << ", cell " << cell;
    }
}

TEST(AssignersAgainstTruth, no_true_pair_is_lost_at_any_scale_of_the_domain_and_exact_lists_are_true) {
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    for (const Setting& setting : assign::testing::settings_of_any_size(*row, test::tries(16), 36)) {
      if (!row->conservative || row->needs.depth) continue;
      const Truth truth = find_truth(setting.frame, setting.grid, 2);
      EXPECT_EQ(truth.undecided, 0u) << setting.name;
      for (const assign::Lists& found : lists_of(*row, assign::Params(row->params), setting)) {
        EXPECT_EQ(first_loss(found, truth.lists, setting), "") << row->name << " on " << setting.name;
        if (row->exact) {
          EXPECT_EQ(found, truth.lists) << row->name << " on " << setting.name;
        }
      }
    }
}

}  // namespace
}  // namespace clusterbench::measure
