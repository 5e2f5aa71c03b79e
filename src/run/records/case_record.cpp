#include <cmath>

#include "assign/contract/assigner.h"
#include "run/cases/case_names.h"
#include "run/cases/case_plan.h"
#include "run/findings/gate.h"
#include "run/records/parts.h"

namespace clusterbench::run {
namespace {

using result::counted;

std::optional<std::string> known(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

result::Method method_record(const CaseResult& found) {
  return {found.assigner,
          found.assigner_label,
          result::Json(found.assigner_params),
          found.conservative,
          found.exact,
          found.on_device ? std::optional(true) : std::nullopt,
          known(found.origin_file),
          known(found.origin_sha256)};
}

// Whether samples search a structure of the method's own.
bool samples_search(const CaseResult& found) {
  const assign::AssignerDescriptor* method = assign::find_assigner(found.assigner);
  return found.storage_label == k_own_structure && method != nullptr && method->own_is_searched();
}

result::LightsInView lights_in_view_record(const measure::LightsInView& lights) {
  const auto& [points, spots, boxes] = lights.most_of_type;
  return {counted(lights.mean()),
          static_cast<std::uint64_t>(lights.most),
          static_cast<std::uint64_t>(lights.frames_with_most),
          static_cast<std::uint64_t>(lights.worst_frame),
          {static_cast<std::uint64_t>(points), static_cast<std::uint64_t>(spots), static_cast<std::uint64_t>(boxes)},
          counted(lights.shining_mean())};
}

void add_verdict(result::Case& out, const CaseResult& found) {
  for (const Failure& failure : found.failures) out.failures.push_back({name_of(failure.kind), failure.text});
  for (const Warning& warning : warnings_of(found)) out.warnings.push_back({name_of(warning.kind), warning.text});
  out.loses_lights = loses_lights(found);
  out.eligible = is_eligible(found);
}

void add_lights(result::Case& out, const CaseResult& found) {
  if (found.lights_in_view.frames > 0) {
    out.lights = static_cast<std::uint64_t>(found.lights);
    out.lights_lit = static_cast<std::uint64_t>(found.lights_in_view.lit());
    out.lights_seen = static_cast<std::uint64_t>(found.lights_in_view.seen());
    out.lights_in_view = lights_in_view_record(found.lights_in_view);
  }
  if (found.lights_beyond_grid)
    out.lights_beyond_grid = {static_cast<std::uint64_t>(found.lights_beyond_grid->most),
                              static_cast<std::uint64_t>(found.lights_beyond_grid->frames)};
}

void add_parts(result::Case& out, const CaseResult& found) {
  if (found.occupancy) out.occupancy = occupancy_record(found);
  out.buffers = buffers_record(found);
  if (found.error) out.error = error_record(found);
  if (found.cells_not_compared > 0) out.cells_not_compared = found.cells_not_compared;
  if (found.shading) out.shading = samples_record(*found.shading);
  if (!found.samples.empty()) out.samples = samples_record(found.samples);
  if (found.depth_ranges) out.depth_ranges = depth_ranges_record(*found.depth_ranges);
  if (!found.lookup.empty()) out.lookup = lookup_record(found.lookup);
  if (found.stability) out.stability = stability_record(*found.stability);
  if (found.precision) out.precision = precision_record(*found.precision);
  if (found.pre_cull) out.pre_cull = pre_cull_record(*found.pre_cull, found.timing.has_value());
  if (found.fit) out.fit = fit_record(*found.fit);
  if (found.reaction) out.react = reaction_record(*found.reaction);
  if (found.fallback) out.fallback = fallback_record(*found.fallback);
  out.shadows = shadows_record(found);
  if (found.timing) out.timing = timing_record(*found.timing);
  if (found.device) out.device = device_record(*found.device);
  if (found.reading) out.reading = reading_record(*found.reading);
  if (!found.unread.empty()) out.unread = found.unread;
  if (found.count) out.count = count_record(*found.count);
  if (found.details) out.details = details_record(*found.details);
}

}  // namespace

result::Case record_of(const CaseResult& found) {
  result::Case out;
  out.id = found.id;
  out.settings = found.settings;
  out.name = found.name;
  out.scene = found.scene;
  out.camera = found.camera;
  out.camera_path = {counted(found.camera_path.from_s), counted(found.camera_path.to_s),
                     known(found.camera_path.digest)};
  out.viewport = {static_cast<std::uint64_t>(found.viewport.x), static_cast<std::uint64_t>(found.viewport.y)};
  out.frames = static_cast<std::uint64_t>(found.frames);
  out.grid = result::from_json<result::Grid>(result::Json(found.grid));
  out.assigner = method_record(found);
  out.storage = found.storage_label;
  if (samples_search(found)) out.samples_search = true;
  out.preset = known(found.preset);
  add_verdict(out, found);
  out.tests_done = found.tests_done;
  out.fallbacks = found.fallbacks;
  add_lights(out, found);
  add_parts(out, found);
  return out;
}

result::Scene record_of(const SceneResult& scene) {
  const auto count = [](int lights) { return static_cast<std::uint64_t>(lights); };
  result::Scene out;
  out.name = scene.name;
  out.sha256 = scene.sha256;
  out.lights = {count(scene.points), count(scene.spots), count(scene.directionals), count(scene.boxes),
                count(scene.dark)};
  out.light_digest = scene.light_digest;
  out.frames = count(scene.frames);
  out.range_rule = result::from_json<result::RangeRule>(result::Json(scene.range_rule));
  out.warnings = scene.warnings;
  if (!scene.rig.is_null()) out.rig = result::from_json<result::Rig>(result::Json(scene.rig));
  return out;
}

result::Tool record_of(const ToolFacts& tool) {
  return {tool.version, tool.git_sha, tool.compiler, tool.flags, tool.build_type, tool.simd_target, tool.libraries};
}

result::Plugin record_of(const plugin::LoadedPlugin& loaded) {
  const plugin::PluginFacts& facts = loaded.facts;
  return {facts.id,      facts.name,
          facts.version, loaded.file.filename().string(),
          loaded.sha256, std::to_string(CLUSTERBENCH_PLUGIN_MAJOR) + "." + std::to_string(facts.minor)};
}

result::DeviceArithmetic record_of(const gpu::Arithmetic& found) {
  const char* const roundings[] = {"to_nearest", "either_way", "wrong"};
  return {roundings[static_cast<std::size_t>(found.rounding)],
          found.contracts,
          found.reorders,
          found.flushes_denormals,
          result::measured(found.division_ulp),
          result::measured(found.sqrt_ulp),
          result::measured(found.log2_ulp),
          result::measured(found.log2_error)};
}

result::Device record_of(const gpu::DeviceFacts& device) {
  return {device.name,
          device.driver,
          device.vulkan,
          device.uuid,
          gpu::type_name(device.type),
          device.max_buffer_bytes,
          device.max_group_size,
          device.shared_bytes,
          device.subgroup_size,
          device.timestamp_bits,
          device.timestamp_period_ns,
          device.rounds_to_nearest,
          std::nullopt};
}

result::Machine record_of(const MachineFacts& machine) {
  result::Machine out;
  out.cpu = machine.cpu;
  out.family = known(machine.family);
  out.model = known(machine.model);
  out.stepping = known(machine.stepping);
  if (!machine.caches.empty()) out.caches = machine.caches;
  out.cores = static_cast<std::uint64_t>(machine.cores);
  out.ram_bytes = machine.ram_bytes;
  if (machine.clock) {
    out.clock_mhz = {std::round(machine.clock->now_mhz), {}};
    if (machine.clock->most_mhz) out.clock_mhz->max = std::round(*machine.clock->most_mhz);
  }
  if (machine.load) out.load = {machine.load->begin, machine.load->end};
  out.os = machine.os;
  out.host = known(machine.host);
  return out;
}

result::Shard record_of(const PlannedShard& shard) {
  result::Shard out{shard.index, shard.count, shard.sweep, known(shard.filter), {}, 0, {}};
  if (!shard.baseline_file.empty()) out.baseline = {shard.baseline_file, shard.baseline_sha256};
  return out;
}

}  // namespace clusterbench::run
