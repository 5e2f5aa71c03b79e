#include "report/searches/worst_case_report.h"

#include <numbers>

#include "core/text.h"
#include "report/cases/columns.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using search::WorstCase;

result::Vector vector_of(const Vec3d& v) {
  return {{{v.x, v.y, v.z}}};
}

result::BoxInMetres box_of(const search::Box& box) {
  return {vector_of(box.lo), vector_of(box.hi)};
}

// A count as a whole number.
Json figure_value(double value, search::Measure measure) {
  if (measure == search::Measure::evaluated) return value;
  return static_cast<std::uint64_t>(value);
}

const char* name_of(search::Ended ended) {
  constexpr const char* k_names[] = {"evaluations", "seconds", "signal", "device"};
  return k_names[static_cast<int>(ended)];
}

// In the search's order.
std::vector<std::string> light_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::Light& light : scene.lights)
    if (light.type != scene::LightType::directional) names.push_back(light.name);
  return names;
}

result::WorstFrame frame_of(const search::FoundFrame& frame, const WorstCaseFacts& facts,
                            const std::vector<std::string>& names) {
  const search::FrameChoice& at = frame.choice;
  result::WorstFrame out{.value = figure_value(frame.value, facts.request.measure),
                         .eye_m = vector_of(at.eye),
                         .direction = vector_of(search::direction_of(at.rotation)),
                         .rotation = {at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w},
                         .moment = at.moment};
  for (std::size_t i = 0; i < at.extra_lights.size(); ++i)
    out.added_lights.push_back({vector_of(at.extra_lights[i]), facts.request.extra_ranges_m[i]});
  for (const auto& [light, position] : at.moved) out.moved_lights.push_back({names[light], vector_of(position)});
  return out;
}

// The end of slices, or the extent of boxes, that do not follow frames: computed from the recorded path if neither
// camera nor configuration has it.
result::Nullable<result::SearchedGridEnd> grid_end_of(const grid::GridSpec& spec) {
  if (spec.has_bounds && spec.follow == grid::Follow::nothing)
    return result::SearchedGridEnd{.bounds_m = box_of({spec.bounds_lo_m, spec.bounds_hi_m})};
  const bool is_fixed = spec.has_tiles() && spec.slices.far_m > 0.0 && !spec.slices.fit &&
                        spec.slices.scheme != grid::Scheme::fit && spec.slices.scheme != grid::Scheme::list;
  if (is_fixed) return result::SearchedGridEnd{.slices_m = spec.slices.far_m};
  return {};
}

// In the format of a configuration: "90h"; null: the file's own.
result::Nullable<std::string> fov_of(const std::optional<scene::FieldOfView>& fov) {
  if (!fov) return {};
  return text("%.12g", fov->angle_rad * 180.0 / std::numbers::pi) + (fov->is_horizontal ? "h" : "v");
}

// Further settings of the configuration that a finding depends on, besides the case's name.
result::SearchedSettings settings_of(const WorstCaseFacts& facts) {
  const config::SceneRequest& request = facts.config.scenes[facts.case_plan.scene];
  return {.fov = fov_of(request.camera.field_of_view),
          .far = request.camera.far_m.value_or(result::k_none),
          .camera_fit = request.camera.fit == scene::CameraFit::vertical ? "vertical" : "contain",
          .boxes = request.boxes,
          .range_rule = {request.range_rule.cutoff_lux, request.range_rule.max_range_m},
          .grid_end = grid_end_of(facts.config.grids[facts.case_plan.grid])};
}

result::SearchedCase searched_of(const WorstCaseFacts& facts) {
  const run::CasePlan& case_plan = facts.case_plan;
  const run::SceneData& data = facts.plan.scenes[case_plan.scene];
  const Vec2i viewport = facts.config.viewports[case_plan.viewport];
  return {.name = case_plan.name,
          .id = case_plan.id,
          .scene = data.scene.name,
          .sha256 = data.scene.sha256,
          .camera = data.paths[case_plan.camera].camera,
          .viewport = {static_cast<std::uint64_t>(viewport.x), static_cast<std::uint64_t>(viewport.y)},
          .grid = facts.config.grids[case_plan.grid].name(),
          .assigner = facts.config.assigners[case_plan.assigner].label(),
          .storage = run::storage_label(facts.config, case_plan),
          .settings = settings_of(facts)};
}

result::SearchSpace space_of(const WorstCase& found, const WorstCaseFacts& facts) {
  result::SearchSpace out{.eyes_m = box_of(found.eyes),
                          .directions = found.directions,
                          .moments = found.moments,
                          .lights = found.own_lights,
                          .added_ranges_m = facts.request.extra_ranges_m,
                          .added_within_m = box_of(found.lights),
                          .move_m = facts.request.move_m,
                          .flags = search::space_flags(facts.request)};
  if (facts.request.walkable)
    out.floor = result::Floor{found.floor_triangles, found.floor_area_m2, facts.request.eye_height_m};
  return out;
}

std::string measured_text(double value) {
  return text("%.10g", value);
}

std::string vector_text(Vec3d v) {
  for (int axis = 0; axis < 3; ++axis) v[axis] += 0.0;  // no "-0"
  return text("(%.4g", v.x) + text(", %.4g", v.y) + text(", %.4g)", v.z);
}

std::string line(std::string name, const std::string& rest) {
  constexpr std::size_t k_width = 13;
  name.resize(k_width, ' ');
  return "  " + name + rest + "\n";
}

