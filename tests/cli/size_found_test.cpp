// `clusterbench size --found`: what searches have found, of this case and of others.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/lights_in_view.h"
#include "cli/tool.h"

namespace clusterbench {
namespace {

using Json = nlohmann::json;
using test::file_text;
using test::Folder;
using test::lights_in_view_and_behind;
using test::Outcome;
using test::tool;

const std::string k_searched_case =
    " -q --grid frustum --tiles 16x9t --slices 8 --assigner exact-fast --set storages=packed "
    "--set 'scenes.*.frames=3' ";

class SizeFound : public ::testing::Test {
 protected:
  std::string search(const std::string& name, const std::string& flags, const std::string& viewport = "640x360") const {
    const std::string file = (folder_ / name).string();
    const test::Outcome done = test::tool("worst-case --random 0 --evaluations 30" + k_searched_case + flags +
                                          " --viewport " + viewport + " -o " + file + " " + scene_);
    EXPECT_EQ(done.code, 0) << done.err;
    return file;
  }
  test::Outcome size(const std::string& files, const std::string& flags = "") const {
    return test::tool("size --viewport 640x360" + k_searched_case + flags + " " + files + " " + scene_);
  }
  void expect_refused(const std::string& name, const std::string& flags, const std::string& where,
                      const std::string& viewport = "640x360") const {
    const test::Outcome done = size("--found " + search(name, flags, viewport));
    EXPECT_EQ(done.code, 2) << flags;
    EXPECT_EQ(done.out, "");
    EXPECT_NE(done.err.find(name + ": " + where), std::string::npos) << done.err;
  }

  const Folder folder_;
  const std::string scene_ = test::source_file("scenes/street.glb");
};

TEST_F(SizeFound, of_two_files_and_a_search_the_largest_decides_in_any_order) {
  const std::string few = search("few.json", "--seed 5"), many = search("many.json", "--seed 2 --add-lights 64x20");
  const auto found = [&](const std::string& files) {
    const test::Outcome done = size(files, "--format json --margin 1 --round none");
    EXPECT_EQ(done.code, 0) << done.err;
    return nlohmann::json::parse(done.out)["structures"][0]["buffers"][0];
  };
  const auto most = found("--found " + many);
  EXPECT_GT(most["found"], found("--found " + few)["found"]);
  for (const std::string& files : {"--found " + few + " --found " + many, "--found " + many + " --found " + few,
                                   "--worst-case --evaluations 30 --found " + many}) {
    EXPECT_EQ(found(files)["found"], most["found"]) << files;
    EXPECT_EQ(found(files)["capacity"], most["capacity"]) << files;
    EXPECT_EQ(found(files)["found_by"], most["found_by"]) << files;
  }
}

TEST_F(SizeFound, a_search_of_other_settings_is_refused_with_what_differs) {
  expect_refused("viewport.json", "", "/case/viewport: is [320,180], and here it is [640,360]", "320x180");
  expect_refused("fov.json", "--fov 120h", R"(/case/settings/fov: is "120h", and here it is null)");
  expect_refused("rule.json", "--set 'scenes.*.range_rule.cutoff_lux=5'", "/case/settings/range_rule: is ");
  expect_refused("far.json", "--set 'scenes.*.far=50'", "/case/settings/far: is 50.0, and here it is null");
  expect_refused("fit.json", "--set 'scenes.*.camera_fit=vertical'", "/case/settings/camera_fit: is \"vertical\"");
  const std::string same = search("same.json", "--fov 90.0h");
  EXPECT_EQ(size("--found " + same, "--fov 90h").code, 0);
  EXPECT_EQ(size("--found " + same).code, 2);
}

// Cells as deep as they are wide: the last slice ends behind the end that was asked for.
TEST_F(SizeFound, finds_in_slices_of_a_shape_are_taken_where_the_end_is_the_same) {
  const std::string file = (folder_ / "shape.json").string();
  for (const std::string scheme : {"cubical", "cubical-first"}) {
    const std::string flags = " -q --viewport 640x360 --grid frustum --tiles 64 --scheme " + scheme +
                              " --assigner exact-fast --set storages=packed --set 'scenes.*.frames=3' " + scene_;
    const test::Outcome found =
        test::tool("worst-case --random 0 --evaluations 20 -o " + file + " --set 'grids.*.slices.far=40'" + flags);
    ASSERT_EQ(found.code, 0) << found.err;
    for (const auto& [far_m, code] : {std::pair("40", 0), std::pair("30", 2), std::pair("60", 2)}) {
      const test::Outcome done =
          test::tool("size --found " + file + " --set 'grids.*.slices.far=" + far_m + "'" + flags);
      EXPECT_EQ(done.code, code) << scheme << " to " << far_m << ": " << done.err;
    }
  }
}

TEST_F(SizeFound, finds_for_each_of_two_viewports_are_taken_in_any_order_and_for_no_other) {
  const std::string small = search("small.json", "", "320x180"), large = search("large.json", "", "640x360");
  const auto sized = [&](const std::string& files) {
    const test::Outcome done =
        test::tool("size --viewport 640x360,320x180 --all --format json" + k_searched_case + files + " " + scene_);
    EXPECT_EQ(done.code, 0) << done.err;
    return nlohmann::json::parse(done.out)["structures"];
  };
  const auto one_way = sized("--found " + small + " --found " + large),
             other_way = sized("--found " + large + " --found " + small);
  ASSERT_EQ(one_way.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(one_way[i]["buffers"][0]["found"].is_number()) << one_way[i];
    EXPECT_EQ(one_way[i]["buffers"][0]["found"], other_way[i]["buffers"][0]["found"]);
  }
  const test::Outcome other = test::tool("size --viewport 640x360,320x180" + k_searched_case + "--found " +
                                         search("other.json", "", "800x450") + " " + scene_);
  EXPECT_EQ(other.code, 2);
  EXPECT_EQ(other.out, "");
  EXPECT_NE(other.err.find("other.json: /case/viewport: is [800,450], and here it is [640,360] or [320,180]"),
            std::string::npos)
      << other.err;
}

// A camera without a far plane that walks away from the only light: where slices end is made up from the frames.
constexpr const char* k_endless = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}, {"camera": 0, "name": "walk"}],
  "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "range": 6}]}},
  "buffers": [{"byteLength": 32, "uri": "data:application/octet-stream;base64,AAAAAAAAgD8AAAAAAAAAAAAAIEEAAAAAAAAAAAAAIEI="}],
  "bufferViews": [{"buffer": 0, "byteLength": 8}, {"buffer": 0, "byteOffset": 8, "byteLength": 24}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"}],
  "animations": [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
                  "samplers": [{"input": 0, "output": 1}]}]})";

