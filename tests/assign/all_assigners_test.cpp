// What holds for every registered assigner, and what it takes to add one.

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "assign/contract.h"
#include "assign/contract/assigner_run.h"
#include "assign/dense_check.h"
#include "core/text.h"
#include "effort.h"

namespace clusterbench::assign::testing {
namespace {

// Under sanitizers each choice in a third of the views.
TEST(EveryAssigner, keeps_the_contract_in_every_view_with_every_choice) {
  std::size_t turn = 0;
  for (const AssignerDescriptor* row : assigner_descriptors())
    for (const Setting& setting : settings_for(*row, 7))
      for (const Params& params : test::some(params_of(*row), 3, turn++ % 3)) {
        const std::vector<std::string> faults = contract_faults(*row, params, setting);
        std::string choices;
        for (const auto& [name, value] : params.values())
          if (const auto* text = std::get_if<std::string>(&value)) choices += " " + name + "=" + *text;
        EXPECT_TRUE(faults.empty()) << row->name << choices << " on " << setting.name << ": " << joined(faults, "; ");
      }
}

TEST(EveryAssigner, loses_no_light_at_boundaries_with_many_seeds) {
  for (const AssignerDescriptor* row : assigner_descriptors())
    for (int i = 0; i < test::tries(3); ++i)
      for (const Setting& setting : settings_for(*row, 10 * (100 + static_cast<std::uint64_t>(i)))) {
        const std::vector<std::string> faults = contract_faults(*row, Params(row->params), setting);
        EXPECT_TRUE(faults.empty()) << row->name << " on " << setting.name << ": " << joined(faults, "; ");
      }
}

// A setting's frame with some of its lights.
struct SomeLights {
  view::Frame frame;
  view::LightArrays lights;

  SomeLights(const Setting& setting, Random& random) : frame(setting.frame) {
    std::erase_if(frame.lights, [&, share = random.unit()](const scene::WorldLight&) { return random.unit() < share; });
    frame.count_types();
    lights = view::lights_in(frame, grid::space_of(setting.grid, frame));
  }
};

// The most that instances hold which share the frames, each frame's by chance. The grids, which have the same number of
// cells, take turns.
std::size_t most_scratch(const AssignerDescriptor& row, const Setting& setting, const std::vector<grid::Grid>& grids,
                         const std::vector<SomeLights>& frames, std::size_t instances, Random& random) {
  std::vector<AssignerRun> runs;
  for (std::size_t i = 0; i < instances; ++i) runs.emplace_back(row, Params(row.params), Answer::lists);
  std::vector<const grid::Grid*> built(instances);
  std::size_t most = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::size_t instance = random.below(instances);
    const grid::Grid& grid = grids[i % grids.size()];
    if (std::exchange(built[instance], &grid) != &grid) runs[instance].build(grid);
    runs[instance].assign({frames[i].frame, frames[i].lights, setting.input(frames[i].lights).depth});
    most = std::max(most, runs[instance].scratch_bytes());
  }
  return most;
}

// The setting's grid, and for one of tiles as many slices elsewhere, as grids have that follow their frames.
std::vector<grid::Grid> grids_of(const Setting& setting, bool is_following) {
  std::vector<grid::Grid> grids;
  if (!is_following || setting.grid.kind() != grid::Kind::frustum) return {setting.grid};
  for (const double scale : {1.0, 2.0, 3.5})
    grids.push_back(grid_of(settings::screen_spec(grid::Kind::frustum, {9, 6}, grid::Scheme::exponential, 12,
                                                  scale * setting.frame.projection.near_m),
                            setting.frame));
  return grids;
}

TEST(EveryAssigner, that_shares_frames_holds_as_much_memory_as_one_that_gets_all) {
  Random random(61);
  int methods = 0;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    if (!row->answers(Answer::lists) || !AssignerRun(*row, Params(row->params), Answer::lists).shares_frames(true))
      continue;
    ++methods;
    for (const Setting& setting : settings_for(*row, 7))
      for (const bool is_following : {false, true}) {
        const std::vector<grid::Grid> grids = grids_of(setting, is_following);
        std::vector<SomeLights> frames;
        for (int i = 0; i < 6; ++i) frames.emplace_back(setting, random);
        const std::size_t alone = most_scratch(*row, setting, grids, frames, 1, random);
        EXPECT_EQ(most_scratch(*row, setting, grids, frames, 3, random), alone) << row->name << " on " << setting.name;
      }
  }
  EXPECT_GE(methods, 10);
}

