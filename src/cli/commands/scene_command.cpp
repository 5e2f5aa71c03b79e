// `clusterbench scene info FILE`, `clusterbench scene generate NAME` and `clusterbench scene views FILE`.

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/command_line/commands.h"
#include "cli/options/run_inputs.h"
#include "cli/output/output.h"
#include "core/error.h"
#include "core/text.h"
#include "scene/generators/generate.h"
#include "scene/scene.h"
#include "scene/summary.h"
#include "scene/writers/add_views.h"

namespace clusterbench::cli {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3d& v) {
  return Json::array({v.x, v.y, v.z});
}

Json to_json(const scene::Scene& scene, const scene::Summary& summary) {
  Json ranges{{"given", summary.ranges_given},      {"from_intensity", summary.ranges_from_intensity},
              {"clamped", summary.ranges_clamped},  {"min_m", summary.range_min_m},
              {"median_m", summary.range_median_m}, {"max_m", summary.range_max_m}};
  if (summary.ranges_from_intensity + summary.ranges_clamped > 0)
    ranges["by_rule"] = {{"cutoff_lux", scene.range_rule.cutoff_lux},
                         {"max_range_m", scene.range_rule.max_range_m},
                         {"min_m", summary.made_range_min_m},
                         {"max_m", summary.made_range_max_m}};
  return Json{{"name", scene.name},
              {"sha256", scene.sha256},
              {"nodes", scene.nodes.size()},
              {"lights",
               {{"point", summary.points},
                {"spot", summary.spots},
                {"directional", summary.directionals},
                {"box", summary.boxes}}},
              {"ranges", ranges},
              {"bounds_m", {to_json(summary.bounds_lo), to_json(summary.bounds_hi)}},
              {"duration_s", scene.duration_s},
              {"scenes", scene.contents.scenes},
              {"animations", scene.contents.animations},
              {"cameras", summary.cameras},
              {"warnings", summary.warnings}};
}

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// To std::cout, whose failures are told (check_standard_output()).
[[gnu::format(printf, 1, 2)]] void print_formatted(const char* format, ...) {
  std::va_list values;
  va_start(values, format);
  std::va_list again;
  va_copy(again, values);
  std::string text(static_cast<std::size_t>(std::max(0, std::vsnprintf(nullptr, 0, format, values))), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(values);
  std::cout << text;
}

// The ranges given to lights without one.
void print_made_ranges(const scene::RangeRule& rule, const scene::Summary& summary) {
  const int made = summary.ranges_from_intensity + summary.ranges_clamped;
  if (made == 0) return;
  const std::string least = metres(summary.made_range_min_m), greatest = metres(summary.made_range_max_m);
  print_formatted("  by rule  %s without range: %s m, where %s to %g lux (--cutoff-lux)",
                  number_of(static_cast<std::uint64_t>(made), "light").c_str(),
                  (least == greatest ? least : least + " to " + greatest).c_str(), made == 1 ? "it falls" : "they fall",
                  rule.cutoff_lux);
  if (summary.ranges_clamped > 0)
    print_formatted("; %d of them cut off at %g m (--max-range)", summary.ranges_clamped, rule.max_range_m);
  print_formatted("\n");
}

void print_scene(const scene::Scene& scene, const scene::Summary& summary) {
  const auto& lo = summary.bounds_lo;
  const auto& hi = summary.bounds_hi;
  print_formatted("%s\n  lights   %d point, %d spot, %d directional, %d box\n", printable(scene.name).c_str(),
                  summary.points, summary.spots, summary.directionals, summary.boxes);
  if (summary.points + summary.spots > 0) {
    print_formatted("  ranges   %.3g to %.3g m, median %.3g m; %d given, %d from intensity, %d clamped\n",
                    summary.range_min_m, summary.range_max_m, summary.range_median_m, summary.ranges_given,
                    summary.ranges_from_intensity, summary.ranges_clamped);
    print_made_ranges(scene.range_rule, summary);
    print_formatted("  bounds   (%.4g, %.4g, %.4g) to (%.4g, %.4g, %.4g) m\n", lo.x, lo.y, lo.z, hi.x, hi.y, hi.z);
  }
  const scene::GltfContents& file = scene.contents;
  if (file.scenes.size() > 1)
    print_formatted("  scenes   %s; read is %zu\n", printable(scene::numbered(file.scenes)).c_str(), file.scene);
  if (file.animations.size() > 1)
    print_formatted("  clips    %s\n", printable(scene::numbered(file.animations)).c_str());
  for (const std::string& camera : summary.cameras) print_formatted("  camera   %s\n", printable(camera).c_str());
  for (const std::string& warning : summary.warnings) print_formatted("  warning  %s\n", printable(warning).c_str());
}

ExitCode info(const std::string& path, const scene::GltfChoice& choice, const scene::RangeRule& rule, bool as_json) {
  scene::Scene scene = scene::load_gltf(path, choice);
  scene::resolve_ranges(scene, rule);
  const scene::Summary summary = scene::summarise(scene);
  if (as_json)
    std::cout << printable_json(to_json(scene, summary).dump(2)) << "\n";
  else
    print_scene(scene, summary);
  return ExitCode::ok;
}

struct InfoFlags {
  std::string file;
  scene::GltfChoice choice;
  scene::RangeRule rule;
  bool as_json = false;
};

struct GenerateFlags {
  std::string name, out;
  std::uint64_t seed = 1;
  int lights = 0;
};

void add_info(Command& parent, Action& action) {
  auto flags = std::make_shared<InfoFlags>();
  Command command =
      parent.add_command("info", "Lights, ranges, cameras and warnings of a glTF file; exit 2 if it is refused");
  command.add_option("FILE", flags->file, "A .gltf or .glb file").required();
  command.add_option("--scene", flags->choice.scene, "Name or number of one of its scenes; without, its default");
  command.add_option("--animation", flags->choice.animation,
                     "Name or number of the only animation that plays; without, all together");
  command.add_option("--cutoff-lux", flags->rule.cutoff_lux, "Illuminance at which a light without range ends")
      .shows_standard()
      .positive_to(1e9);
  command.add_option("--max-range", flags->rule.max_range_m, "Longest range given to such a light, metres")
      .shows_standard()
      .positive_to(1e9);
  command.add_flag("--json", flags->as_json, "As JSON");
  command.when_named(
      [flags, &action] { action = [flags] { return info(flags->file, flags->choice, flags->rule, flags->as_json); }; });
}

void add_generate(Command& parent, Action& action) {
  auto flags = std::make_shared<GenerateFlags>();
  Command command = parent.add_command("generate", "Write one of the tool's own scenes (names: clusterbench list)");
  command.add_option("NAME", flags->name, "Scene name").required();
  command.add_option("--seed", flags->seed, "The same seed gives the same bytes everywhere").seed();
  command.add_option("--lights", flags->lights, "Number of lights; 0: the scene's own")
      .shows_standard()
      .range(0, 10'000'000);
  command.add_option("-o,--output", flags->out, "File to write; NAME.glb if not given");
  command.when_named([flags, &action] {
    action = [flags] {
      const std::string out = flags->out.empty() ? flags->name + ".glb" : flags->out;
      if (std::filesystem::path(out).extension() != ".glb") throw Error(out, "", "scenes are written as .glb files");
      os::require_folder_of(out);
      write_text(out, scene::make_scene(flags->name, flags->seed, flags->lights));
      std::cerr << "wrote " << out << "\n";
      return ExitCode::ok;
    };
  });
}

struct ViewsFlags {
  std::string file, out, faces;
  std::vector<std::string> added;
  double eyes_m = 0.0;
  scene::ViewsRequest request;
};

std::vector<double> view_numbers(const std::string& text, const std::string& flag, std::size_t least,
                                 std::size_t most) {
  std::vector<double> numbers;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    char* end = nullptr;
    numbers.push_back(std::strtod(part.c_str(), &end));
    if (part.empty() || *end != '\0' || !std::isfinite(numbers.back())) numbers.clear();
    if (numbers.empty()) break;
  }
  if (numbers.size() < least || numbers.size() > most)
    throw Error("", flag,
                "'" + text + "' is not what it takes: " +
                    (least == most ? "three numbers in metres, X,Y,Z" : "NAME=X,Y,Z in metres, or NAME=X,Y,Z,DEGREES"));
  return numbers;
}

