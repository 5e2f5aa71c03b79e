#include "report/result_json.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>

#include "report/conclusion.h"
#include "report/contender.h"
#include "report/details_json.h"
#include "report/fit_json.h"
#include "report/frame_cost.h"
#include "report/json_values.h"
#include "report/machine.h"
#include "report/nothing_seen.h"
#include "report/preset_ranking.h"
#include "report/reaction_json.h"
#include "report/sample_sets.h"
#include "report/shadows_json.h"
#include "run/gate.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;

double to_digits(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

Json to_json(const measure::Spread& spread) {
  return {{"mean", number_or_null(spread.mean)},
          {"p50", number_or_null(spread.p50)},
          {"p95", number_or_null(spread.p95)},
          {"p99", number_or_null(spread.p99)},
          {"max", number_or_null(spread.max)}};
}

Json to_json(const measure::Interval& interval) {
  return {six_digits(interval.low), six_digits(interval.high)};
}

Json to_json(const measure::TimeStats& stats) {
  Json samples = Json::array();
  for (const double sample : stats.samples) samples.push_back(six_digits(sample));
  return {{"median", six_digits(stats.median)}, {"mad", six_digits(stats.mad)}, {"min", six_digits(stats.min)},
          {"p95", six_digits(stats.p95)},       {"ci95", to_json(stats.ci95)},  {"samples", samples}};
}

Json to_json(const measure::HighWater& mark) {
  return {
      {"high_water", mark.high_water}, {"theoretical_max", mark.theoretical_max}, {"recommended", mark.recommended}};
}

// Cell index as [x, y, z].
Json cell_coordinates(std::uint32_t cell, const run::CaseResult& of, int frame) {
  const Vec3i cells = run::cells_in(of, frame);
  const auto nx = static_cast<std::uint32_t>(cells.x), ny = static_cast<std::uint32_t>(cells.y);
  return {cell % nx, cell / nx % ny, cell / nx / ny};
}

Json to_json(const measure::LightsInView& lights) {
  return {{"mean", number_or_null(lights.mean())},
          {"max", lights.most},
          {"frames_at_max", lights.frames_with_most},
          {"worst_frame", lights.worst_frame},
          {"max_by_type",
           {{"point", lights.most_of_type[0]}, {"spot", lights.most_of_type[1]}, {"box", lights.most_of_type[2]}}}};
}

Json camera_path(const run::CameraPathFacts& path) {
  Json out{{"from_s", number_or_null(path.from_s)}, {"to_s", number_or_null(path.to_s)}};
  if (!path.digest.empty()) out["digest"] = path.digest;
  return out;
}

Json occupancy(const run::CaseResult& case_result) {
  const measure::Occupancy& o = *case_result.occupancy;
  Json lights = to_json(o.lights_per_cell);
  const measure::Histogram histogram = measure::short_histogram(o.histogram);
  lights["histogram"] = {{"lights_per_entry", histogram.lights_per_entry}, {"cells", histogram.cells}};
  Json out{{"pairs", to_json(o.pairs)},
           {"lights_per_cell", lights},
           {"occupied_fraction", to_json(o.occupied_fraction)},
           {"worst_frame", o.worst_frame},
           {"worst_cell", cell_coordinates(o.worst_cell, case_result, o.worst_frame)},
           {"along_path",
            {{"frames_per_entry", o.pairs_along_path.frames_per_entry()},
             {"pairs", o.pairs_along_path.entries()},
             {"longest_list", o.longest_along_path.entries()}}}};
  if (!o.longest_by_slice.empty()) out["longest_by_slice"] = o.longest_by_slice;
  return out;
}

// Along the path only where frames differ: of the others high_water says all.
Json buffer(const measure::BufferHighWater& mark, const run::CaseResult& of) {
  Json out{{"name", mark.name},
           {"element_bytes", mark.element_bytes},
           {"step", mark.step},
           {"high_water", mark.high_water},
           {"theoretical_max", mark.theoretical_max},
           {"worst_frame", mark.worst_frame}};
  if (mark.worst_cell) out["worst_cell"] = cell_coordinates(*mark.worst_cell, of, mark.worst_frame);
  const std::vector<std::uint64_t>& along = mark.along_path.entries();
  if (std::ranges::any_of(along, [&](std::uint64_t elements) { return elements != mark.high_water; }))
    out["along_path"] = {{"frames_per_entry", mark.along_path.frames_per_entry()}, {"elements", along}};
  return out;
}

Json buffers(const run::CaseResult& case_result) {
  const measure::Buffers& b = case_result.buffers;
  Json out{{"index_entries", to_json(b.index_entries)},
           {"bytes", to_json(b.bytes)},
           {"index_bits", b.index_bits},
           {"header_bytes", b.header_bytes},
           {"upload_bytes", {{"mean", number_or_null(b.upload_bytes_mean)}, {"max", b.upload_bytes_max}}},
           {"used_share", {{"mean", number_or_null(b.in_use_mean)}, {"max", number_or_null(b.in_use_max)}}},
           {"overflow",
            {{"dropped_pairs", b.dropped_pairs},
             {"cells", b.overflowing_cells},
             {"frames", b.overflowing_frames},
             {"lights", b.dropped_lights}}},
           {"scratch_bytes", b.scratch_bytes},
           {"worst_frame", b.worst_frame}};
  if (b.traffic_bytes_max > 0)
    out["traffic_bytes"] = {{"mean", number_or_null(b.traffic_bytes_mean)}, {"max", b.traffic_bytes_max}};
  if (b.worst_cell) out["worst_cell"] = cell_coordinates(*b.worst_cell, case_result, b.worst_frame);
  out["along_path"] = {{"frames_per_entry", b.bytes_along_path.frames_per_entry()},
                       {"bytes", b.bytes_along_path.entries()}};
  out["each"] = Json::array();
  for (const measure::BufferHighWater& mark : b.each) out["each"].push_back(buffer(mark, case_result));
  return out;
}

Json error(const run::CaseResult& case_result) {
  const measure::ErrorCounts& e = *case_result.error;
  Json out{{"true_pairs", e.true_pairs},
           {"reported_pairs", e.reported_pairs},
           {"false_positives", e.false_positives},
           {"false_negatives", e.false_negatives},
           {"excess_ratio", number_or_null(e.excess_ratio())},
           {"miss_ratio", number_or_null(e.miss_ratio())},
           {"deepest_miss", number_or_null(e.deepest_miss)},
           {"undecided", e.undecided},
           {"frames_checked", e.frames_checked},
           {"decided", {{"filter", e.filter_decided}, {"exact", e.exact_decided}}}};
  if (e.deepest)
    out["deepest"] = {{"frame", e.deepest->frame},
                      {"cell", cell_coordinates(e.deepest->cell, case_result, e.deepest->frame)},
                      {"light", e.deepest->light},
                      {"rig_light", e.deepest->rig_index},
                      {"light_name", case_result.deepest_miss_light}};
  return out;
}

Json shading(const measure::ShadingCounts& s) {
  Json out{{"samples", s.samples},
           {"unanswered", s.unanswered},
           {"evaluated", s.evaluated},
           {"needed", s.needed},
           {"missed", s.missed},
           {"missed_in_cells", s.missed - s.missed_outside},
           {"missed_outside", s.missed_outside},
           {"unlit", number_or_null(s.unlit())},
           {"lost_irradiance", s.needed == 0 ? Json() : number_or_null(s.lost_irradiance())},
           {"lost_lux", number_or_null(s.lost_lux / static_cast<double>(s.samples))},
           {"overshade", number_or_null(s.comparable_overshade())},
           {"reads", s.reads.elements},
           {"read_bytes", s.reads.bytes}};
  if (s.worst)
    out["worst_frame"] = {{"frame", s.worst->frame}, {"missed", s.worst->missed}, {"needed", s.worst->needed}};
  if (!s.darkest) return out;
  out["darkest"] = {{"frame", s.darkest->frame}, {"lost_lux", number_or_null(s.darkest->lost_lux)}};
  if (std::isfinite(s.darkest->pixel_x) && std::isfinite(s.darkest->pixel_y))
    out["darkest"]["pixel"] = {number_or_null(static_cast<double>(s.darkest->pixel_x)),
                               number_or_null(static_cast<double>(s.darkest->pixel_y))};
  return out;
}

Json to_json(const measure::WaveCounts& waves) {
  const auto per_wave = [&](double sum) { return number_or_null(sum / static_cast<double>(waves.waves)); };
  return {{"lanes", waves.lanes()},
          {"waves", waves.waves},
          {"distinct_lists", {{"mean", number_or_null(waves.mean_distinct())}, {"max", waves.most_distinct}}},
          {"mean_list", per_wave(waves.mean)},
          {"longest_list", per_wave(static_cast<double>(waves.longest))},
          {"united_lists", per_wave(static_cast<double>(waves.united))},
          {"divergence", number_or_null(waves.divergence())},
          {"scalarised", number_or_null(waves.scalarised())}};
}

// By the set's name.
Json samples(const std::vector<run::SampleSetResult>& sets) {
  Json out = Json::object();
  for (const run::SampleSetResult& set : sets) {
    Json& set_json = out[measure::name_of(set.set)] = shading(set.counts);
    if (set.ground_m) set_json["ground_m"] = number_or_null(*set.ground_m);
    if (!set.coherence) continue;
    set_json["waves"] = Json::array();
    for (const measure::WaveCounts& waves : set.coherence->sizes) set_json["waves"].push_back(to_json(waves));
  }
  return out;
}

Json to_json(const measure::LengthDistribution& lengths) {
  return {{"mean", six_digits(lengths.mean_m())},
          {"p50", six_digits(lengths.quantile_m(0.5))},
          {"p90", six_digits(lengths.quantile_m(0.9))},
          {"p99", six_digits(lengths.quantile_m(0.99))},
          {"max", six_digits(lengths.max_m())}};
}

Json to_json(const measure::DepthRanges::Tiles& tiles) {
  Json out{{"tiles", tiles.tiles}, {"pixels", tiles.pixels}};
  for (std::size_t i = 0; i < measure::k_list_kind_count; ++i)
    out[measure::name_of(static_cast<measure::ListKind>(i))] = to_json(tiles.lengths[i]);
  return out;
}

Json depth_ranges(const measure::DepthRanges& ranges) {
  return {{"slopes", to_json(ranges.slopes)},
          {"discontinuities", to_json(ranges.discontinuities)},
          {"outside", ranges.outside}};
}

Json to_json(const measure::Churn& churn) {
  return {{"total", churn.changes}, {"mean", number_or_null(churn.mean_changes())}, {"max", churn.most_changes}};
}

Json lookup(const std::vector<measure::LookupCounts>& all) {
  Json out = Json::array();
  for (const measure::LookupCounts& counts : all)
    out.push_back({{"logarithm", measure::name_of(counts.way.logarithm)},
                   {"depth", measure::name_of(counts.way.depth)},
                   {"samples", counts.samples},
                   {"needed", counts.needed},
                   {"missed", counts.missed},
                   {"wrong_samples", counts.wrong_samples},
                   {"safe_padding_ulps", counts.safe_padding_ulps}});
  return out;
}

Json stability(const run::StabilityResult& s) {
  const auto difference = [](std::uint64_t a, std::uint64_t b) {
    return static_cast<std::int64_t>(a) - static_cast<std::int64_t>(b);
  };
  return {{"steps", s.method.steps},
          {"step_m", number_or_null(s.step_m)},
          {"step_deg", number_or_null(s.step_deg)},
          {"window", s.window},
          {"from_frame", s.from_frame},
          {"drift", s.is_drift},
          {"path", s.path},
          {"grids", s.grids},
          {"changed", {{"method", to_json(s.method)}, {"truth", to_json(s.truth)}}},
          {"flickers", {{"method", s.method.flickers}, {"truth", s.truth.flickers}}},
          {"excess_churn",
           {{"pairs", difference(s.method.changes, s.truth.changes)},
            {"ratio", number_or_null(measure::excess_ratio(s.method.changes, s.truth.changes))}}},
          {"excess_flickers",
           {{"count", difference(s.method.flickers, s.truth.flickers)},
            {"ratio", number_or_null(measure::excess_ratio(s.method.flickers, s.truth.flickers))}}},
          {"undecided", s.undecided}};
}

Json to_json(const measure::MeanMax& error) {
  return {{"mean", number_or_null(error.mean)}, {"max", number_or_null(error.max)}};
}

Json precision(const run::PrecisionResult& p) {
  const measure::PackingLoss& loss = p.loss;
  return {{"packing", p.packing},
          {"inflate", p.inflate},
          {"label", p.label},
          {"position_error_m", to_json(loss.position_error_m)},
          {"range_error_m", to_json(loss.range_error_m)},
          {"axis_error_rad", to_json(loss.axis_error_rad)},
          {"angle_error_rad", to_json(loss.angle_error_rad)},
          {"safe_inflation_m", to_json(loss.safe_inflation_m)},
          {"unrepresentable", {{"lights", loss.unrepresentable_lights}, {"frames", loss.unrepresentable_frames}}}};
}

// `is_timed`: what is not timed is the same in every run.
Json pre_cull(const run::PreCullResult& p, bool is_timed) {
  const run::PreCullCounts& counts = p.counts;
  Json steps = Json::array(), samples = Json::object();
  for (const run::PreCullCounts::Step& step : counts.steps)
    steps.push_back({{"label", step.label}, {"removed", to_json(step.removed)}, {"frames", step.frames}});
  for (const run::LostAtSamples& set : counts.samples)
    if (set.is_asked) samples[measure::name_of(set.set)] = {{"needed", set.needed}, {"lost", set.lost}};
  Json out{{"label", p.label},
           {"conservative", counts.conservative},
           {"kept", to_json(counts.kept)},
           {"removed", to_json(counts.removed)},
           {"distant", to_json(counts.distant)},
           {"steps", steps},
           {"lost_pairs", counts.lost_pairs},
           {"lost_at_samples", samples},
           {"view_cells", counts.view_cells},
           {"bytes", counts.bytes}};
  const bool has_limit = std::ranges::any_of(counts.steps, [](const auto& step) { return step.limit.has_value(); });
  if (has_limit) out["over_limit"] = {{"lights", counts.dropped}, {"lost_pairs", counts.lost_to_limits}};
  if (is_timed) out["build_ns"] = six_digits(counts.build_ns);
  return out;
}

Json timing(const run::TimingResult& t) {
  Json out{
      {"frames_timed", t.frames_timed},
      {"caches", t.is_cold ? "cold" : "warm"},
      {"session", t.session},
      {"launches", t.launches},
      {"frame_ns", to_json(t.frame_ns)},
      {"worst_frame", {{"frame", t.worst.frame}, {"ns", six_digits(t.worst.ns)}, {"ci95", to_json(t.worst.ci95)}}}};
  if (t.worst.pairs) out["worst_frame"]["pairs"] = *t.worst.pairs;
  if (t.pairs_mean) out["pairs"] = {{"mean", number_or_null(*t.pairs_mean)}, {"max", t.pairs_max}};
  out["builds_per_frame"] = t.builds_per_frame;
  out["build_ns"] = to_json(t.build_ns);
  out["assign_ns"] = to_json(t.assign_ns);
  if (t.convert_ns) out["convert_ns"] = to_json(*t.convert_ns);
  if (t.pre_cull_ns) out["pre_cull_ns"] = to_json(*t.pre_cull_ns);
  if (t.device)
    out["device"] = {{"upload_ns", to_json(t.device->upload_ns)},
                     {"run_ns", to_json(t.device->run_ns)},
                     {"readback_ns", to_json(t.device->readback_ns)}};
  if (t.warm) {
    out["warm"] = {{"frame_ns", to_json(t.warm->frame_ns)}, {"assign_ns", to_json(t.warm->assign_ns)}};
    if (t.warm->convert_ns) out["warm"]["convert_ns"] = to_json(*t.warm->convert_ns);
    if (t.warm->pre_cull_ns) out["warm"]["pre_cull_ns"] = to_json(*t.warm->pre_cull_ns);
  }
  out["passes_per_sample"] = {{"assign", t.warm_assign_passes}};
  if (t.warm_convert_passes) out["passes_per_sample"]["convert"] = *t.warm_convert_passes;
  out["ns_per_pair"] = six_digits(t.ns_per_pair);
  out["write_floor_ns"] = six_digits(t.write_floor_ns);
  out["floor_ratio"] = six_digits(t.floor_ratio);
  if (t.against_first)
    out["against_first"] = {{"assigner", t.against_first->assigner},
                            {"ratio", six_digits(t.against_first->ratio.ratio)},
                            {"ci95", to_json(t.against_first->ratio.ci95)}};
  if (t.fit)
    out["fit"] = {{"follow_ns", to_json(t.fit->follow_ns)},
                  {"unfitted_ns", to_json(t.fit->unfitted_ns)},
                  {"ratio", six_digits(t.fit->ratio.ratio)},
                  {"ci95", to_json(t.fit->ratio.ci95)}};
  if (!t.shadow_culls.empty()) out["shadow_cull"] = shadow_times_to_json(t.shadow_culls);
  const run::Disturbance& d = t.disturbance;
  const auto cores = [&](double busy_s) { return six_digits(d.seconds > 0.0 ? busy_s / d.seconds : 0.0); };
  out["disturbed"] = {
      {"others_cores", cores(d.others_s)}, {"stolen_cores", cores(d.stolen_s)}, {"throttled", d.throttled}};
  return out;
}

Json count(const run::CountResult& c) {
  const auto per_frame = [&](std::uint64_t all) { return static_cast<double>(all) / c.frames; };
  Json out{{"source", c.source},
           {"simd_target", c.simd_target},
           {"frames", c.frames},
           {"instructions_per_build", c.build.instructions},
           {"instructions_per_frame", {{"assign", per_frame(c.assign.instructions)}}}};
  if (c.convert) out["instructions_per_frame"]["convert"] = per_frame(c.convert->instructions);
  if (c.pre_cull) out["instructions_per_frame"]["pre_cull"] = per_frame(c.pre_cull->instructions);
  std::uint64_t all = c.assign.instructions;
  for (const std::optional<run::Counted>& part : {c.convert, c.pre_cull}) all += part ? part->instructions : 0;
  out["instructions_per_frame"]["frame"] = per_frame(all);
  if (!c.assign.cycles || (c.convert && !c.convert->cycles)) return out;
  out["cycles_per_frame"] = {{"assign", per_frame(*c.assign.cycles)}};
  if (c.convert) out["cycles_per_frame"]["convert"] = per_frame(*c.convert->cycles);
  return out;
}

// Pairs per frame against the same case in float32; null where there is none.
void add_extra_pairs(Json& cases) {
  std::map<std::string, double> pairs;
  for (const Json& result_case : cases)
    pairs[result_case["name"].get<std::string>()] =
        number_at(result_case, "/occupancy/pairs/mean").value_or(std::nan(""));
  for (Json& result_case : cases) {
    if (!result_case.contains("precision")) continue;
    const std::string name = result_case["name"], label = "/" + result_case["precision"]["label"].get<std::string>();
    const bool is_packed = result_case["precision"]["packing"] != "float32";
    const auto plain = pairs.find(is_packed ? name.substr(0, name.size() - label.size()) : name);
    const double mean = plain == pairs.end() ? std::nan("") : plain->second, extra = pairs[name] - mean;
    result_case["precision"]["extra_pairs"] = {{"mean", number_or_null(extra)},
                                               {"ratio", number_or_null(extra / mean)}};
  }
}

Json in_plan_order(const run::Result& result, const std::vector<Json>& earlier_cases) {
  std::map<std::string, Json> by_id;
  for (const Json& result_case : earlier_cases) by_id[result_case.at("id").get<std::string>()] = result_case;
  for (const run::CaseResult& case_result : result.cases) by_id[case_result.id] = case_to_json(case_result);
  Json cases = Json::array();
  for (const std::string& id : result.planned_ids)
    if (const auto found = by_id.find(id); found != by_id.end()) cases.push_back(found->second);
  return cases;
}

}  // namespace

