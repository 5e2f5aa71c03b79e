#include "run/cases/plan.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "core/error.h"

namespace clusterbench::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_perspective =
    R"({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100}})";
constexpr const char* k_orthographic =
    R"({"type": "orthographic", "orthographic": {"xmag": 10, "ymag": 10, "znear": 0, "zfar": 100}})";

class MakePlan : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "other"); }
  void TearDown() override { fs::remove_all(folder_); }

  void write_scene(const std::string& name, const char* camera = k_perspective) const {
    std::ofstream(folder_ / name) << R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
             "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 5}]}},
             "cameras": [)" << camera
                                  << R"(], "nodes": [{"name": "eye", "camera": 0},
             {"translation": [0, 0, -10], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
             "scenes": [{"nodes": [0, 1]}], "scene": 0})";
  }

  Plan plan(const std::string& scenes, const std::string& rest, const std::string& filter = "") const {
    return make_plan(config::parse_config(R"({"scenes": )" + scenes + rest + "}", folder_ / "c.json"), filter);
  }

  static std::vector<CasePlan> cases(const Plan& plan) {
    std::vector<CasePlan> out;
    for (const GroupPlan& group : plan.groups) out.insert(out.end(), group.cases.begin(), group.cases.end());
    return out;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("clusterbench_plan_" + std::to_string(getpid()));
};

constexpr const char* k_two_grids =
    R"(, "grids": [{"slices": {"count": [8, 16]}}, {"kind": "world"}], "assigners": ["brute-force", "aabb", "world-grid"])";

TEST_F(MakePlan, a_structure_that_has_nothing_of_its_grid_is_measured_once) {
  write_scene("hall.gltf");
  const std::string grids =
      R"(, "grids": [{"kind": "frustum", "tiles": {"pixels": [[64, 64], [32, 32]]}}, {"kind": "world"}],
      "assigners": ["bvh"])";
  const auto own = [&](const std::string& filter) {
    std::vector<std::string> names;
    for (const CasePlan& one : cases(plan(R"(["hall.gltf"])", grids, filter)))
      if (!one.storage) names.push_back(one.name);
    return names;
  };
  ASSERT_EQ(own("").size(), 1u);
  EXPECT_NE(own("")[0].find("64px"), std::string::npos);
  ASSERT_EQ(own("world").size(), 1u) << "the first that is wanted";
  const Plan all = plan(R"(["hall.gltf"])", grids);
  EXPECT_EQ(cases(all).size(), 4u) << "lists on each grid, and itself";
  const auto skipped = std::ranges::find_if(
      all.skipped, [](const Skipped& one) { return one.reason.find("measured once, as hall/") != std::string::npos; });
  EXPECT_NE(skipped, all.skipped.end());
}

TEST_F(MakePlan, every_combination_that_can_be_is_a_case) {
  write_scene("a.gltf");
  const Plan two = plan(R"(["a.gltf"])", std::string(k_two_grids) + R"(, "viewports": [[640, 480], [320, 240]])");
  EXPECT_EQ(two.groups.size(), 2U * 3U);
  EXPECT_EQ(cases(two).size() + two.skipped.size(), 2U * 3U * 3U);
}

TEST_F(MakePlan, an_assigner_that_does_not_take_the_grid_is_skipped_with_its_reason) {
  write_scene("a.gltf");
  const Plan plan =
      this->plan(R"(["a.gltf"])", R"(, "grids": [{}, {"kind": "world"}], "assigners": ["brute-force", "aabb"])");
  const bool found = std::any_of(plan.skipped.begin(), plan.skipped.end(), [](const Skipped& skipped) {
    return skipped.name.starts_with("a/eye/world") && skipped.name.ends_with("/aabb") &&
           skipped.reason.starts_with("aabb takes ") && skipped.reason.ends_with(" grids, not world");
  });
  EXPECT_TRUE(found);
}

