// Random sweeps on random numbers of shards and threads: merged, they are the undivided run's result.

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"

namespace clusterbench::test {
namespace {

using Json = nlohmann::json;

// A name that exporters allow, and that JSON, tables and terminals must not take for something else.
std::string odd_name(SplitMix64& random) {
  const char* names[] = {"a\"b",   "back\\slash", "tab\tnl\n", "\x01\x1f", "\x7f",     "名\"\\\n",
                         "x\":\"", "{\"a\":1}",   "]}",        "null",     "*",        "(a|b)+$",
                         "a/b, c", "%s %n",       "",          "  ",       "/frustum", "-q"};
  return random.below(20) == 0 ? std::string(300, 'x') : names[random.below(std::size(names))];
}

// methods.gltf with other names of its scene and its camera.
Json oddly_named_scene(SplitMix64& random, const Folder& folder) {
  Json file = Json::parse(file_text(source_file("scenes/methods.gltf")));
  const std::string scene_name = odd_name(random);
  file["scenes"][0]["name"] = scene_name;
  file["cameras"][0]["name"] = odd_name(random);
  for (Json& node : file["nodes"])
    if (node.contains("camera")) node["name"] = odd_name(random);
  const std::string name = "odd " + std::to_string(random.below(1000)) + "\"ü.gltf";
  Json out{{"path", folder.write(name, file.dump()).string()}, {"frames", 1 + random.below(3)}, {"camera", "*"}};
  if (random.below(2) == 0) out["scene"] = scene_name.empty() ? Json(0) : Json(scene_name);
  return out;
}

Json random_scene(SplitMix64& random, const Folder& folder) {
  if (random.below(3) == 0) return oddly_named_scene(random, folder);
  const char* files[] = {"mirror.glb", "slope.glb", "methods.gltf", "methods-boxes.gltf", "steps.glb"};
  const int frames = 1 + static_cast<int>(random.below(4));
  if (random.below(2) == 0)
    return {{"path", source_file(std::string("scenes/") + files[random.below(5)])}, {"frames", frames}};
  const Json lights = random.below(3) == 0 ? Json{5, 60} : Json(random.below(200));
  return {{"rig",
           {{"lights", lights},
            {"range", random.between(0.5, 9.0)},
            {"spots", 0.25 * static_cast<double>(random.below(5))},
            {"size", {40, 8, 40}},
            {"seed", random.below(100)}}},
          {"frames", frames}};
}

constexpr std::uint64_t k_grids = 5;

Json random_grid(std::uint64_t number, SplitMix64& random) {
  const auto up_to = [&](std::uint64_t least, std::uint64_t most) { return least + random.below(most - least + 1); };
  switch (number) {
    case 0:
      return {{"kind", "distance"}, {"slices", {{"count", up_to(2, 12)}}}};
    case 1:
      return {{"kind", "cascades"}};
    case 2:
      return {{"kind", "world"}, {"cells", {up_to(1, 16), up_to(1, 6), up_to(1, 16)}}};
    case 3:
      return {{"tiles", {{"pixels", {{64, 64}, {up_to(32, 63), 48}}}}},
              {"slices", {{"count", {up_to(2, 9), up_to(10, 18)}}}}};
    default:
      return {{"tiles", {{"count", {up_to(1, 20), up_to(1, 12)}}}},
              {"slices", {{"scheme", "linear"}, {"count", up_to(2, 16)}}}};
  }
}

// One to `most` of these, each once.
Json some_of(SplitMix64& random, std::vector<std::string> words, std::uint64_t most) {
  Json out = Json::array();
  for (std::uint64_t left = 1 + random.below(most); left > 0; --left) {
    const std::size_t at = random.below(words.size());
    out.push_back(words[at]);
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(at));
  }
  return out;
}

Json random_sweep(SplitMix64& random, const Folder& folder) {
  Json out{{"name", "sweep"}, {"seed", random.below(1000)}, {"viewport", {320, 180}}, {"timing", {{"measure", false}}}};
  for (std::uint64_t left = 1 + random.below(3); left > 0; --left)
    out["scenes"].push_back(random_scene(random, folder));
  const std::uint64_t last = random.below(k_grids);
  for (std::uint64_t number = 0; number <= last; ++number)
    if (number == last || random.below(2) == 0) out["grids"].push_back(random_grid(number, random));
  out["assigners"] = some_of(random,
                             {"aabb", "aabb-fast", "sphere-refinement-fast", "exact", "exact-fast", "distance-fast",
                              "cascades", "world-grid-fast", "z-binning", "tile-ranges"},
                             6);
  out["assigners"].push_back("bvh");  // takes all grids
  out["storages"] = some_of(random, {"packed", "bitfield", "linked", "runs"}, 2);
  if (random.below(3) == 0) out["presets"] = some_of(random, {"godot", "filament", "bevy"}, 2);
  if (random.below(3) == 0) out["precision"] = {"float32", "half"};
  if (random.below(3) == 0) out["samples"] = {{"opaque", {{"divisor", 16}}}};
  if (random.below(4) == 0) out["stability"] = {{"steps", 4}, {"step_mm", 20}};
  if (random.below(4) == 0) out["pre_cull"] = {"none", {"frustum"}};
  if (random.below(3) == 0) out["limits"] = {{"fail_if", {"longest > " + std::to_string(random.below(60))}}};
  return out;
}

class RandomSweep : public ::testing::TestWithParam<int> {};

// Whatever the undivided run says: some sweeps exceed their budget.
TEST_P(RandomSweep, in_shards_is_the_undivided_run) {
  SplitMix64 random(7100 + static_cast<std::uint64_t>(GetParam()));
  const Folder folder;
  const Json sweep = random_sweep(random, folder);
  const auto path = [&](const std::string& name) { return (folder / name).string(); };
  const auto run_on = [&](std::uint64_t threads, const std::string& more) {
    return tool("run " + path("sweep.json") + " -q --threads " + std::to_string(threads) + " " + more);
  };
  const std::string filter = random.below(4) == 0 ? " --filter 'bvh|packed'" : "";
  folder.write("sweep.json", sweep.dump());

  const std::uint64_t threads = 1 + random.below(4), count = 1 + random.below(test::k_sanitized ? 3 : 9);
  const Outcome whole = run_on(threads, "-o " + path("whole.json") + filter);
  ASSERT_TRUE(whole.code == 0 || whole.code == 1) << whole.err << sweep;
  const Outcome other = run_on(threads + 1, "-o " + path("other.json") + filter);
  EXPECT_EQ(other.code, whole.code) << sweep;
  Json of_other = Json::parse(file_text(folder / "other.json")),
       of_whole = Json::parse(file_text(folder / "whole.json"));
  of_other["config"].erase("threads");
  of_whole["config"].erase("threads");
  EXPECT_EQ(of_other, of_whole) << sweep;

  std::vector<std::string> files;
  for (std::uint64_t i = 1; i <= count; ++i) {
    files.push_back(path(std::to_string(i) + ".json"));
    const Outcome shard =
        run_on(threads, "-o " + files.back() + filter + " --shard " + std::to_string(i) + "/" + std::to_string(count));
    ASSERT_TRUE(shard.code == 0 || shard.code == whole.code) << shard.err << sweep;
  }
  for (std::size_t i = files.size() - 1; i > 0; --i) std::swap(files[i], files[random.below(i + 1)]);
  std::string command = "merge -o " + path("merged.json");
  for (const std::string& file : files) command += " " + file;
  const Outcome merged = tool(command);
  EXPECT_EQ(merged.code, whole.code) << merged.err << sweep;
  EXPECT_EQ(file_text(folder / "merged.json"), file_text(folder / "whole.json")) << count << " shards of " << sweep;
}

// One method on one grid is counted frame by frame on all threads, others grid by grid.
TEST_P(RandomSweep, is_sized_alike_on_any_number_of_threads) {
  SplitMix64 random(8200 + static_cast<std::uint64_t>(GetParam()));
  const Folder folder;
  Json sweep = random_sweep(random, folder);
  if (random.below(2) == 0) {
    sweep["scenes"] = {{{"path", source_file("scenes/street.glb")}, {"frames", 12}}};
    sweep["grids"] = {{{"tiles", {{"pixels", {64, 64}}}}, {"slices", {{"count", 2 + random.below(16)}}}}};
    sweep["assigners"] = some_of(random, {"aabb-fast", "bounds-fast", "sphere-refinement-fast", "exact-fast"}, 1);
  }
  const std::string config = folder.write("sweep.json", sweep.dump()).string();
  const auto sized_on = [&](const char* threads) {
    const Outcome done = tool("size -q --format json --threads " + std::string(threads) + " " + config);
    return std::to_string(done.code) + done.out + done.err;
  };
  const std::string one = sized_on("1");
  EXPECT_FALSE(one.starts_with("2")) << one << sweep;
  for (const char* threads : {"2", "5"}) EXPECT_EQ(sized_on(threads), one) << threads << " threads: " << sweep;
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSweep, ::testing::Range(0, test::tries(24)));

}  // namespace
}  // namespace clusterbench::test
