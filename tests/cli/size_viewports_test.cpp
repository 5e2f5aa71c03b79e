// Levels that are drawn in several sizes, as with dynamic resolution: a shader has one lookup, which takes the
// viewport.

#include <gtest/gtest.h>

#include "cli/tool.h"
#include "core/random.h"
#include "effort.h"

namespace clusterbench::test {
namespace {

struct Sliced {
  const char* scheme;
  bool is_same_in_all_viewports = true;  // cubical cells are as deep as they are wide on the screen
};
constexpr Sliced k_sliced[] = {{"exponential"}, {"exponential-first"},   {"linear"}, {"cubical", false},
                               {"power"},       {"cubical-first", false}};

std::string random_viewports(SplitMix64& random) {
  std::string sizes;
  for (std::uint64_t i = 0, count = 2 + random.below(2); i < count; ++i)
    sizes +=
        (i > 0 ? "," : "") + std::to_string(200 + random.below(500)) + "x" + std::to_string(100 + random.below(300));
  return sizes;
}

bool can_compile() {
  return std::system("command -v glslangValidator >/dev/null") == 0;
}

bool compiles(const Folder& folder, const std::string& code, bool is_hlsl) {
  const std::string main = is_hlsl ? "[numthreads(1, 1, 1)] void main() {}\n" : "void main() {}\n";
  const std::string head = is_hlsl ? "" : "#version 450\nlayout(local_size_x = 1) in;\n";
  const std::string file = folder.write(is_hlsl ? "x.hlsl" : "x.comp", head + code + main).string();
  return std::system(("glslangValidator " + std::string(is_hlsl ? "-V -D -e main " : "-V ") + "-S comp " + file +
                      " -o " + (folder / "x.spv").string() + " >/dev/null")
                         .c_str()) == 0;
}

TEST(SizeOverViewports, gives_the_lookup_that_takes_the_viewport_unless_slices_depend_on_it) {
  const Folder folder;
  const std::string level = source_file("scenes/street.glb");
  SplitMix64 random(16);
  for (int draw = 0; draw < tries(20); ++draw) {
    const Sliced& sliced = k_sliced[static_cast<std::size_t>(draw) % std::size(k_sliced)];
    const bool is_hlsl = random.below(2) == 0;
    const std::string flags =
        " --viewport " + random_viewports(random) + " --one-for-viewports --grid frustum --tiles " +
        (random.below(2) == 0 ? "64" : "16x9t") + " --scheme " + sliced.scheme +
        (!sliced.is_same_in_all_viewports ? "" : " --slices " + std::to_string(1 + random.below(12))) +
        " --assigner exact-fast --set scenes.*.frames=2 --name lights -q --format " + (is_hlsl ? "hlsl" : "glsl");
    const Outcome size = tool("size " + level + flags);
    ASSERT_EQ(size.code, 0) << flags << "\n" << size.err;
    const std::string of_all = std::string("int lights_lookup_cell_of(") + (is_hlsl ? "float2" : "vec2") +
                               " pixel, float along, " + (is_hlsl ? "float2" : "vec2") + " viewport)";
    EXPECT_EQ(size.out.find(of_all) != std::string::npos, sliced.is_same_in_all_viewports) << flags << "\n" << size.out;
    EXPECT_EQ(size.out.find("lights_walk_2_lookup_cell_of(") != std::string::npos, !sliced.is_same_in_all_viewports)
        << flags << "\n"
        << size.out;
    EXPECT_TRUE(!can_compile() || compiles(folder, size.out, is_hlsl)) << flags << "\n" << size.out;
  }
}

}  // namespace
}  // namespace clusterbench::test