TEST_F(MakePlan, boxes_are_assigned_where_they_are_asked_for_and_methods_that_take_none_are_skipped) {
  std::ofstream(folder_ / "b.gltf") << R"({"asset": {"version": "2.0"}, "cameras": [)" << k_perspective
                                    << R"(], "nodes": [{"name": "eye", "camera": 0},
             {"name": "decal", "extras": {"clusterbench_box": {"half_extents": [1, 1, 0]}}}],
             "scenes": [{"nodes": [0, 1]}], "scene": 0})";
  const std::string rest = R"(, "grids": [{}], "storages": ["packed"], "assigners": ["box-refined", "bounds"])";
  const Plan without = plan(R"([{"path": "b.gltf"}])", rest),
             off = plan(R"([{"path": "b.gltf", "boxes": false}])", rest),
             with = plan(R"([{"path": "b.gltf", "boxes": true}])", rest);
  ASSERT_EQ(cases(without).size(), 2u);
  EXPECT_TRUE(without.skipped.empty());
  EXPECT_EQ(cases(off).front().id, cases(without).front().id);
  ASSERT_EQ(cases(with).size(), 1u);
  EXPECT_NE(cases(with).front().id, cases(without).front().id);
  ASSERT_EQ(with.skipped.size(), 1u);
  EXPECT_EQ(with.skipped[0].reason, "bounds takes no boxes");
  ASSERT_EQ(with.scenes[0].scene.lights.size(), 1u);
  EXPECT_EQ(with.scenes[0].scene.lights[0].name, "decal");
  const Plan reacting =
      plan(R"([{"path": "b.gltf", "boxes": true}])",
           R"(, "grids": [{}, {"react": {"to": "entries", "most": 9}}], "assigners": ["box-refined"])");
  ASSERT_EQ(reacting.skipped.size(), 1u);
  EXPECT_TRUE(
      reacting.skipped[0].reason.starts_with("its tiles react to the lists of exact-fast, which takes no boxes"));
  const Plan packed = plan(R"([{"path": "b.gltf", "boxes": true}])", rest + R"(, "precision": ["float32", "half"])");
  EXPECT_EQ(cases(packed).size(), 1u);
}

TEST_F(MakePlan, a_grid_that_the_camera_cannot_have_is_skipped_with_its_reason) {
  write_scene("a.gltf", k_orthographic);
  const Plan plan =
      this->plan(R"(["a.gltf"])", R"(, "grids": [{"slices": {"scheme": ["linear", "exponential", "cubical-first"]}}],
                                                   "assigners": ["brute-force"])");
  ASSERT_EQ(plan.skipped.size(), 1U);
  EXPECT_NE(plan.skipped[0].reason.find("slices.scheme"), std::string::npos) << plan.skipped[0].reason;
  EXPECT_EQ(cases(plan).size(), 2U);
}

TEST_F(MakePlan, names_and_ids_are_unique_and_ids_are_short_hashes) {
  write_scene("a.gltf");
  write_scene("other/a.gltf");
  const Plan plan = this->plan(R"(["a.gltf", "other/a.gltf", {"path": "a.gltf", "frames": 7}])", k_two_grids);
  EXPECT_EQ(plan.scenes[1].scene.name, "a-2");
  EXPECT_EQ(plan.scenes[2].scene.name, "a-3");
  std::set<std::string> names, ids;
  for (const CasePlan& case_plan : cases(plan)) {
    EXPECT_TRUE(names.insert(case_plan.name).second) << case_plan.name;
    EXPECT_TRUE(ids.insert(case_plan.id).second) << case_plan.id;
    EXPECT_EQ(std::count(case_plan.name.begin(), case_plan.name.end(), '/'), 4) << case_plan.name;
  }
}