Json six_digits(double value) {
  return number_or_null(to_digits(value, 6));
}

Json fronts(const Json& scenes, const Json& cases, const Json& origin) {
  std::vector<run::Contender> all;
  std::set<std::string> unknown = ids_of_nothing_seen(cases);
  unknown.merge(ids_without_samples(cases));
  for (const Json& result_case : cases)
    if (!unknown.contains(result_case["id"].get<std::string>()))
      all.push_back(contender_of(result_case, rank_by(origin)));
  const std::vector<std::string> ids = run::on_front(all, seed_of(origin));
  const std::set<std::string> best(ids.begin(), ids.end());
  Json list = Json::array();
  for (const Json& scene : scenes) {
    Json front = Json::array();
    for (const Json& result_case : cases)
      if (result_case["scene"] == scene["name"] && best.contains(result_case["id"].get<std::string>()))
        front.push_back(result_case["id"]);
    list.push_back({{"scene", scene["name"]}, {"ids", front}});
  }
  return list;
}

void add_presets(Json& result, const Json& origin) {
  Json facts = preset_facts(result["cases"], result["skipped"]);
  if (facts.empty()) return;
  Json rankings = preset_rankings(result["scenes"], result["cases"], origin);
  result["presets"] = std::move(facts);
  result["preset_rankings"] = std::move(rankings);
}

