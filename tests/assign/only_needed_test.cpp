// Only what the scene needs is done, shown by what can be counted.

#include <gtest/gtest.h>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "core/error.h"
#include "effort.h"

namespace clusterbench::assign {
namespace {

using testing::Setting;

struct Work {
  std::uint64_t tests;
  std::size_t scratch_bytes;
  Lists lists;
};

Work work_of(const AssignerDescriptor& row, const Params& params, const Setting& setting,
             Answer answer = Answer::lists) {
  AssignerRun run(row, params, answer);
  Work work{};
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  run.build(setting.grid, kinds_of(lights));
  run.assign(setting.input(lights));
  work.lists = run.cell_lists();
  work.tests = run.tests_done();
  work.scratch_bytes = run.scratch_bytes();
  return work;
}

void add_point(Setting& setting, const Vec3d& place, double range) {
  setting.frame.lights.insert(setting.frame.lights.begin(), testing::point_light(place, range));
  ++setting.frame.points;
}

// Ten kilometres from everything.
void add_distant_points(Setting& setting, int count) {
  for (int i = 0; i < count; ++i)
    add_point(setting, setting.frame.view_space.origin + Vec3d{3e3 * (i % 3 - 1), 0, 1e4 + i}, 5.0);
}

TEST(OnlyWhatIsNeeded, a_light_outside_of_the_view_costs_at_most_one_test_and_makes_no_pair) {
  constexpr int k_more = 500;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    if (row->all_pairs || row->naive) continue;
    const Params params(row->params);
    for (const Setting& setting : test::some(testing::settings_for(*row, 3)))
      for (const Answer answer : answers_with_cells(*row, params)) {
        Setting more = setting;
        add_distant_points(more, k_more);
        const Work before = work_of(*row, params, setting, answer), after = work_of(*row, params, more, answer);
        EXPECT_LE(after.tests, before.tests + k_more) << row->name << ", " << setting.name;
        EXPECT_EQ(after.lists.pair_count(), before.lists.pair_count()) << row->name << ", " << setting.name;
      }
  }
}

Setting points_only(Setting setting) {
  setting.frame.lights.resize(setting.frame.points);
  setting.frame.boxes = 0;
  return setting;
}

// The balls around cells that cones are tested with are built where there are spots.
TEST(OnlyWhatIsNeeded, without_spots_nothing_is_prepared_for_them) {
  int methods = 0;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    const Params params(row->params);
    if (row->naive || !row->answers(Answer::lists) || !params.values().contains("spot")) continue;
    ++methods;
    const Setting without = points_only(testing::settings_for(*row, 3).front());
    Setting with = without;
    with.frame.lights.push_back(
        testing::spot_light(with.frame.view_space.origin + Vec3d{0, 0, 1e4}, 5.0, {0, 0, -1}, 0.5));
    const Work few = work_of(*row, params, without), more = work_of(*row, params, with);
    EXPECT_GE(more.scratch_bytes, few.scratch_bytes + without.grid.cell_count() * sizeof(geom::Ball)) << row->name;
    EXPECT_EQ(more.lists, few.lists) << row->name;
  }
  EXPECT_GT(methods, 5);
}

TEST(OnlyWhatIsNeeded, spots_that_the_build_was_not_told_of_are_refused) {
  for (const char* name : {"aabb", "exact", "sphere-refinement-fast"}) {
    const AssignerDescriptor& row = *find_assigner(name);
    const Setting setting = testing::settings_for(row, 3).front();
    const auto assigner = row.make(Params(row.params));
    assigner->build(setting.grid, {.spots = false});
    Lists lists;
    const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
    ASSERT_FALSE(lights.spots.empty());
    EXPECT_THROW(assigner->assign({setting.frame, lights}, lists), Error) << name;
  }
}

TEST(OnlyWhatIsNeeded, few_lights_are_not_shared_among_threads) {
  const AssignerDescriptor& row = *find_assigner("exact-fast");
  Setting few = testing::settings_for(row, 3).front();
  few.frame.points = 20;
  few = points_only(few);
  const Params two(row.params, {{"threads", 2.0}});
  EXPECT_EQ(work_of(row, two, few).scratch_bytes, work_of(row, Params(row.params), few).scratch_bytes);
  Setting many = few;
  for (int i = 0; i < 3000; ++i)
    add_point(many, many.frame.view_space.origin - 20.0 * glm::transpose(many.frame.view_space.rotation)[2], 5.0);
  EXPECT_NE(work_of(row, two, many).scratch_bytes, work_of(row, Params(row.params), many).scratch_bytes);
}

}  // namespace
}  // namespace clusterbench::assign
