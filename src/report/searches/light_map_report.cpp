#include "report/searches/light_map_report.h"

#include <algorithm>
#include <map>

#include "core/text.h"
#include "measure/lists/occupancy.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using measure::LightMap;
using measure::LightMapCounts;
using measure::LightMapRequest;
using measure::LightMaps;

constexpr std::size_t k_maps_shown = 20;

double share_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

bool is_test_done(const LightMapRequest& request, measure::TexelTest test) {
  return test == measure::TexelTest::facing       ? request.facing
         : test == measure::TexelTest::visibility ? request.visibility
                                                  : true;
}

result::LeftAfterTests left_after_tests(const LightMapCounts& counts, const LightMapRequest& request) {
  const auto left = [&](measure::TexelTest test) -> result::Nullable<std::uint64_t> {
    if (!is_test_done(request, test)) return {};
    return counts.left[static_cast<std::size_t>(test)];
  };
  using enum measure::TexelTest;
  return {left(range), left(cone), left(facing), left(visibility)};
}

result::LightsPerTexel lights_per_texel(const LightMapCounts& counts) {
  const measure::Spread spread = measure::spread_of_histogram(counts.histogram);
  const measure::Histogram histogram = measure::short_histogram(counts.histogram);
  return {.mean = spread.mean,
          .p50 = static_cast<std::uint64_t>(spread.p50),
          .p95 = static_cast<std::uint64_t>(spread.p95),
          .p99 = static_cast<std::uint64_t>(spread.p99),
          .max = static_cast<std::uint64_t>(spread.max),
          .histogram = {histogram.lights_per_entry, histogram.cells}};
}

result::MapBytes map_bytes(const measure::LightMapBytes& bytes) {
  result::MapBytes out{.bit_field = bytes.bits_of_all,
                       .bit_field_of_own_lights = bytes.bits_of_own,
                       .palette = bytes.palette,
                       .tile_bit_fields = bytes.tiles};
  if (bytes.lists_8) out.lists_8.emplace(*bytes.lists_8);
  if (bytes.lists_16) out.lists_16.emplace(*bytes.lists_16);
  return out;
}

result::LightMapFigures map_figures(const LightMapCounts& counts, const LightMapRequest& request) {
  result::LightMapFigures out;
  out.triangles = {counts.triangles, counts.wrapped_triangles, counts.degenerate_triangles, counts.missed_triangles};
  out.texels = {counts.texels, counts.covered, counts.dead(), counts.overlapping, counts.lit};
  out.dead_share = share_of(counts.dead(), counts.texels);
  out.overlapping_share = share_of(counts.overlapping, counts.covered);
  out.occupied_fraction = share_of(counts.lit, counts.covered);
  out.bits_set = counts.pairs;
  out.left_after = left_after_tests(counts, request);
  out.lights_per_texel = lights_per_texel(counts);
  out.distinct_sets = counts.sets;
  out.tiles = {counts.tiles, counts.tile_pairs, counts.tile_false_positives(),
               counts.pairs > 0 ? share_of(counts.tile_false_positives(), counts.pairs) : result::k_none};
  out.bytes = map_bytes(counts.bytes);
  return out;
}

result::LightMap map_document(const LightMap& map, const LightMapRequest& request) {
  result::LightMap out{map_figures(map.counts, request)};
  out.mesh = map.name;
  if (map.uv_set >= 0) out.uv_set.emplace(static_cast<std::uint64_t>(map.uv_set));
  out.width = static_cast<std::uint64_t>(map.grid.width);
  out.height = static_cast<std::uint64_t>(map.grid.height);
  out.area_m2 = map.area_m2;
  out.own_lights = map.lights;
  return out;
}

