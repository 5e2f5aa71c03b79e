// The snippets of `size` for shaders compile, and their lookups find the cells that the tool's own find.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/random.h"
#include "grid/grid.h"
#include "report/result_by_hand.h"
#include "report/results/result_record.h"
#include "report/shader_compiler.h"
#include "report/size_report/size_report.h"
#include "run/grid_facts.h"

namespace clusterbench::report {
namespace {

using testing::case_by_hand;
using testing::ShaderTest;

constexpr Vec2i k_viewport{1920, 1080};

// A grid, and how many numbers a sample of its lookup has: pixel and depth, or a point.
struct LookedUp {
  std::string name;
  grid::GridSpec spec;
  grid::Grid grid;
  bool orthographic = false;
};

LookedUp looked_up(const std::string& name, const grid::GridSpec& spec, bool orthographic = false) {
  grid::GridInputs inputs;
  inputs.projection = {orthographic, -12.0, 12.0, -6.75, 6.75, 0.1, 500.0};
  if (!orthographic) inputs.projection = {false, -1.0, 1.0, -0.5625, 0.5625, 0.1, 500.0};
  inputs.viewport = k_viewport;
  inputs.light_near_m = 3.0;
  inputs.light_far_m = 77.0;
  inputs.rig_lo_m = {-20.5, -3.0, -140.0};
  inputs.rig_hi_m = {33.0, 17.25, 12.0};
  return {name, spec, grid::make_grid(spec, inputs), orthographic};
}

grid::GridSpec slices(grid::Scheme scheme, int count, double near_m = 0.0, double far_m = 0.0) {
  grid::GridSpec spec;
  spec.slices.scheme = scheme;
  spec.slices.count = count;
  spec.slices.near_m = near_m;
  spec.slices.far_m = far_m;
  return spec;
}

// Every way of cutting, tiles by pixels and by number, both projections, and all kinds.
std::vector<LookedUp> all_lookups() {
  using grid::Scheme;
  std::vector<LookedUp> all;
  const std::pair<const char*, grid::GridSpec> cuts[] = {
      {"linear", slices(Scheme::linear, 24, 0.1, 400)},
      {"exponential", slices(Scheme::exponential, 24, 0.1, 400)},
      {"first", slices(Scheme::exponential_first, 16, 0.1, 500)},
      {"power", slices(Scheme::power, 17, 0.25, 300)},
      {"fit", slices(Scheme::fit, 12)},
      {"two", slices(Scheme::exponential, 1, 0.5, 2)},
      {"list", slices(Scheme::list, 0)},
  };
  for (const auto& [name, cut] : cuts)
    for (const bool by_count : {false, true}) {
      grid::GridSpec spec = cut;
      if (spec.slices.scheme == Scheme::list) spec.slices.boundaries_m = {0.5, 1, 2.5, 2.75, 9, 33.3, 100};
      if (by_count) spec.tiles = {{0, 0}, {16, 9}};
      if (!by_count) spec.tiles = {{56, 40}, {0, 0}};  // does not divide the viewport
      const std::string tiles = by_count ? " counted" : " pixels";
      all.push_back(looked_up(name + tiles, spec));
      all.push_back(looked_up(name + tiles + " orthographic", spec, true));
      spec.kind = grid::Kind::distance;
      all.push_back(looked_up(name + tiles + " distance", spec));
    }
  grid::GridSpec cubes;
  cubes.kind = grid::Kind::cascades;
  cubes.cells = {16, 12, 8};
  cubes.levels = 4;
  cubes.finest_m = 0.3;
  all.push_back(looked_up("cubes", cubes));
  grid::GridSpec boxes;
  boxes.kind = grid::Kind::world;
  boxes.cells = {33, 7, 64};
  all.push_back(looked_up("boxes", boxes));
  boxes.has_bounds = true;
  boxes.bounds_lo_m = {1e6, -2.0, -7.0};
  boxes.bounds_hi_m = {1e6 + 40.0, 9.0, 33.0};
  all.push_back(looked_up("far boxes", boxes));
  return all;
}

run::Result result_of_lookups(const std::vector<LookedUp>& all) {
  run::Result result = testing::result_by_hand();
  result.cases.clear();
  result.planned_ids.clear();
  for (const LookedUp& one : all) {
    run::CaseResult entry = case_by_hand(one.name, "aabb", 1.0);
    entry.name = "hall/walk/" + one.name + "/aabb/packed";
    entry.viewport = k_viewport;
    entry.grid = run::grid_facts(one.spec, one.grid, 500.0);
    result.cases.push_back(entry);
    result.planned_ids.push_back(one.name);
  }
  return result;
}

// A sample as the shader takes it, and the tool.
struct Probe {
  float shader[3];
  grid::Sample sample;
};

// In the picture, beside it, on its edges, or just beyond them.
float random_pixel(int size, SplitMix64& random) {
  const auto end = static_cast<float>(size);
  constexpr float k_beyond = std::numeric_limits<float>::infinity();
  const float edges[] = {0.0f, std::nextafter(0.0f, -k_beyond), end, std::nextafter(end, k_beyond)};
  if (random.next() % 8 == 0) return edges[random.next() % std::size(edges)];
  return static_cast<float>(random.between(-0.1 * size, 1.1 * size));
}

Probe random_probe(const LookedUp& one, SplitMix64& random) {
  Probe probe{};
  if (one.grid.has_tiles()) {
    const float pixel_x = random_pixel(k_viewport.x, random), pixel_y = random_pixel(k_viewport.y, random);
    // As many before the first boundary and beyond the last as there are anywhere.
    const float depth = static_cast<float>(std::exp(random.between(std::log(0.01), std::log(900.0))));
    probe.sample.pixel_x = pixel_x;
    probe.sample.pixel_y = pixel_y;
    probe.sample.view = {0.0f, 0.0f, -depth};  // the distance is the depth
    probe.shader[0] = pixel_x;
    probe.shader[1] = pixel_y;
    probe.shader[2] = depth;
    return probe;
  }
  const std::optional<Vec3d> origin = one.grid.world_origin();
  const Vec3f at(static_cast<float>(random.between(-40.0, 40.0)), static_cast<float>(random.between(-20.0, 20.0)),
                 static_cast<float>(random.between(-90.0, 90.0)));
  probe.sample.view = at;
  probe.sample.eye = origin.value_or(Vec3d(0.0));
  probe.sample.from_eye = Vec3d(at);
  const Vec3f local = origin ? Vec3f(probe.sample.from(*origin)) : at;
  for (int axis = 0; axis < 3; ++axis) probe.shader[axis] = local[axis];
  return probe;
}

// One more and one less in the last digits: where the answer stays, no rounding of a logarithm can change it.
bool is_away_from_boundaries(const LookedUp& one, const Probe& probe) {
  const std::int64_t cell = grid::lookup(one.grid, probe.sample);
  constexpr double k_nudge = 4e-6;
  for (const double factor : {1.0 - k_nudge, 1.0 + k_nudge}) {
    grid::Sample nudged = probe.sample;
    nudged.view = Vec3f(Vec3d(nudged.view) * factor);
    nudged.from_eye = nudged.from_eye * factor;
    if (grid::lookup(one.grid, nudged) != cell) return false;
  }
  return true;
}

std::vector<std::uint32_t> words_of(const std::vector<Probe>& probes) {
  std::vector<std::uint32_t> words;
  for (const Probe& probe : probes)
    for (const float number : probe.shader) words.push_back(std::bit_cast<std::uint32_t>(number));
  return words;
}

constexpr std::size_t k_per_grid = 3000;

// Reads so many samples for each lookup, one lookup after the other.
std::string shader_that_looks_up(const run::Result& result, const std::vector<LookedUp>& all, bool is_hlsl,
                                 bool names_viewport = false) {
  const result::Result record = record_of(result, {});
  const auto structures = nlohmann::json::parse(size_report(record, {"", false, "json"}))["structures"];
  std::string out = is_hlsl ? "RWStructuredBuffer<float> samples : register(u0);\nRWStructuredBuffer<int> cells : "
                              "register(u1);\n"
                            : "#version 450\nlayout(local_size_x = 1) in;\n"
                              "layout(std430, binding = 0) buffer In { float samples[]; };\n"
                              "layout(std430, binding = 1) buffer Out { int cells[]; };\n";
  out += size_report(record, {"", false, is_hlsl ? "hlsl" : "glsl"});
  out += is_hlsl ? "[numthreads(1, 1, 1)] void main() {\n" : "void main() {\n";
  const std::string real2 = is_hlsl ? "float2" : "vec2", real3 = is_hlsl ? "float3" : "vec3";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string lookup = structures[i]["lookups"][0]["identifier"].get<std::string>() + "_cell_of";
    const std::string from = std::to_string(i * k_per_grid), to = std::to_string((i + 1) * k_per_grid),
                      n = "n" + std::to_string(i);
    const std::string x = "samples[3 * " + n + "], samples[3 * " + n + " + 1]", z = "samples[3 * " + n + " + 2]";
    out += "  for (int " + n + " = " + from + "; " + n + " < " + to + "; ++" + n + ") cells[" + n + "] = " + lookup +
           "(" +
           (all[i].grid.has_tiles()
                ? real2 + "(" + x + "), " + z + (names_viewport ? ", " + real2 + "(1920.0, 1080.0)" : "")
                : real3 + "(" + x + ", " + z + ")") +
           ");\n";
  }
  return out + "}\n";
}

class SizeShaders : public ShaderTest {};
class SizeLookups : public ShaderTest, public ::testing::WithParamInterface<bool> {};

// Dynamic resolution: cells of half the picture, by the constants of the whole one.
TEST_P(SizeLookups, find_the_cells_of_a_viewport_that_is_given_with_the_sample) {
  std::vector<LookedUp> all = all_lookups();
  std::erase_if(all, [](const LookedUp& one) { return !one.grid.has_tiles(); });
  const run::Result result = result_of_lookups(all);
  ASSERT_TRUE(compiles(shader_that_looks_up(result, all, GetParam(), true), GetParam()));
  SplitMix64 random(11);
  std::vector<Probe> probes;
  for (const LookedUp& one : all)
    for (std::size_t i = 0; i < k_per_grid; ++i) probes.push_back(random_probe(one, random));
  const std::vector<std::int32_t> cells = answers(words_of(probes), probes.size());
  ASSERT_EQ(cells.size(), probes.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t wrong = 0;
    for (std::size_t k = i * k_per_grid; k < (i + 1) * k_per_grid; ++k) {
      // An edge of the 16 x 9 tiles, divided anew, may be the neighbour's.
      const auto is_near_edge = [](float pixel) { return std::fabs(std::remainder(pixel, 120.0f)) < 1e-2f; };
      if (is_near_edge(probes[k].shader[0]) || is_near_edge(probes[k].shader[1])) continue;
      if (!is_away_from_boundaries(all[i], probes[k])) continue;
      wrong += cells[k] != grid::lookup(all[i].grid, probes[k].sample) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u) << all[i].name;
  }
}

// On a boundary a logarithm's last digit decides: there the neighbouring slice is allowed, and nothing else.
TEST_P(SizeLookups, find_the_cells_that_the_tool_finds) {
  const std::vector<LookedUp> all = all_lookups();
  const run::Result result = result_of_lookups(all);
  ASSERT_TRUE(compiles(shader_that_looks_up(result, all, GetParam()), GetParam()));
  SplitMix64 random(7);
  std::vector<Probe> probes;
  for (const LookedUp& one : all)
    for (std::size_t i = 0; i < k_per_grid; ++i) probes.push_back(random_probe(one, random));
  const std::vector<std::int32_t> cells = answers(words_of(probes), probes.size());
  ASSERT_EQ(cells.size(), probes.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::size_t exact = 0, inside = 0, wrong = 0;
    for (std::size_t k = i * k_per_grid; k < (i + 1) * k_per_grid; ++k) {
      const std::int64_t own = grid::lookup(all[i].grid, probes[k].sample);
      inside += own >= 0 ? 1 : 0;
      if (is_away_from_boundaries(all[i], probes[k])) {
        ++exact;
        wrong += cells[k] != own ? 1 : 0;
      } else if (all[i].grid.has_tiles() && own >= 0 && cells[k] >= 0) {
        const Vec3i counts = all[i].grid.cells();
        const std::int64_t slice = std::int64_t{counts.x} * counts.y;
        wrong += std::abs(cells[k] - own) != slice && cells[k] != own ? 1 : 0;
      }
    }
    EXPECT_EQ(wrong, 0u) << all[i].name;
    EXPECT_GT(exact, k_per_grid * 9 / 10) << all[i].name << ": nearly all samples are compared exactly";
    EXPECT_GT(inside, k_per_grid / 50) << all[i].name;
    EXPECT_LT(inside, k_per_grid) << all[i].name << ": some samples are outside";
  }
}

INSTANTIATE_TEST_SUITE_P(Languages, SizeLookups, ::testing::Bool(),
                         [](const auto& of) { return std::string(of.param ? "hlsl" : "glsl"); });

TEST_F(SizeShaders, compile_whatever_cases_are_called) {
  run::Result result = testing::result_by_hand();
  const std::string names[] = {"9 lives\n#error a name broke out\\",
                               "\xC3\xA9t\xC3\xA9/__x__//y\\",
                               "gl_x",
                               "",
                               "hall/walk/a?\?/",
                               std::string(300, 'l'),
                               "a",
                               "a_indices"};
  result.cases.clear();
  result.planned_ids.clear();
  for (const std::string& name : names) {
    run::CaseResult one = case_by_hand("id" + std::to_string(result.cases.size()), "aabb", 1.0);
    one.name = name;
    one.grid["slices"] =
        nlohmann::json::parse(R"({"scheme": "list", "boundaries": [1], "lookup": {"form": "search"}})");
    one.grid["tiles"] = {{"count", {4, 3}}};
    result.planned_ids.push_back(one.id);
    result.cases.push_back(one);
  }
  const result::Result record = record_of(result, {});
  EXPECT_TRUE(compiles(
      "#version 450\nlayout(local_size_x = 1) in;\n" + size_report(record, {"", true, "glsl"}) + "void main() {}\n",
      false));
  EXPECT_TRUE(compiles(size_report(record, {"", true, "hlsl"}) + "[numthreads(1, 1, 1)] void main() {}\n", true));
}

TEST_F(SizeShaders, compile_in_a_fragment_shader_of_opengl_es) {
  const result::Result record = record_of(testing::result_by_hand(), {});
  write("x.frag", "#version 310 es\n" + size_report(record, {"", false, "glsl"}) +
                      "out vec4 colour;\nvoid main() { colour = vec4(1.0); }\n");
  EXPECT_TRUE(does("glslangValidator -S frag " + path("x.frag")));
}

TEST(SizeShaderText, says_from_where_pixels_count_in_opengl_as_well) {
  const result::Result record = record_of(result_of_lookups(all_lookups()), {});
  EXPECT_NE(size_report(record, {"", false, "glsl"}).find("from the top left (OpenGL's gl_FragCoord: from the bottom)"),
            std::string::npos);
}

}  // namespace
}  // namespace clusterbench::report
