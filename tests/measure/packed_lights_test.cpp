// Conservative assigners on lights that were packed: what they lose, and that inflation gives it back.

#include <gtest/gtest.h>

#include <map>

#include "assign/contract/assigner_run.h"
#include "assign/settings.h"
#include "effort.h"
#include "measure/truth/truth.h"
#include "places.h"
#include "view/packing.h"

namespace clusterbench::measure {
namespace {

using assign::testing::Setting;
using view::Packing;

constexpr Packing k_lossy[] = {Packing::half, Packing::unorm16};

std::uint64_t missing(const assign::Lists& found, const assign::Lists& truth) {
  std::uint64_t count = 0;
  for (std::uint32_t cell = 0; cell < truth.cell_count(); ++cell)
    for (const std::uint32_t light : truth.of(cell)) count += assign::testing::lists_light(found, cell, light) ? 0 : 1;
  return count;
}

assign::Lists lists_of(const assign::AssignerDescriptor& row, const assign::Params& params, const Setting& setting,
                       const view::LightArrays& lights) {
  assign::AssignerRun run(row, params, assign::answers_with_cells(row, params).front());
  run.build(setting.grid);
  run.assign({setting.frame, lights});
  return run.cell_lists();
}

// Adds what is lost without inflation to `lost`, by packing; with inflation nothing may be.
void check(const assign::AssignerDescriptor& row, const Setting& setting, const Truth& truth,
           const std::vector<assign::Params>& choices, std::map<Packing, std::uint64_t>& lost) {
  const view::LightArrays lights = view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame));
  for (const Packing packing : k_lossy) {
    const view::PackedLights packed = view::packed(lights, packing);
    const view::LightArrays inflated = view::inflated(packed);
    for (const assign::Params& params : choices) {
      lost[packing] += missing(lists_of(row, params, setting, packed.lights), truth.lists);
      EXPECT_EQ(missing(lists_of(row, params, setting, inflated), truth.lists), 0u)
          << row.name << " on " << setting.name << ", " << view::packing_name(packing);
    }
  }
}

// Those that see the packed numbers: an exact one goes back to the scene's.
std::vector<const assign::AssignerDescriptor*> conservative_rows() {
  std::vector<const assign::AssignerDescriptor*> rows;
  for (const assign::AssignerDescriptor* row : assign::assigner_descriptors())
    if (row->conservative && !row->exact && !row->needs.depth) rows.push_back(row);
  return rows;
}

TEST(PackedLights, lose_pairs_with_every_conservative_assigner_unless_they_are_inflated) {
  for (const assign::AssignerDescriptor* row : test::some(conservative_rows(), 4)) {
    assign::AssignerDescriptor of_lights = *row;
    of_lights.boxes = false;  // they have no packed format
    std::map<Packing, std::uint64_t> lost;
    for (const Setting& setting : assign::testing::settings_for(of_lights, 41))
      check(*row, setting, find_truth(setting.frame, setting.grid, 2), assign::testing::params_of(*row), lost);
    for (const Packing packing : k_lossy)
      EXPECT_GT(lost[packing], 0u) << row->name << " with " << view::packing_name(packing) << ": no power";
  }
}

// A frame of one of the project's own scenes with a grid of the row's kind.
Setting setting_of(const scene::Scene& scene, const scene::Shot& shot, grid::Kind kind) {
  using namespace assign::testing;
  Setting setting;
  setting.name = scene.name + ", " + grid::kind_name(kind);
  setting.frame = view::make_frame(scene, shot, 0, {1920, 1080});
  const grid::GridSpec spec = kind == grid::Kind::world || kind == grid::Kind::cascades
                                  ? settings::box_spec(kind, {16, 8, 16})
                                  : settings::screen_spec(kind, {16, 9}, grid::Scheme::exponential, 24, 0.1);
  setting.grid = assign::testing::grid_of(spec, setting.frame);
  return setting;
}

TEST(PackedLights, of_the_projects_scenes_lose_pairs_unless_they_are_inflated) {
  std::map<Packing, std::uint64_t> lost;
  for (const char* name : {"hall-512", "open-world", "street", "jam", "mirror", "outlier"}) {
    scene::Scene scene =
        scene::load_gltf(std::filesystem::path(test::source_dir()) / "scenes" / (name + std::string(".glb")));
    scene::resolve_ranges(scene, {});
    const scene::CameraPath path = scene::camera_paths(scene, {.camera = "", .count = test::tries(3)}).front();
    for (const grid::Kind kind : {grid::Kind::frustum, grid::Kind::distance, grid::Kind::cascades, grid::Kind::world})
      for (const scene::Shot& shot : path.shots) {
        const Setting setting = setting_of(scene, shot, kind);
        const Truth truth = find_truth(setting.frame, setting.grid, 2);
        for (const assign::AssignerDescriptor* row : conservative_rows())
          if (row->takes(kind)) check(*row, setting, truth, {assign::Params(row->params)}, lost);
      }
  }
  for (const Packing packing : k_lossy) EXPECT_GT(lost[packing], 100u) << view::packing_name(packing);
}

}  // namespace
}  // namespace clusterbench::measure