result::LightMapScene scene_document(const LightMapScene& scene, const LightMapRequest& request) {
  const LightMaps& found = scene.found;
  result::LightMapScene out{.name = scene.scene.name,
                            .sha256 = scene.scene.sha256,
                            .geometry_sha256 = scene.geometry_sha256,
                            .range_rule = {scene.scene.range_rule.cutoff_lux, scene.scene.range_rule.max_range_m},
                            .lights = {found.points, found.spots, found.moving_lights, found.directional},
                            .all = map_figures(found.all, request),
                            .warnings = scene.warnings,
                            .seconds = found.seconds};
  for (const LightMap& map : found.maps) out.maps.push_back(map_document(map, request));
  for (const measure::LeftOut& mesh : found.left_out) out.left_out.push_back({mesh.name, mesh.reason});
  return out;
}

std::string percent_of(std::uint64_t part, std::uint64_t whole) {
  return whole > 0 ? text("%.1f %%", 100.0 * share_of(part, whole)) : "-";
}

std::string short_bytes(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (value < 10'000.0) return text("%.0f", value);
  return value < 1e6 ? text("%.1fk", value / 1e3) : text("%.2fM", value / 1e6);
}

std::string short_bytes(const std::optional<std::uint64_t>& bytes) {
  return bytes ? short_bytes(*bytes) : "-";
}

Cells texel_row(const std::string& name, const std::string& size, const LightMapCounts& counts) {
  const measure::Spread spread = measure::spread_of_histogram(counts.histogram);
  return {"",
          name,
          size,
          short_bytes(counts.texels),
          percent_of(counts.dead(), counts.texels),
          percent_of(counts.overlapping, counts.covered),
          percent_of(counts.lit, counts.covered),
          text("%.2f", spread.mean),
          text("%.0f", spread.p50),
          text("%.0f", spread.p95),
          text("%.0f", spread.p99),
          text("%.0f", spread.max)};
}

Cells bytes_row(const std::string& name, const std::string& own, const LightMapCounts& counts) {
  return {"",
          name,
          own,
          short_bytes(counts.pairs),
          short_bytes(counts.bytes.bits_of_all),
          short_bytes(counts.bytes.bits_of_own),
          short_bytes(counts.bytes.lists_8),
          short_bytes(counts.bytes.lists_16),
          short_bytes(counts.sets),
          short_bytes(counts.bytes.palette),
          short_bytes(counts.bytes.tiles),
          counts.pairs > 0 ? text("%.3f", share_of(counts.tile_false_positives(), counts.pairs)) : "-"};
}

// The maps with the most texels, in the order of the scene.
std::vector<const LightMap*> shown_maps(const LightMaps& found) {
  std::vector<const LightMap*> maps;
  for (const LightMap& map : found.maps) maps.push_back(&map);
  std::ranges::stable_sort(maps,
                           [](const LightMap* a, const LightMap* b) { return a->counts.texels > b->counts.texels; });
  if (maps.size() > k_maps_shown) maps.resize(k_maps_shown);
  std::ranges::sort(maps);
  return maps;
}

std::string light_map_tables(const LightMaps& found) {
  std::vector<Cells> texels{
      {"", "map", "size", "texels", "dead", "overlapping", "lit", "lights: mean", "p50", "p95", "p99", "max"}},
      bytes{{"", "map", "own lights", "bits set", "bit field", "of own lights", "lists, 8 bits", "16 bits",
             "distinct sets", "palette, bytes", "tiles, bytes", "tile excess"}};
  const std::vector<const LightMap*> maps = shown_maps(found);
  for (const LightMap* map : maps) {
    const std::string size = std::to_string(map->grid.width) + " x " + std::to_string(map->grid.height);
    texels.push_back(texel_row(shown(map->name), size, map->counts));
    bytes.push_back(bytes_row(shown(map->name), std::to_string(map->lights), map->counts));
  }
  const std::string all = "all " + number_of(found.maps.size(), "map");
  texels.push_back(texel_row(all, "", found.all));
  bytes.push_back(bytes_row(all, "", found.all));
  std::string out = aligned_rows(texels) + "\n" + aligned_rows(bytes);
  if (const std::size_t others = found.maps.size() - maps.size(); others > 0)
    out += "  " + number_of(others, "smaller map") + " not shown; the JSON has all\n";
  return out;
}

std::string tests_line(const LightMapCounts& counts, const LightMapRequest& request) {
  std::string out;
  std::uint64_t before = 0;
  for (std::size_t test = 0; test < measure::k_texel_tests; ++test) {
    if (!is_test_done(request, static_cast<measure::TexelTest>(test))) continue;
    out += (out.empty() ? "  pairs of texel and light: " : ", ") + std::to_string(counts.left[test]) +
           (out.empty() ? " in " : " left by ") + measure::k_texel_test_names[test];
    if (test > 0) out += " (-" + percent_of(before - counts.left[test], before) + ")";
    before = counts.left[test];
  }
  return out + "\n";
}

std::string triangles_line(const LightMapCounts& counts) {
  std::string out;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) out += "  " + number_of(count, "triangle") + " " + what + "\n";
  };
  add(counts.wrapped_triangles, "outside of texture coordinates 0..1: wrapped");
  add(counts.degenerate_triangles, "without area in texture coordinates: in no texel");
  add(counts.missed_triangles, "too small for the centre of a texel: in none (--conservative takes them)");
  if (counts.overlapping * 10 > counts.covered)
    out += "  warning: " + percent_of(counts.overlapping, counts.covered) +
           " of the covered texels hold several places: these are no light map's texture coordinates (--unwrap makes "
           "some)\n";
  return out;
}

