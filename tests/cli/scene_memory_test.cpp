// What a file with many lights takes of memory, as the system counts it.

#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>

#include "cli/tool.h"
#include "effort.h"

extern char** environ;

namespace clusterbench::test {
namespace {

// Each lamp with a definition of its own, as Blender writes them: some 230 bytes. Written piece by piece: what this
// process takes at its peak counts as its child's, too.
std::string level(const std::filesystem::path& file, int lamps) {
  std::ofstream out(file, std::ios::binary);
  const auto list = [&](auto&& element) {
    for (int i = 0; i < lamps; ++i) {
      if (i > 0) out << ',';
      element(i);
    }
  };
  out << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[)";
  list([&](int i) { out << i; });
  out << "]}],\"nodes\":[";
  list([&](int i) {
    out << R"({"name":"Light.)" << i << R"(","translation":[)" << i
        << R"(,2.25,0],"rotation":[-0.7071068,0,0,0.7071068],"extensions":{"KHR_lights_punctual":{"light":)" << i
        << "}}}";
  });
  out << R"(],"extensions":{"KHR_lights_punctual":{"lights":[)";
  list(
      [&](int i) { out << R"({"type":"point","intensity":30,"range":4,"color":[1,0.9,0.8],"name":"L)" << i << "\"}"; });
  out << "]}}}";
  return file.string();
}

// Bytes at the peak of `scene info`; 0 where it failed.
double peak_of(const std::string& file) {
  std::string program = test::program(), scene = "scene", info = "info", name = file, json = "--json";
  const std::array<char*, 6> arguments{program.data(), scene.data(), info.data(), json.data(), name.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, 1, "/dev/null", 1, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program.c_str(), &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  int status = -1;
  rusage usage{};
  if (failed != 0 || wait4(child, &status, 0, &usage) != child || status != 0) return 0.0;
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(SceneMemory, a_light_takes_at_most_600_bytes) {
  if (k_sanitized) GTEST_SKIP() << "sanitizers take memory of their own";
  const Folder folder;
  constexpr int k_few = 50'000, k_many = 250'000;
  const double few = peak_of(level(folder / "few.gltf", k_few));
  const double many = peak_of(level(folder / "many.gltf", k_many));
  ASSERT_GT(few, 0.0);
  ASSERT_GT(many, 0.0);
  EXPECT_LT((many - few) / (k_many - k_few), 600.0);
}

}  // namespace
}  // namespace clusterbench::test
