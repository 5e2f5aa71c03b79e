// Commands on a device that is too small for a method, gone, another one, or not asked for. Wants the driver lavapipe.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>

#include "cli/tool.h"

namespace clusterbench::test {
namespace {

const char* const k_lavapipe = "/usr/share/vulkan/icd.d";
const char* const k_swiftshader = "/usr/lib/chromium/vk_swiftshader_icd.json";

// The driver's file; "" if it is not there.
std::string lavapipe() {
  std::error_code none;
  for (const auto& file : std::filesystem::directory_iterator(k_lavapipe, none))
    if (file.path().filename().string().starts_with("lvp_icd")) return file.path().string();
  return "";
}

void use_driver(const std::string& file) {
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) setenv(name, file.c_str(), 1);
}

// gpu-cells-fixed has lists of more bytes than lavapipe lets a shader see.
constexpr const char* k_too_large = R"({
  "scenes": [{"rig": {"lights": 20, "range": 20}}], "viewport": [160, 90],
  "grids": [{"tiles": {"count": [64, 36]}, "slices": {"count": 16, "near": 0.1, "far": 60}}],
  "assigners": ["aabb-fast", {"name": "gpu-cells-fixed", "cap": 1000}, "gpu-cells"],
  "timing": {"measure": false}})";
constexpr const char* k_reason = "lists of fixed length need a buffer of 147456000 bytes; llvmpipe";

class OnDevice : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : k_changed)
      if (const char* value = std::getenv(name)) before_[name] = value;
    use_driver(lavapipe());
    // It leaks at its end. Of a sanitized program only leaks of its own are counted.
    const std::string leaks = folder_.write("leaks", "leak:libvulkan_lvp.so\n").string();
    setenv("LSAN_OPTIONS", ("print_suppressions=0:suppressions=" + leaks).c_str(), 1);
    const Outcome devices = tool("list devices");
    if (lavapipe().empty() || devices.code != 0) GTEST_SKIP() << "skipped: " << devices.err;
  }
  void TearDown() override {
    for (const char* name : k_changed) unsetenv(name);
    for (const auto& [name, value] : before_) setenv(name.c_str(), value.c_str(), 1);
  }

  std::string out() const { return (folder_ / "r.json").string(); }

  static constexpr const char* k_changed[] = {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "LSAN_OPTIONS"};
  std::map<std::string, std::string> before_;
  Folder folder_;
  std::string config_ = folder_.write("c.json", k_too_large).string();
};

TEST_F(OnDevice, that_is_too_small_for_a_method_run_measures_the_others_and_tells_the_reason) {
  const Outcome done = tool("run " + config_ + " -o " + out());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.err.find("gpu-cells-fixed(cap=1000)/own lists was not measured to the end: " + std::string(k_reason)),
            std::string::npos)
      << done.err;
  const auto result = nlohmann::json::parse(file_text(out()));
  EXPECT_EQ(result["cases"].size(), 2u);
  ASSERT_EQ(result["skipped"].size(), 1u);
  EXPECT_TRUE(result["skipped"][0]["reason"].get<std::string>().starts_with(k_reason));
}

TEST_F(OnDevice, that_is_too_small_for_all_methods_run_ends_with_2_and_a_result) {
  const Outcome done = tool("run --filter fixed " + config_ + " -o " + out());
  EXPECT_EQ(done.code, 2) << done.err;
  EXPECT_NE(done.err.find("clusterbench: no case was measured to the end\n"), std::string::npos) << done.err;
  EXPECT_EQ(nlohmann::json::parse(file_text(out()))["skipped"].size(), 1u);
}

TEST_F(OnDevice, that_is_too_small_for_a_method_dry_runs_and_sizes_take_the_others) {
  const Outcome planned = tool("run --dry-run " + config_);
  EXPECT_EQ(planned.code, 0) << planned.err;
  EXPECT_NE(planned.err.find("3 cases, 0 skipped; takes "), std::string::npos) << planned.err;
  const Outcome sized = tool("size --all " + config_);
  EXPECT_EQ(sized.code, 0) << sized.err;
  EXPECT_NE(sized.out.find("/gpu-cells/packed"), std::string::npos) << sized.out;
  EXPECT_NE(sized.err.find(k_reason), std::string::npos) << sized.err;
  const Outcome searched = tool("size --all --worst-case --evaluations 20 " + config_);
  EXPECT_EQ(searched.code, 0) << searched.err;
  EXPECT_NE(searched.out.find("in 20 frames tried"), std::string::npos) << searched.out;
}

TEST_F(OnDevice, that_is_too_small_worst_case_ends_with_the_reason) {
  const Outcome done = tool("worst-case --filter fixed " + config_);
  EXPECT_EQ(done.code, 2);
  EXPECT_TRUE(done.err.starts_with("clusterbench: device: " + std::string(k_reason))) << done.err;
}

TEST_F(OnDevice, recommend_takes_no_method_in_one_sentence) {
  const Outcome done = tool("recommend " + config_);
  EXPECT_EQ(done.code, 2);
  EXPECT_NE(done.err.find("assigners: gpu-cells-fixed runs on a device, whose times do not compare"), std::string::npos)
      << done.err;
}