TEST_F(MakePlan, an_id_depends_on_what_is_counted_and_not_on_how_it_is_timed_or_ordered) {
  write_scene("a.gltf");
  const std::string text = R"(, "grids": [{}], "assigners": ["brute-force"])";
  const std::string id = cases(plan(R"(["a.gltf"])", text)).at(0).id;
  EXPECT_EQ(id, "3bf86f11bda4") << "results of earlier versions are compared by it";
  EXPECT_EQ(cases(plan(R"(["a.gltf"])", text + R"(, "timing": {"rounds": 3}, "threads": 2)")).at(0).id, id);
  EXPECT_EQ(
      cases(plan(R"(["a.gltf"])",
                 R"(, "grids": [{"kind": "distance"}, {"slices": {"count": 8}}, {}], "assigners": ["brute-force"])"))
          .back()
          .id,
      id);
  EXPECT_NE(cases(plan(R"(["a.gltf"])", text + R"(, "viewport": [640, 480])")).at(0).id, id);
  EXPECT_NE(cases(plan(R"(["a.gltf"])", text + R"(, "storages": ["fixed"])")).at(0).id, id);
  EXPECT_EQ(cases(plan(R"(["a.gltf"])", text + R"(, "limits": {"fail_if": ["unlit > 0"]})")).at(0).id, id);
  EXPECT_NE(cases(plan(R"(["a.gltf"])", text + R"(, "jitter": "halton")")).at(0).id, id);
  EXPECT_EQ(cases(plan(R"(["a.gltf"])", text + R"(, "stability": null)")).at(0).id, id);
  const std::string stable = cases(plan(R"(["a.gltf"])", text + R"(, "stability": {})")).at(0).id;
  EXPECT_NE(stable, id);
  EXPECT_NE(cases(plan(R"(["a.gltf"])", text + R"(, "stability": {"window": 3})")).at(0).id, stable);
  EXPECT_EQ(cases(plan(R"(["a.gltf"])", text + R"(, "precision": ["float32"])")).at(0).id, id);
  const std::vector<CasePlan> packed =
      cases(plan(R"(["a.gltf"])",
                 text + R"(, "precision": ["float32", {"packing": ["half", "unorm16"], "inflate": [false, true]}])"));
  std::set<std::string> ids;
  for (const CasePlan& each : packed) {
    EXPECT_EQ(each.id.size(), 12U) << "a hash, not one that stands here twice";
    ids.insert(each.id);
  }
  EXPECT_EQ(ids.size(), 5U);
  EXPECT_EQ(packed.at(0).id, id);
  EXPECT_NE(cases(plan(R"([{"path": "a.gltf", "range_rule": {"max_range": 3}}])", text)).at(0).id, id);
  EXPECT_NE(cases(plan(R"([{"path": "a.gltf", "camera_fit": "vertical"}])", text)).at(0).id, id);
  EXPECT_NE(cases(plan(R"([{"path": "a.gltf", "far": 50}])", text)).at(0).id, id);
  EXPECT_EQ(cases(plan(R"([{"path": "a.gltf", "camera_fit": "contain"}])", text)).at(0).id, id);
}

TEST_F(MakePlan, a_name_tells_the_precision_where_it_is_not_float32) {
  write_scene("a.gltf");
  const std::string text = R"(, "grids": [{}], "assigners": ["aabb"], "storages": ["packed", "fixed"])";
  const std::vector<CasePlan> plain = cases(plan(R"(["a.gltf"])", text));
  const std::vector<CasePlan> all = cases(
      plan(R"(["a.gltf"])", text + R"(, "precision": ["float32", "half", {"packing": "unorm16", "inflate": true}])"));
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[0].name, plain[0].name);
  EXPECT_EQ(all[1].name, plain[1].name);
  EXPECT_EQ(all[2].name, plain[0].name + "/half");
  EXPECT_EQ(all[5].name, plain[1].name + "/unorm16+inflate");
}

TEST_F(MakePlan, an_exact_assigner_is_skipped_on_packed_lights_with_its_reason) {
  write_scene("a.gltf");
  const Plan plan = this->plan(R"(["a.gltf"])", R"(, "grids": [{}], "assigners": ["exact", "aabb"],
                                                   "precision": ["float32", {"packing": "half", "inflate": true}])");
  EXPECT_EQ(cases(plan).size(), 3U);
  ASSERT_EQ(plan.skipped.size(), 1U);
  EXPECT_TRUE(plan.skipped[0].name.ends_with("/exact/half+inflate")) << plan.skipped[0].name;
  EXPECT_NE(plan.skipped[0].reason.find("the scene's own numbers"), std::string::npos) << plan.skipped[0].reason;
}

TEST_F(MakePlan, a_rig_is_a_scene_without_a_file) {
  const Plan rigs = plan(R"([{"rig": {"lights": [1, 20], "spots": 0.5}}])", R"(, "assigners": ["exact"])");
  ASSERT_EQ(rigs.scenes.size(), 2U);
  EXPECT_EQ(rigs.scenes[1].scene.lights.size(), 20U);
  EXPECT_EQ(rigs.scenes[1].scene.lights[0].range_m, 2.0);
  ASSERT_EQ(rigs.scenes[1].paths.size(), 1U);
  EXPECT_EQ(rigs.scenes[1].paths[0].shots.size(), 1U);
  EXPECT_EQ(cases(rigs).front().name.substr(0, 20), "rig-1-r2-s0.5/look/f");
}