std::string ratio_text(double value, double other) {
  return other > 0.0 ? text("; the worst frame has %.3g times as many", value / other) : std::string();
}

std::string frames_text(const WorstCase& found, const WorstCaseFacts& facts) {
  std::string out;
  for (std::size_t i = 0; i < found.frames.size(); ++i) {
    const search::FoundFrame& frame = found.frames[i];
    const search::FrameChoice& at = frame.choice;
    std::string rest = measured_text(frame.value) + " at " + vector_text(at.eye) + " m, looks along " +
                       vector_text(search::direction_of(at.rotation));
    if (found.moments > 1) rest += ", lights of moment " + std::to_string(at.moment);
    if (!at.moved.empty()) rest += ", " + number_of(at.moved.size(), "light") + " moved";
    out += line("frame " + std::to_string(i), rest);
    for (std::size_t k = 0; k < at.extra_lights.size(); ++k)
      out += line("", "added light at " + vector_text(at.extra_lights[k]) +
                          text(" m, range %g m", facts.request.extra_ranges_m[k]));
  }
  return out;
}

// Whether the figure found is less than that of a random frame.
bool is_random_one(const WorstCase& found) {
  return !found.stages.empty() && found.random.frames > 0 && found.random.max > found.stages.back().best;
}

}  // namespace

result::WorstCase worst_case_document(const WorstCase& found, const WorstCaseFacts& facts) {
  const search::Measure measure = facts.request.measure;
  const search::MeasureRow& row = search::row_of(measure);
  const std::vector<std::string> names = light_names(facts.plan.scenes[facts.case_plan.scene].scene);
  const auto count = [](int value) { return static_cast<std::uint64_t>(value); };
  result::WorstCase out{.schema_version = 1,
                        .kind = "worst-case",
                        .searched = searched_of(facts),
                        .other_cases = facts.plan.case_count() - 1,
                        .measure = {row.name, row.unit(), row.pointer},
                        .seed = facts.request.seed,
                        .evaluations = count(found.evaluations),
                        .evaluations_allowed = count(facts.request.evaluations),
                        .ended = name_of(found.ended),
                        .space = space_of(found, facts),
                        .recorded = {count(found.recorded.frames), figure_value(found.recorded.max, measure),
                                     count(found.recorded.frame)},
                        .buffers = std::vector<result::NeededBuffer>(),
                        .lights_in_view = result::LightsOfWorstFrame{found.lights_in_view, found.dark_in_view},
                        .warnings = found.warnings};
  for (const search::Stage& stage : found.stages)
    out.stages.push_back({stage.name, count(stage.evaluations), figure_value(stage.best, measure)});
  for (const search::FoundFrame& frame : found.frames) out.frames.push_back(frame_of(frame, facts, names));
  if (found.random.frames > 0)
    out.random =
        result::RandomFrames{count(found.random.frames), figure_value(found.random.max, measure), found.random.mean};
  if (found.theoretical_max) out.theoretical_max = figure_value(*found.theoretical_max, measure);
  for (const assign::BufferNeed& need : found.buffers)
    out.buffers->push_back({need.name, need.elements, need.most, need.element_bytes});
  if (!facts.scene_file.empty()) out.written = result::WrittenFrames{facts.scene_file, facts.config_file};
  return out;
}

std::string worst_case_text(const WorstCase& found, const WorstCaseFacts& facts) {
  const search::MeasureRow& row = search::row_of(facts.request.measure);
  std::string out = facts.case_plan.name + "\n";
  out += line("measure", std::string(row.name) + ": " + row.meaning);
  if (const std::size_t others = facts.plan.case_count() - 1; others > 0)
    out += line("others", number_of(others, "case") + " not searched; --filter chooses");
  if (const std::string flags = search::space_flags(facts.request); !flags.empty()) out += line("space", flags);
  if (found.frames.empty()) return out + line("worst", "nothing was tried");
  const double worst = std::ranges::max(found.frames, {}, &search::FoundFrame::value).value;
  out += line("worst", measured_text(worst) + " " + row.unit() + ", found in " +
                           number_of(static_cast<std::uint64_t>(found.evaluations), "evaluation") +
                           (is_random_one(found) ? " and the random frames" : "") + " (seed " +
                           std::to_string(facts.request.seed) + ")");
  if (found.random.frames > 0)
    out += line("random", measured_text(found.random.max) + " at most in " +
                              number_of(static_cast<std::uint64_t>(found.random.frames), "random frame") +
                              ratio_text(worst, found.random.max));
  out += line("recorded", measured_text(found.recorded.max) + " at most in " +
                              number_of(static_cast<std::uint64_t>(found.recorded.frames), "frame") +
                              " of the path (frame " + std::to_string(found.recorded.frame) + ")" +
                              ratio_text(worst, found.recorded.max));
  if (found.theoretical_max)
    out += line("theoretical", measured_text(*found.theoretical_max) +
                                   text("; the worst frame is %.3g %% of it",
                                        *found.theoretical_max > 0.0 ? 100.0 * worst / *found.theoretical_max : 0.0));
  out += frames_text(found, facts);
  for (const std::string& warning : found.warnings) out += line("warning", warning);
  if (found.ended == search::Ended::seconds)
    out += line("warning", "--seconds ended the search: the next one can end elsewhere");
  if (found.ended == search::Ended::device)
    out += line("warning", "the device ended the search: " + found.device_failure);
  if (!facts.config_file.empty())
    out += line("replay", "clusterbench run " + shell_command(std::vector<std::string>{facts.config_file}));
  return out;
}

}  // namespace clusterbench::report