std::string left_out_lines(const LightMaps& found) {
  std::map<std::string, std::pair<std::size_t, std::string>> by_reason;
  for (const measure::LeftOut& mesh : found.left_out) {
    auto& [count, first] = by_reason[mesh.reason];
    if (count++ == 0) first = mesh.name;
  }
  std::string out;
  for (const auto& [reason, meshes] : by_reason)
    out += "  left out  '" + shown(meshes.second) + "' " + reason +
           (meshes.first > 1 ? ", and " + number_of(meshes.first - 1, "other") + " likewise" : "") + "\n";
  if (found.moving_lights > 0) out += "  left out  " + number_of(found.moving_lights, "light") + " that move\n";
  if (found.directional > 0)
    out += "  left out  " + number_of(found.directional, "directional light") + ": no bit can say more than 'all'\n";
  return out;
}

}  // namespace

result::LightMaps light_maps_document(const std::vector<LightMapScene>& scenes, const LightMapRequest& request) {
  result::LightMaps out{
      .light_map_version = 1,
      .request = {.uvs = request.unwrap ? "made" : "file",
                  .coverage = request.coverage == measure::TexelCoverage::centres ? "centres" : "conservative",
                  .facing = request.facing,
                  .visibility = request.visibility,
                  .lamp_radius_m = request.lamp_radius_m,
                  .tile = static_cast<std::uint64_t>(request.tile)}};
  if (request.unwrap || !request.resolution)
    out.request.texels_per_metre = request.texels_per_metre;
  else
    out.request.resolution = result::Size2{request.resolution->x, request.resolution->y};
  for (const LightMapScene& scene : scenes) out.scenes.push_back(scene_document(scene, request));
  return out;
}

std::string light_maps_text(const std::vector<LightMapScene>& scenes, const LightMapRequest& request) {
  std::string out;
  for (const LightMapScene& scene : scenes) {
    const LightMaps& found = scene.found;
    out += (out.empty() ? "" : "\n") + shown(scene.scene.name) + ": " + number_of(found.points, "point light") +
           " and " + number_of(found.spots, "spot light") + text(", %.2f s\n", found.seconds);
    if (!found.maps.empty())
      out += light_map_tables(found) + tests_line(found.all, request) + triangles_line(found.all);
    else
      out += found.left_out.empty() ? "  the scene has no triangles\n"
             : request.unwrap       ? "  no mesh has a light map\n"
                                    : "  no mesh has a light map; --unwrap makes texture coordinates where the file "
                                      "has none\n";
    out += left_out_lines(found);
    for (const std::string& warning : scene.warnings) out += "  warning: " + shown(warning) + "\n";
  }
  return out;
}

}  // namespace clusterbench::report