TEST_F(SizeFound, a_search_in_a_grid_that_ends_elsewhere_is_refused) {
  const std::string level = folder_.write("endless.gltf", k_endless).string(), file = (folder_ / "end.json").string();
  const auto searched = [&](const std::string& frames) {
    EXPECT_EQ(test::tool("worst-case --random 0 --evaluations 30" + k_searched_case +
                         "--set 'scenes.*.frames=" + frames + "' -o " + file + " " + level)
                  .code,
              0);
    return test::tool("size" + k_searched_case + "--found " + file + " " + level);
  };
  EXPECT_EQ(searched("3").code, 0);
  const test::Outcome other = searched("1");
  EXPECT_EQ(other.code, 2);
  EXPECT_NE(other.err.find("/case/settings/grid_end: is "), std::string::npos) << other.err;
  EXPECT_NE(other.err.find("grids.*.slices.far=METRES"), std::string::npos) << other.err;
}

TEST_F(SizeFound, what_an_earlier_version_did_not_write_is_told) {
  const std::string file = search("new.json", "");
  EXPECT_EQ(size("--found " + file).err.find("earlier version"), std::string::npos);
  auto old = nlohmann::json::parse(test::file_text(file));
  old["case"].erase("settings");
  const test::Outcome done = size("--found " + folder_.write("old.json", old.dump()).string());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("old.json: an earlier version wrote it, without the field of view"), std::string::npos)
      << done.err;
}

TEST_F(SizeFound, refuses_what_an_earlier_build_found_without_the_width_of_its_elements) {
  const Folder folder;
  const std::string scene = folder.write("s.gltf", lights_in_view_and_behind(20, 0)).string(),
                    found = (folder / "found.json").string(),
                    flags = " -q --viewport 640x360 --grid frustum --tiles 16x9t --slices 8 --assigner exact-fast ";
  ASSERT_EQ(tool("worst-case" + flags + "--evaluations 20 -o " + found + " " + scene).code, 0);
  ASSERT_EQ(tool("size" + flags + "--found " + found + " " + scene).code, 0);
  Json old = Json::parse(file_text(found));
  for (Json& buffer : old["buffers"]) buffer.erase("element_bytes");
  const Outcome done = tool("size" + flags + "--found " + folder.write("old.json", old.dump()).string() + " " + scene);
  EXPECT_EQ(done.code, 2);
  EXPECT_EQ(done.out, "");
  EXPECT_NE(done.err.find("old.json: /buffers/0/element_bytes: is missing"), std::string::npos) << done.err;
  EXPECT_NE(done.err.find("search again"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace clusterbench
