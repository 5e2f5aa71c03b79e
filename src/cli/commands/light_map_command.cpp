// `clusterbench light-map SCENE...`: the size of a map with one bit per light and texel of static meshes.

#include <charconv>
#include <iostream>
#include <memory>

#include "cli/command_line/commands.h"
#include "cli/options/run_inputs.h"
#include "cli/output/output.h"
#include "core/libraries.h"
#include "core/text.h"
#include "report/searches/light_map_report.h"

namespace clusterbench::cli {
namespace {

struct LightMapFlags {
  std::vector<std::string> scenes;
  std::string output, resolution;
  scene::GltfChoice choice;
  scene::RangeRule rule;
  measure::LightMapRequest request;
  bool conservative = false, quiet = false;
};

// "512" or "512x256".
Vec2i map_size_in(const std::string& words) {
  const std::size_t cross = words.find('x');
  const std::string parts[] = {words.substr(0, cross), cross == std::string::npos ? words : words.substr(cross + 1)};
  Vec2i size{0, 0};
  for (int i = 0; i < 2; ++i) {
    const char* end = parts[i].data() + parts[i].size();
    const auto [last, failed] = std::from_chars(parts[i].data(), end, size[i]);
    if (failed != std::errc() || last != end || size[i] < 1 || size[i] > measure::k_longest_map_side)
      throw Error("", "--resolution",
                  "'" + words + "' is not SIDE or WIDTHxHEIGHT, as in 512 or 512x256: each 1 to " +
                      std::to_string(measure::k_longest_map_side) + " texels");
  }
  return size;
}

measure::LightMapRequest light_map_request(const LightMapFlags& flags) {
  measure::LightMapRequest request = flags.request;
  if (flags.conservative) request.coverage = measure::TexelCoverage::conservative;
  if (flags.resolution.empty()) return request;
  if (request.unwrap)
    throw Error("", "--resolution", "has no meaning with --unwrap, whose maps are as large as needed");
  request.resolution = map_size_in(flags.resolution);
  return request;
}

report::LightMapScene light_maps_of(const std::string& path, const LightMapFlags& flags,
                                    const measure::LightMapRequest& request) {
  report::LightMapScene out;
  out.scene = scene::load_gltf(path, flags.choice);
  refuse_overwriting({flags.output}, files_of_scene(path));
  scene::resolve_ranges(out.scene, flags.rule);
  const scene::Geometry geometry = load_geometry(
      out.scene, request.unwrap ? scene::GeometryParts::positions : scene::GeometryParts::positions_and_uvs);
  out.geometry_sha256 = geometry.sha256;
  out.warnings = out.scene.warnings;
  out.warnings.insert(out.warnings.end(), geometry.warnings.begin(), geometry.warnings.end());
  out.found = measure::measure_light_maps(out.scene, geometry, request);
  return out;
}

ExitCode light_map(const LightMapFlags& flags) {
  const measure::LightMapRequest request = light_map_request(flags);
  if (request.visibility) need_library(Library::embree, "--visibility", "rays to lights");
  refuse_overwriting({flags.output}, flags.scenes);
  const bool for_reading = is_for_reading(flags.output);
  LaterOutput output(flags.output, for_reading);
  std::vector<report::LightMapScene> scenes;
  for (const std::string& path : flags.scenes) scenes.push_back(light_maps_of(path, flags, request));
  output.write(result::to_json(report::light_maps_document(scenes, request)));
  if (!flags.quiet)
    (for_reading ? std::cout : std::cerr) << printable_lines(report::light_maps_text(scenes, request)) << std::flush;
  if (for_reading) warn_result_not_saved();
  return ExitCode::ok;
}

void add_test_options(Command& command, LightMapFlags& flags) {
  command.add_flag("--facing", flags.request.facing, "Only lights in front of the surface (N.L > 0)");
  const Option visibility =
      command.add_flag("--visibility", flags.request.visibility,
                       "Only lights that the texel sees, by one shadow ray; what moves throws no shadow");
  command
      .add_option("--lamp-radius", flags.request.lamp_radius_m,
                  "With --visibility: what is so near to a light does not hide it, metres")
      .needs(visibility)
      .range(0.0, 1e6)
      .shows_standard();
}

}  // namespace

void add_light_map(Command& program, Action& action) {
  auto flags = std::make_shared<LightMapFlags>();
  Command command = program.add_command(
      "light-map",
      "Measure light maps: a bit per light and texel of static meshes, and sparser forms of the same sets");
  command.add_option("SCENE", flags->scenes, "Scenes (.glb, .gltf) with triangles").required();
  command.add_option("-o,--output", flags->output,
                     "JSON file; -: standard output. Without it a terminal shows the table only, a pipe gets the JSON");
  command
      .add_option("--texels-per-metre", flags->request.texels_per_metre,
                  "Of a mesh on the average, as its area in the world and in texture coordinates has it")
      .range(1e-6, 1e6)
      .shows_standard();
  command.add_option("--resolution", flags->resolution, "SIDE or WIDTHxHEIGHT of every map, in place of that");
  command.add_flag("--unwrap", flags->request.unwrap,
                   "Lay each flat face down by itself, in place of the file's texture coordinates");
  command.add_flag("--conservative", flags->conservative, "All texels that a triangle touches, not only their centres");
  add_test_options(command, *flags);
  command.add_option("--tile", flags->request.tile, "Texels squared that share a bit field, for comparison")
      .range(1, 256)
      .shows_standard();
  command.add_option("--scene", flags->choice.scene, "Name or number of one of the file's scenes");
  command.add_option("--animation", flags->choice.animation, "Name or number of the only animation that plays");
  command.add_option("--cutoff-lux", flags->rule.cutoff_lux, "Illuminance at which a light without range ends")
      .shows_standard()
      .positive_to(1e9);
  command.add_option("--max-range", flags->rule.max_range_m, "Longest range given to such a light, metres")
      .shows_standard()
      .positive_to(1e9);
  command.add_option("--threads", flags->request.threads, "Threads; results do not depend on it")
      .range(1, 1024)
      .shows_standard();
  command.add_flag("-q,--quiet", flags->quiet, "No table");
  command.when_named([flags, &action] { action = [flags] { return light_map(*flags); }; });
}

}  // namespace clusterbench::cli
