// `recommend` where limits reject candidates, or figures are not known.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/lamps.h"
#include "cli/recommended.h"
#include "cli/tool.h"

namespace clusterbench::test::recommending {
namespace {

TEST(Recommend, excludes_what_breaks_a_constraint_and_says_how_good_the_best_of_that_was) {
  const Recommended free = recommended(space(), "--no-timing --by evaluated");
  ASSERT_EQ(free.outcome.code, 0) << free.outcome.err;
  const auto bytes = free.answer["choice"]["figures"]["bytes"].get<int>();
  const Recommended bound = recommended(space(), "--no-timing --by evaluated --bytes " + std::to_string(bytes - 1));
  ASSERT_EQ(bound.outcome.code, 0) << bound.outcome.err;
  double least = std::numeric_limits<double>::infinity();
  for (const Json& one : swept(space()))
    if (is_lit(one) && figure(one, "bytes") < bytes) least = std::min(least, figure(one, "evaluated"));
  EXPECT_NEAR(bound.answer["choice"]["objective"].get<double>(), least, 1e-8 * least);
  const Json& row = bound.answer["constraints"][0];
  EXPECT_EQ(row["constraint"], "bytes <= " + std::to_string(bytes - 1));
  EXPECT_EQ(row["given"], true);
  EXPECT_GT(row["excluded"], 0);
  EXPECT_LE(row["best"]["by_best"], 1.0) << "on its frames";
  EXPECT_NE(bound.outcome.out.find(row["best"]["name"].get<std::string>()), std::string::npos) << bound.outcome.out;
}

// A method without padding loses nothing on one street, and can on the next one.
TEST(Recommend, takes_no_method_that_can_lose_lights_elsewhere_unless_losses_are_allowed) {
  Json lucky = Json::parse(space());
  lucky["assigners"] = {"naive-bounds", "bounds-fast"};
  lucky["grids"] = {{{"kind", "frustum"}, {"tiles", {{"pixels", 64}}}, {"slices", {{"count", 8}}}}};
  lucky["storages"] = {"packed"};
  const Recommended sound = recommended(lucky.dump(), "--no-timing --by bytes");
  ASSERT_EQ(sound.outcome.code, 0) << sound.outcome.err;
  EXPECT_EQ(sound.answer["choice"]["assigner"]["name"], "bounds-fast");
  EXPECT_TRUE(sound.answer["runners_up"].empty());
  EXPECT_NE(sound.outcome.out.find("conservative or exact (--unlit allows others)"), std::string::npos);
  const Recommended allowed = recommended(lucky.dump(), "--no-timing --by bytes --unlit 0");
  ASSERT_EQ(allowed.outcome.code, 0) << allowed.outcome.err;
  EXPECT_EQ(allowed.answer["runners_up"].size(), 1U) << "it loses nothing here";
  lucky["assigners"] = {"naive-bounds"};
  const Recommended none = recommended(lucky.dump(), "--no-timing --by bytes");
  EXPECT_EQ(none.outcome.code, 1);
  EXPECT_TRUE(
      none.outcome.out.ends_with("take none: no candidate satisfies all constraints: conservative or exact "
                                 "(--unlit allows others) rejects the only candidate.\n"))
      << none.outcome.out;
}

TEST(Recommend, exits_with_1_where_nothing_satisfies_and_shows_what_excluded_how_many) {
  const Folder folder;
  const std::string choice = (folder / "choice.json").string();
  const Recommended found = recommended(space(), "--no-timing --by bytes --bytes 1 --write-config " + choice);
  EXPECT_EQ(found.outcome.code, 1);
  EXPECT_TRUE(found.answer["choice"].is_null());
  EXPECT_EQ(found.answer["constraints"][0]["excluded"], 52);
  EXPECT_EQ(found.answer["work"]["evaluations"], 52) << "all are out after one frame";
  EXPECT_EQ(found.answer["work"]["measurements"], 52 + 8) << "8 frames were counted to find the fullest";
  EXPECT_NE(found.outcome.out.find("no candidate satisfies all constraints"), std::string::npos);
  EXPECT_TRUE(found.outcome.out.ends_with(
      "take none: no candidate satisfies all constraints: bytes <= 1 rejects all 52 candidates.\n"))
      << found.outcome.out;
  EXPECT_FALSE(std::filesystem::exists(choice));
}

// So many lights of 3 m beside or in front of a camera that looks along -z.
std::string small_level(int lights, double x, double z) {
  Json gltf{{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"name", "eye"}, {"camera", 0}}}},
            {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}, {"zfar", 100}}}}}}};
  if (lights == 0) return gltf.dump();
  gltf["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", 3.0}, {"intensity", 10.0}}};
  for (int i = 1; i <= lights; ++i) {
    gltf["scenes"][0]["nodes"].push_back(i);
    gltf["nodes"].push_back({{"translation", {x, 0.0, z}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  return gltf.dump();
}

TEST(Recommend, recommends_nothing_where_nothing_is_seen) {
  struct Row {
    std::string level, flags, why;
  };
  const Row rows[] = {
      {small_level(0, 0, 0), "", "the scene has no point or spot lights"},
      {small_level(5, 0, 50), "", "no light is in view in any frame"},
      {small_level(5, 0, 50), "--by bytes", "no light is in view in any frame"},
      {small_level(5, 0, -5), "--set samples.opaque.ground=1e6", "no pixel sees the floor at y = 1e+06 m"},
      {small_level(5, 0, -5), "--set samples.opaque.ground=0", "no pixel sees the floor at y = 0 m"},
      {small_level(5, 0, -5), "--set samples.opaque.ground=-9", "no light reaches any of"},
  };
  for (const Row& row : rows) {
    const Folder folder;
    const std::string level = folder.write("level.gltf", row.level).string(), out = (folder / "answer.json").string();
    const Outcome done = tool("recommend " + level + " -q --no-timing --grid frustum --tiles 64 --slices 4,8 " +
                              "--assigner aabb-fast,exact-fast " + row.flags + " -o " + out);
    EXPECT_EQ(done.code, 1) << row.why << done.err << done.out;
    EXPECT_NE(done.out.find("conclusion: level, 1920x1080: nothing to recommend: " + row.why), std::string::npos)
        << done.out << done.err;
    EXPECT_EQ(done.out.find("take"), std::string::npos) << done.out;
    EXPECT_EQ(tool("validate " + out).code, 0) << tool("validate " + out).err;
    const Json answer = Json::parse(file_text(out))["answers"][0];
    EXPECT_TRUE(answer["choice"].is_null());
    EXPECT_TRUE(answer["nothing_seen"].is_string());
  }
  const Folder folder;
  const std::string level = folder.write("level.gltf", small_level(5, 0, -5)).string();
  const std::string flags = " -q --no-timing --grid frustum --tiles 64 --slices 4,8 --assigner aabb-fast,exact-fast ";
  for (const std::string more : {"", "--set samples.opaque.ground=-1"})
    EXPECT_EQ(tool("recommend " + level + flags + more).code, 0) << tool("recommend " + level + flags + more).err;
}

TEST(Recommend, tells_what_comes_nearest_where_nothing_satisfies) {
  std::string one_frame = space();
  one_frame.replace(one_frame.find("\"frames\": 8"), 11, "\"frames\": 1");
  const Json cases = swept(one_frame);
  const Json nearest_case = *std::ranges::min_element(
      cases, [](const Json& a, const Json& b) { return figure(a, "bytes") < figure(b, "bytes"); });
  const Recommended found = recommended(one_frame, "--no-timing --by bytes --bytes 1");
  const Json& nearest = found.answer["constraints"][0]["nearest"];
  EXPECT_EQ(nearest["figure"], figure(nearest_case, "bytes"));
  EXPECT_EQ("street/walk/" + nearest["name"].get<std::string>(), nearest_case["name"].get<std::string>());
  const std::string told = "nearest to bytes <= 1 of those that it rejects: " + nearest["figure"].dump() +
                           " on 1 frame, " + nearest["name"].get<std::string>();
  EXPECT_NE(found.outcome.out.find(told), std::string::npos) << found.outcome.out;
}

TEST(Recommend, tells_what_the_best_of_the_rejected_would_have_on_the_same_frames) {
  const Json unlimited = recommended(space(), "--no-timing --by bytes").answer;
  const Recommended found = recommended(space(), "--no-timing --by bytes --longest 80");
  ASSERT_EQ(found.outcome.code, 0) << found.outcome.err;
  const auto row = std::ranges::find(found.answer["constraints"], Json("longest <= 80"),
                                     [](const Json& constraint) { return constraint["constraint"]; });
  ASSERT_NE(row, found.answer["constraints"].end()) << found.answer["constraints"];
  const Json& best = (*row)["best"];
  EXPECT_EQ(best["name"], unlimited["choice"]["name"]);
  // Beside the best that remains, both on so many frames: of all 32 on every one.
  std::map<std::string, double> bytes;
  std::map<std::string, double> longest;
  for (const Json& one : swept(space())) {
    const auto name = one["name"].get<std::string>();
    bytes[name.substr(name.find("walk/") + 5)] = figure(one, "bytes");
    longest[name.substr(name.find("walk/") + 5)] = figure(one, "longest");
  }
  if (best["frames"] == 8) {
    EXPECT_EQ(best["objective"], bytes.at(best["name"]));
    EXPECT_NEAR(best["by_best"].get<double>(),
                bytes.at(best["name"]) / found.answer["choice"]["objective"].get<double>(), 1e-6);
  }
  EXPECT_LT(best["by_best"], 1.0);
  EXPECT_GT(longest.at(best["name"]), 80.0);
}

// Of a camera that looks into the sky there are no samples, and nothing is known against any candidate.
TEST(Recommend, by_figures_of_samples_goes_by_the_cameras_that_see_surfaces) {
  const Folder folder;
  nlohmann::json level = nlohmann::json::parse(level_of(row_of(6)));
  level["scenes"][0]["nodes"].push_back(level["nodes"].size());
  level["nodes"].push_back({{"name", "sky"}, {"camera", 0}, {"rotation", {0.70710678, 0.0, 0.0, 0.70710678}}});
  const std::string flags =
      " --viewport 320x180 --grid frustum --tiles 16x9t --slices 4,8 --assigner exact-fast "
      "--no-timing -q --set samples.opaque.ground=lowest --set 'scenes.*.camera=*' --by ";
  const std::string recommend = "recommend " + folder.write("level.gltf", level.dump()).string() + flags;
  for (const char* question : {"evaluated", "read_bytes", "evaluated --evaluated 1000", "bytes --read-bytes 1e6",
                               "bytes --unlit 0", "bytes --lost-irradiance 0"}) {
    const Outcome done = tool(recommend + question);
    EXPECT_EQ(done.code, 0) << question << ": " << done.out << done.err;
  }
  const Outcome too_few = tool(recommend + "bytes --evaluated 0.001");
  EXPECT_EQ(too_few.code, 1) << too_few.out;
}

// No camera sees the floor: a mean over its samples is unknown, and nothing can be lost there.
TEST(Recommend, a_limit_on_a_figure_of_samples_that_no_camera_has_is_not_satisfied_and_one_on_a_loss_is) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", small_level(5, 0, -5)).string(),
                    out = (folder / "answer.json").string(),
                    recommend = "recommend " + level +
                                " -q --no-timing --viewport 320x180 --grid frustum --tiles 64 --slices 4,8 --assigner "
                                "aabb-fast,exact-fast --set samples.opaque.ground=1e6 --by bytes -o " +
                                out + " ";
  const std::pair<std::string, std::string> unknown[] = {{"--evaluated 1000", "evaluated"},
                                                         {"--read-bytes 1e6", "read_bytes"},
                                                         {"--overshade 1000", "overshade"},
                                                         {"--fail-if 'opaque.evaluated > 1000'", "opaque.evaluated"}};
  for (const auto& [limit, figure] : unknown) {
    const Outcome done = tool(recommend + limit);
    EXPECT_EQ(done.code, 1) << limit << done.out << done.err;
    EXPECT_TRUE(done.out.ends_with("conclusion: level, 320x180: nothing to recommend: " + figure +
                                   " is not known, since no pixel sees the floor at y = 1e+06 m "
                                   "(samples.opaque.ground).\n"))
        << done.out;
    EXPECT_EQ(tool("validate " + out).code, 0) << tool("validate " + out).err;
    const Json answer = Json::parse(file_text(out))["answers"][0];
    EXPECT_TRUE(answer["choice"].is_null());
    EXPECT_EQ(answer["constraints"][0]["excluded"], answer["candidates"]) << limit;
  }
  for (const std::string limit : {"", "--unlit 0", "--lost-irradiance 0", "--fail-if 'opaque.unlit > 0'"}) {
    const Outcome done = tool(recommend + limit);
    EXPECT_EQ(done.code, 0) << limit << done.out << done.err;
  }
  const Outcome without_set = tool(recommend + "--fail-if 'fog.unlit > 0'");
  EXPECT_EQ(without_set.code, 1);
  EXPECT_TRUE(
      without_set.out.ends_with("nothing to recommend: fog.unlit is not known, since there are no samples of "
                                "fog froxels (key samples.fog).\n"))
      << without_set.out;
}

TEST(Recommend, says_that_there_are_no_samples_for_a_limit_on_their_figures) {
  const Folder folder;
  const std::string level = folder.write("level.gltf", small_level(5, 0, -5)).string();
  for (const std::string figure : {"evaluated", "unlit"}) {
    const Outcome done = tool("recommend " + level +
                              " -q --no-timing --viewport 320x180 --grid frustum --tiles 64 --slices 4 --assigner "
                              "exact-fast --set shading.samples=0 --by bytes --" +
                              figure + " 10");
    EXPECT_EQ(done.code, 1) << done.out << done.err;
    EXPECT_TRUE(done.out.ends_with("nothing to recommend: " + figure +
                                   " is not known, since there are no samples (keys samples and shading.samples; "
                                   "surfaces need triangles, or a floor: samples.opaque.ground=lowest).\n"))
        << done.out;
  }
}

TEST(Recommend, says_how_many_candidates_could_satisfy_all_limits_on_further_frames) {
  const Recommended found = recommended(space(), "--no-timing --by read_bytes --evaluated 0.001 --bytes 1e9");
  EXPECT_EQ(found.outcome.code, 1);
  const Json& mean = found.answer["constraints"][1];
  ASSERT_EQ(mean["constraint"], "evaluated <= 0.001") << found.answer["constraints"];
  EXPECT_EQ(mean["excluded"], 52);
  const auto provisional = found.answer["provisional"].get<int>();
  EXPECT_GT(provisional, 1);
  EXPECT_EQ(provisional, 52 - found.answer["finalists"].get<int>());
  EXPECT_TRUE(found.outcome.out.ends_with(
      "evaluated <= 0.001 rejects all 52 candidates. " + std::to_string(provisional) +
      " candidates were measured on some frames only and could satisfy all constraints on all frames; none of them was "
      "among the best that were kept.\n"))
      << found.outcome.out;
}

// A mark only grows: what breaks its limit on some frames breaks it on all.
TEST(Recommend, counts_no_candidate_as_possible_that_breaks_a_limit_for_good) {
  const Recommended found = recommended(space(), "--no-timing --by read_bytes --evaluated 0.001 --bytes 1");
  EXPECT_EQ(found.outcome.code, 1);
  EXPECT_EQ(found.answer["provisional"], 0);
  EXPECT_TRUE(found.outcome.out.ends_with(
      "bytes <= 1 rejects all 52 candidates, evaluated <= 0.001 rejects all 52 candidates.\n"))
      << found.outcome.out;
  EXPECT_EQ(recommended(space(), "--no-timing --by read_bytes").answer["provisional"], 0) << "there is a choice";
}

TEST(Recommend, refuses_budgets_of_figures_that_it_does_not_choose_by) {
  const Folder folder;
  const Outcome done = tool("recommend " + folder.write("space.json", space()).string() +
                            " --no-timing --by bytes --fail-if 'tests_done > 5'");
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("'tests_done > 5': recommend does not choose by tests_done"), std::string::npos) << done.err;
}

}  // namespace
}  // namespace clusterbench::test::recommending