// A run that was killed behind its case goes on, on its own device alone.
TEST_F(OnDevice, that_is_another_one_resume_refuses_unless_no_method_runs_on_it) {
  std::error_code none;
  if (!std::filesystem::exists(k_swiftshader, none)) GTEST_SKIP() << "skipped: SwiftShader is not here";
  const std::string quick = (folder_ / "quick.json").string();
  for (const std::string filter : {"gpu-cells/", "aabb-fast"}) {
    use_driver(lavapipe());
    const std::string input = config_ + " --filter " + filter;
    ASSERT_EQ(tool("run -q " + input + " -o " + quick).code, 0);
    const auto result = nlohmann::ordered_json::parse(file_text(quick));
    const std::string run = " -q --set timing.measure=true --set timing.rounds=100000 " + input + " -o " + out();
    const std::string wait = "while [ ! -s " + out() + ".partial ] && kill -0 $pid; do sleep 0.01; done";
    const int killed =
        std::system((test::program() + " run" + run + " & pid=$!; " + wait + "; kill -KILL $pid; wait $pid").c_str());
    ASSERT_EQ(WEXITSTATUS(killed), 128 + 9);
    std::ofstream(out() + ".partial", std::ios::app) << journal_line(result["cases"][0]) << "\n";
    for (const char* words : {"", " --device llvmpipe", " --device 0"}) {
      const Outcome same = tool("run --resume --dry-run" + run + words);
      EXPECT_EQ(same.code, 0) << same.err;
      EXPECT_NE(same.err.find("0 cases left of 1, 1 done"), std::string::npos) << same.err;
    }
    use_driver(k_swiftshader);
    const Outcome other = tool("run --resume" + run);
    if (filter == "aabb-fast") {
      EXPECT_EQ(other.code, 0) << other.err;
      continue;
    }
    EXPECT_EQ(other.code, 2) << other.err;
    EXPECT_NE(other.err.find("line 1: is an interrupted run on llvmpipe (LLVM"), std::string::npos) << other.err;
    EXPECT_NE(other.err.find("), and this one is on SwiftShader Device (Subzero); --device NAME takes the same one"),
              std::string::npos)
        << other.err;
    std::filesystem::remove(out() + ".partial");
  }
}

TEST_F(OnDevice, stress_takes_methods_of_a_named_one_alone_and_says_so) {
  const std::string little = "stress --random 3 -o " + out() + " --methods ";
  const Outcome without = tool("stress --random 3 --seed 5 -o " + out());
  EXPECT_EQ(without.code, 0) << without.err;
  EXPECT_NE(without.err.find(
                "clusterbench: left out gpu-cells, gpu-cells-fixed, gpu-group, gpu-refined, gpu-mask, gpu-lights, "
                "gpu-tiled: run on a device, and none is named (--device NAME)\n"),
            std::string::npos)
      << without.err;
  EXPECT_EQ(file_text(out()).find("gpu-"), std::string::npos);
  const Outcome with = tool("stress --random 3 --seed 5 --device llvmpipe -o " + out());
  EXPECT_EQ(with.code, 0) << with.err;
  EXPECT_EQ(with.err.find("left out"), std::string::npos) << with.err;
  for (const char* method :
       {"gpu-cells", "gpu-cells-fixed", "gpu-group", "gpu-refined", "gpu-mask", "gpu-lights", "gpu-tiled"})
    EXPECT_NE(file_text(out()).find('"' + std::string(method) + '"'), std::string::npos) << method;
  EXPECT_EQ(tool("stress -q --random 3 --methods ^gpu-cells$ -o " + out()).code, 0);
  const Outcome gone = tool("stress --random 3 --device radeon");
  EXPECT_EQ(gone.code, 2);
  EXPECT_TRUE(
      gone.err.starts_with("clusterbench: --device: 'radeon' is no device of this machine; devices here: 0 (llvmpipe"))
      << gone.err;
}

// As on most machines that count: what asks for no device goes on, and what does says why it cannot.
TEST(WithoutADriver, commands_go_on_unless_they_ask_for_a_device) {
  const Folder folder;
  const std::string out = " -q -o " + (folder / "out").string(), scene = source_file("scenes/methods.gltf");
  use_driver((folder / "none.json").string());
  for (const std::string& words :
       {"stress --cases H1 --methods aabb-fast --tries 0" + out, "stress --random 2 --methods 'aabb|exact-fast'" + out,
        "stress --random 2 --cases H2 --methods gpu-cells,aabb-fast" + out,
        "run --no-timing --filter 16x9 --set 'scenes.*.frames=1' " + scene + out,
        "run --no-timing --presets --set 'scenes.*.frames=1' " + scene + out,
        "size --all --filter 'aabb-fast' --set 'scenes.*.frames=1' " + scene, std::string("list assigners")}) {
    const Outcome done = tool(words);
    EXPECT_EQ(done.code, 0) << words << "\n" << done.err;
  }
  for (const std::string& words :
       {"stress --random 2 --methods gpu-cells" + out, "stress --random 2 --device llvmpipe" + out,
        "run --no-timing --assigner gpu-cells " + scene + out, std::string("list devices")}) {
    const Outcome done = tool(words);
    EXPECT_EQ(done.code, 2) << words << "\n" << done.err;
    EXPECT_NE(done.err.find("Vulkan"), std::string::npos) << words << "\n" << done.err;
  }
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) unsetenv(name);
}

}  // namespace
}  // namespace clusterbench::test