Json tool_to_json(const run::ToolFacts& tool) {
  Json libraries = Json::object();
  for (const auto& [name, version] : tool.libraries) libraries[name] = version;
  return {{"version", tool.version}, {"git_sha", tool.git_sha},       {"compiler", tool.compiler},
          {"flags", tool.flags},     {"build_type", tool.build_type}, {"simd_target", tool.simd_target},
          {"libraries", libraries}};
}

Json scene_to_json(const run::SceneResult& scene) {
  Json out{{"name", scene.name},
           {"sha256", scene.sha256},
           {"lights",
            {{"point", scene.points},
             {"spot", scene.spots},
             {"directional", scene.directionals},
             {"box", scene.boxes},
             {"dark", scene.dark}}},
           {"light_digest", scene.light_digest},
           {"frames", scene.frames},
           {"range_rule", scene.range_rule},
           {"warnings", scene.warnings}};
  if (!scene.rig.is_null()) out["rig"] = scene.rig;
  return out;
}

Json case_to_json(const run::CaseResult& case_result) {
  Json out{{"id", case_result.id},
           {"settings", case_result.settings},
           {"name", case_result.name},
           {"scene", case_result.scene},
           {"camera", case_result.camera},
           {"camera_path", camera_path(case_result.camera_path)},
           {"viewport", {case_result.viewport.x, case_result.viewport.y}},
           {"frames", case_result.frames},
           {"grid", case_result.grid},
           {"assigner",
            {{"name", case_result.assigner},
             {"label", case_result.assigner_label},
             {"params", case_result.assigner_params},
             {"conservative", case_result.conservative},
             {"exact", case_result.exact}}},
           {"storage", case_result.storage_label}};
  if (samples_search(out)) out["samples_search"] = true;
  if (!case_result.preset.empty()) out["preset"] = case_result.preset;
  out.update(Json{{"failures", Json::array()},
                  {"warnings", Json::array()},
                  {"loses_lights", run::loses_lights(case_result)},
                  {"eligible", run::is_eligible(case_result)},
                  {"tests_done", case_result.tests_done},
                  {"fallbacks", case_result.fallbacks}});
  for (const run::Failure& failure : case_result.failures)
    out["failures"].push_back({{"kind", run::name_of(failure.kind)}, {"text", failure.text}});
  for (const run::Warning& warning : run::warnings_of(case_result))
    out["warnings"].push_back({{"kind", run::name_of(warning.kind)}, {"text", warning.text}});
  if (case_result.lights_in_view.frames > 0) {
    out["lights"] = case_result.lights;
    out["lights_lit"] = case_result.lights_in_view.lit();
    out["lights_seen"] = case_result.lights_in_view.seen();
    out["lights_in_view"] = to_json(case_result.lights_in_view);
  }
  if (case_result.lights_beyond_grid)
    out["lights_beyond_grid"] = {{"max", case_result.lights_beyond_grid->most},
                                 {"frames", case_result.lights_beyond_grid->frames}};
  if (case_result.occupancy) out["occupancy"] = occupancy(case_result);
  out["buffers"] = buffers(case_result);
  if (case_result.error) out["error"] = error(case_result);
  if (case_result.cells_not_compared > 0) out["cells_not_compared"] = case_result.cells_not_compared;
  if (case_result.shading) out["shading"] = shading(*case_result.shading);
  if (!case_result.samples.empty()) out["samples"] = samples(case_result.samples);
  if (case_result.depth_ranges) out["depth_ranges"] = depth_ranges(*case_result.depth_ranges);
  if (!case_result.lookup.empty()) out["lookup"] = lookup(case_result.lookup);
  if (case_result.stability) out["stability"] = stability(*case_result.stability);
  if (case_result.precision) out["precision"] = precision(*case_result.precision);
  if (case_result.pre_cull) out["pre_cull"] = pre_cull(*case_result.pre_cull, case_result.timing.has_value());
  if (case_result.fit) out["fit"] = fit_to_json(*case_result.fit);
  if (case_result.reaction) out["react"] = reaction_to_json(*case_result.reaction);
  if (case_result.fallback) out["fallback"] = fallback_to_json(*case_result.fallback);
  if (Json shadows = shadows_to_json(case_result); !shadows.empty()) out["shadows"] = std::move(shadows);
  if (case_result.timing) out["timing"] = timing(*case_result.timing);
  if (case_result.count) out["count"] = count(*case_result.count);
  if (case_result.details) out["details"] = details_to_json(*case_result.details);
  return out;
}