ExitCode views(ViewsFlags flags) {
  scene::ViewsRequest& request = flags.request;
  if (flags.eyes_m > 0.0)
    request.views = {{"left", {-0.5 * flags.eyes_m, 0.0, 0.0}}, {"right", {0.5 * flags.eyes_m, 0.0, 0.0}}};
  for (const std::string& text : flags.added) {
    const std::size_t equals = text.find('=');
    const std::vector<double> at =
        view_numbers(equals == std::string::npos ? "" : text.substr(equals + 1), "--add", 3, 4);
    request.views.push_back({text.substr(0, equals), {at[0], at[1], at[2]}, at.size() > 3 ? at[3] : 0.0});
  }
  if (!flags.faces.empty()) {
    const std::vector<double> at = view_numbers(flags.faces, "--faces", 3, 3);
    request.faces_at_m = Vec3d{at[0], at[1], at[2]};
  }
  if (request.views.empty() && !request.faces_at_m)
    throw Error("", "scene views", "adds nothing: give --eyes, --add or --faces");
  refuse_overwriting({flags.out}, {flags.file});
  const scene::Scene scene = scene::load_gltf(flags.file);
  refuse_overwriting({flags.out}, files_of_scene(flags.file));
  write_text(flags.out, scene::with_views(scene, request, flags.out));
  if (!is_stream(flags.out)) scene::load_gltf(flags.out);  // reports at once if the file cannot be read again
  std::cerr << "wrote " << flags.out << "\n";
  return ExitCode::ok;
}

void add_views(Command& parent, Action& action) {
  auto flags = std::make_shared<ViewsFlags>();
  Command command =
      parent.add_command("views", "Copy a scene with more cameras: two eyes, other players, a probe's faces");
  command.add_option("FILE", flags->file, "A .gltf or .glb file").required();
  command.add_option("--camera", flags->request.camera,
                     "The camera that --eyes and --add follow; without: the first animated one, or the first");
  command.add_option("--eyes", flags->eyes_m, "METRES: cameras `left` and `right`, so far apart, as 0.064").positive();
  command
      .add_option(
          "--add", flags->added,
          "NAME=X,Y,Z[,DEGREES], repeatable: a camera so many metres to the right, up and back, turned to the left "
          "by degrees; mirror=0,0,0,180 looks back")
      .once_a_name();
  command.add_option("--faces", flags->faces,
                     "X,Y,Z: six cameras face-px to face-nz around a point of the world, metres");
  command.add_option("-o,--output", flags->out, "File to write").required();
  command.when_named([flags, &action] { action = [flags] { return views(*flags); }; });
}

}  // namespace

void add_scene(Command& program, Action& action) {
  Command command = program.add_command("scene", "Look at glTF scenes, or make the tool's own");
  command.needs_command();
  add_info(command, action);
  add_generate(command, action);
  add_views(command, action);
}

}  // namespace clusterbench::cli