// Several instances that share frames and fill the memory of earlier lists have the lists of one instance.
TEST(EveryAssigner, that_shares_frames_has_the_same_lists_in_any_memory) {
  Random random(62);
  int methods = 0;
  for (const AssignerDescriptor* row : assigner_descriptors()) {
    if (!row->answers(Answer::lists) || !AssignerRun(*row, Params(row->params), Answer::lists).shares_frames(false))
      continue;
    ++methods;
    for (const Setting& setting : settings_for(*row, 7)) {
      AssignerRun alone(*row, Params(row->params), Answer::lists);
      std::vector<AssignerRun> sharing;
      for (int i = 0; i < 3; ++i) sharing.emplace_back(*row, Params(row->params), Answer::lists);
      for (AssignerRun* run : {&alone, sharing.data(), &sharing[1], &sharing[2]}) run->build(setting.grid);
      std::array<Lists, 2> filled;
      std::array<std::optional<Lists>, 2> ascending;
      for (int i = 0; i < 8; ++i) {
        const SomeLights frame(setting, random);
        const FrameInput input{frame.frame, frame.lights, setting.input(frame.lights).depth};
        AssignerRun& one = sharing[random.below(3)];
        const std::size_t place = random.below(2);
        alone.assign(input);
        one.use_memory_of(std::move(filled[place]));
        one.assign(input);
        EXPECT_EQ(one.tests_done(), alone.tests_done()) << row->name << " on " << setting.name;
        EXPECT_EQ(one.fallbacks(), alone.fallbacks()) << row->name << " on " << setting.name;
        const ListOrder order = random.below(2) == 0 ? ListOrder::any : ListOrder::ascending;
        one.hand_over(order, filled[place], ascending[place]);
        EXPECT_EQ(filled[place], *alone.filled_lists()) << row->name << " on " << setting.name;
        EXPECT_EQ(ascending[place] ? *ascending[place] : filled[place], alone.cell_lists(order))
            << row->name << " on " << setting.name;
      }
    }
  }
  EXPECT_GE(methods, 20);
}

// --- Adding an assigner: a class and a row, as in a file of src/assign/assigners ---

// Lists every light with volume in every cell; or wrongly, as its fault says.
class Everywhere : public ListAssigner {
 public:
  enum class Fault { none, loses_last_light, lists_twice, keeps_frames, allocates, builds_late };
  explicit Everywhere(Fault fault) : fault_(fault) {}

  void build(const grid::Grid& grid, const LightKinds&) override {
    grid_ = &grid;
    table_.reset();
  }

  void assign(const FrameInput& input, Lists& out) override {
    const view::LightArrays& lights = input.lights;
    tests_ = 0;
    if (fault_ == Fault::allocates) waste_ = std::make_unique<int>(1);
    if (fault_ == Fault::builds_late && !table_) table_ = std::make_unique<int>(1);
    pairs_.start(grid_->cell_count());
    const std::uint32_t skipped = fault_ == Fault::loses_last_light && lights.size() > 0 ? 1 : 0;
    for (std::uint32_t light = 0; light + skipped < lights.size(); ++light)
      if (lights.radius[light] > 0.0f) add_light(light);
    if (fault_ == Fault::keeps_frames && frames_++ > 0 && lights.size() > 0) pairs_.add(0, lights.size());
    pairs_.finish(out);
  }

  std::uint64_t tests_done() const override { return tests_; }
  std::size_t scratch_bytes() const override { return pairs_.capacity_bytes(); }

 private:
  void add_light(std::uint32_t light) {
    for (std::uint32_t cell = 0; cell < grid_->cell_count(); ++cell)
      if (!grid_->is_hole(cell)) pairs_.add(cell, light);
    if (fault_ == Fault::lists_twice && light == 0) pairs_.add(grid_->cell_count() - 1, light);
    tests_ += grid_->cell_count();
  }

  Fault fault_;
  const grid::Grid* grid_ = nullptr;
  PairBuffer pairs_;
  std::uint64_t tests_ = 0;
  int frames_ = 0;
  std::unique_ptr<int> waste_, table_;
};

template <Everywhere::Fault fault>
AssignerDescriptor everywhere_row() {
  return {.name = "everywhere",
          .summary = "every light in every cell",
          .source = "forward rendering without culling",
          .kinds = {grid::Kind::cascades, grid::Kind::world},
          .params = {},
          .make = [](const Params&) -> std::unique_ptr<ListAssigner> { return std::make_unique<Everywhere>(fault); }};
}

std::string faults_of(const AssignerDescriptor& row) {
  std::string all;
  for (const Setting& setting : settings_for(row, 8)) all += joined(contract_faults(row, Params(), setting), "; ");
  return all;
}

TEST(AddingAnAssigner, takes_a_class_and_a_row_and_is_held_to_the_same_contract) {
  EXPECT_EQ(faults_of(everywhere_row<Everywhere::Fault::none>()), "");
}

TEST(AddingAnAssigner, one_that_loses_a_light_is_caught) {
  EXPECT_NE(faults_of(everywhere_row<Everywhere::Fault::loses_last_light>()).find("is lost"), std::string::npos);
}

TEST(AddingAnAssigner, one_that_lists_a_light_twice_is_caught) {
  EXPECT_NE(faults_of(everywhere_row<Everywhere::Fault::lists_twice>()).find("each once"), std::string::npos);
}

TEST(AddingAnAssigner, one_that_remembers_frames_is_caught) {
  EXPECT_NE(faults_of(everywhere_row<Everywhere::Fault::keeps_frames>()).find("the frame before"), std::string::npos);
}

TEST(AddingAnAssigner, one_that_allocates_in_a_steady_frame_is_caught) {
  EXPECT_NE(faults_of(everywhere_row<Everywhere::Fault::allocates>()).find("allocates 1 times"), std::string::npos);
}

TEST(AddingAnAssigner, one_that_leaves_its_build_to_the_first_frame_is_caught) {
  EXPECT_NE(faults_of(everywhere_row<Everywhere::Fault::builds_late>()).find("after a build"), std::string::npos);
}

}  // namespace
}  // namespace clusterbench::assign::testing