Json result_to_json(const run::Result& result, const std::vector<Json>& earlier_cases) {
  Json out{{"schema_version", k_schema_version}, {"name", result.config_name}};
  if (!result.date.empty()) out["date"] = result.date;
  if (!result.command.empty()) out["command"] = result.command;
  out["tool"] = tool_to_json(result.tool);
  out["machine"] = machine_to_json(result.machine);
  out["config"] = result.config;
  out["scenes"] = Json::array();
  for (const run::SceneResult& scene : result.scenes) out["scenes"].push_back(scene_to_json(scene));
  out["cases"] = in_plan_order(result, earlier_cases);
  add_extra_pairs(out["cases"]);
  add_costs(out["cases"], out["config"]);
  out["pareto_front"] = fronts(out["scenes"], out["cases"], out);
  out["skipped"] = Json::array();
  for (const run::Skipped& skipped : result.skipped) {
    out["skipped"].push_back({{"name", skipped.name}, {"reason", skipped.reason}});
    if (!skipped.preset.empty()) out["skipped"].back()["preset"] = skipped.preset;
  }
  add_presets(out, out);
  out["conclusions"] = conclusions_of(out, out);
  conclude_failures(out, {});
  return out;
}

std::vector<std::string> gate_failures(const Json& result) {
  std::vector<std::string> lines;
  for (const Json& result_case : result["cases"])
    for (const Json& failure : result_case["failures"])
      lines.push_back(result_case["name"].get<std::string>() + ": " + failure["text"].get<std::string>());
  return lines;
}

// Nine digits: what is counted stands beside it exactly.
Json number_or_null(double value) {
  constexpr double k_exact_integers = 9007199254740992.0;
  if (!std::isfinite(value)) return nullptr;
  if (std::floor(value) == value && std::abs(value) < k_exact_integers) return static_cast<std::int64_t>(value);
  return to_digits(value, 9);
}

}  // namespace clusterbench::report