TEST_F(MakePlan, a_method_that_tests_all_pairs_is_skipped_beyond_the_limit_with_its_reason) {
  const Plan limited = plan(R"([{"rig": {"lights": [10, 100]}}])",
                            R"(, "grids": [{"tiles": {"count": [10, 10]}, "slices": {"count": 10}}],
                               "assigners": ["brute-force", "bounds"], "limits": {"all_pairs": 10000})");
  EXPECT_EQ(cases(limited).size(), 3U);
  ASSERT_EQ(limited.skipped.size(), 1U);
  EXPECT_EQ(limited.skipped[0].reason,
            "brute-force would test 100 lights against 1000 cells, 100000 pairs; limits.all_pairs allows 10000");
}

TEST_F(MakePlan, a_storage_too_narrow_or_too_large_is_skipped_with_its_reason) {
  const Plan narrow = plan(R"([{"rig": {"lights": [256, 257, 65536, 65537]}}])",
                           R"(, "grids": [{}], "assigners": ["bounds"],
                               "storages": [{"name": "packed", "index_bits": ["auto", "8", "16", "32"]}])");
  ASSERT_EQ(narrow.skipped.size(), 4U);
  EXPECT_EQ(narrow.skipped[0].reason, "index_bits: is 8, but 257 lights need 16 bits");
  EXPECT_EQ(narrow.skipped[3].reason, "index_bits: is 16, but 65537 lights need 32 bits");
  const Plan large = plan(R"([{"rig": {"lights": 70000}}])",
                          R"(, "grids": [{"tiles": {"count": [160, 90]}, "slices": {"count": 64}}],
                              "assigners": ["bounds"], "storages": ["packed", {"name": "fixed", "cap": 2000}])");
  ASSERT_EQ(large.skipped.size(), 1U);
  EXPECT_EQ(large.skipped[0].reason,
            "fixed(cap=2000) would reserve 7034 MiB for 921600 cells and 70000 lights; at most 4096 MiB");
}

TEST_F(MakePlan, the_limit_on_memory_is_the_configurations_and_holds_for_lists) {
  const Plan little = plan(R"([{"rig": {"lights": 70000}}])",
                           R"(, "grids": [{"tiles": {"count": [160, 90]}, "slices": {"count": 64}}],
                               "assigners": ["bounds"], "storages": ["packed", {"name": "fixed", "cap": 2000}],
                               "limits": {"memory_mib": 10000})");
  EXPECT_EQ(little.skipped.size(), 0U);
  EXPECT_EQ(memory_limit(), std::uint64_t{10000} << 20);
  plan(R"([{"rig": {"lights": 10}}])", R"(, "grids": [{}], "assigners": ["bounds"])");
  EXPECT_EQ(memory_limit(), k_default_memory_limit);
}

TEST_F(MakePlan, a_filter_selects_by_name_and_says_when_it_selects_nothing) {
  write_scene("a.gltf");
  for (const CasePlan& case_plan : cases(plan(R"(["a.gltf"])", k_two_grids, "/aabb/")))
    EXPECT_NE(case_plan.name.find("/aabb/"), std::string::npos);
  const auto message = [&](const std::string& filter) -> std::string {
    try {
      plan(R"(["a.gltf"])", k_two_grids, filter);
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_TRUE(message("(").starts_with("--filter: '(' is no regular expression (as RE2 has them): ")) << message("(");
  EXPECT_TRUE(message("nothing").starts_with("--filter: 'nothing' matches none of ")) << message("nothing");
}

TEST_F(MakePlan, more_cases_than_a_result_can_have_are_refused) {
  write_scene("hall.gltf");
  std::string counts = "[2";
  for (int i = 3; i < 2002; ++i) counts += ", " + std::to_string(i);
  const std::string rest = R"(, "grids": [{"kind": "frustum", "tiles": {"count": [1, 1]}, "slices": {"count": )" +
                           counts +
                           R"(]}}], "assigners": [{"name": "exact-fast", "threads": [1, 2, 3, 4, 5, 6, 7, 8]}],
      "storages": ["packed", "fixed", "bitfield", "linked", {"name": "packed", "index_bits": ["8", "16", "32"]}],
      "precision": ["float32", "half"])";
  try {
    static_cast<void>(plan(R"(["hall.gltf"])", rest));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("make more than 100000 cases"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace clusterbench::run
