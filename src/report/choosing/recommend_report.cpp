#include "report/choosing/recommend_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <tuple>

#include "assign/contract/assigner.h"
#include "config/grid_json.h"
#include "core/error.h"
#include "core/text.h"
#include "measure/statistics/side_by_side.h"
#include "report/cases/case_costs.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/json_values.h"
#include "report/cases/nothing_seen.h"
#include "report/cases/sample_sets.h"
#include "report/cases/timing_warnings.h"
#include "report/sizing/list_code.h"
#include "result/at.h"
#include "result/case_figure.h"
#include "run/findings/gate.h"
#include "run/records/records.h"
#include "run/scene_facts.h"
#include "scene/digests.h"

namespace clusterbench::report {
namespace {

using Json = nlohmann::ordered_json;
using result::Case;
using result::Cost;
using result::Figure;
using result::SampleSet;
using result::SampleSets;

// Lights that no surface of the path needs may be needed by moving objects.
constexpr const char* k_unlit_in_view = "volume.unlit";
std::vector<Case> records_of(std::span<const run::CaseResult> cases, const Json& config) {
  std::vector<Case> out;
  for (const run::CaseResult& case_result : cases) out.push_back(run::record_of(case_result));
  add_costs(out, config);
  return out;
}

// Whether a broken constraint stays broken with more frames: marks and counts only grow, and a share above 0 stays
// above 0.
bool stays_broken(const config::LimitRule& rule) {
  const Figure& figure = *result::figure_named(rule.figure);
  return figure.only_grows || (rule.limit == 0.0 && !figure.rests_on_times());
}

// The largest figure that breaks a constraint; none if it holds. A given constraint on a figure that a case does not
// have (a structure without lists has no longest one) is not satisfied: NaN.
std::optional<double> breaking_figure(const std::vector<Case>& cases, const Constraint& constraint) {
  std::optional<double> largest;
  for (const Case& result_case : cases) {
    const std::optional<double> value = figure_of(result_case, constraint.rule.figure);
    if (!value && constraint.is_given) return std::numeric_limits<double>::quiet_NaN();
    if (!constraint.is_given && constraint.rule.figure == k_unlit_in_view &&
        ranking_set_names(result_case) == std::vector<std::string>{"volume"})
      continue;
    if (value && constraint.rule.is_broken_by(*value)) largest = std::max(*value, largest.value_or(*value));
  }
  return largest;
}

// Whether a run would fail for it, or it is cheaper because it misses lights.
bool fails(const std::vector<Case>& cases, bool is_cost) {
  return std::ranges::any_of(cases, [&](const Case& result_case) {
    return !result_case.failures.empty() || (is_cost && result_case.cost && !result_case.cost->lit);
  });
}

std::string rule_text_of(const config::LimitRule& rule) {
  if (rule.limit == 0.0 && !rule.is_inclusive) return rule.figure + " = 0";
  return rule.figure + (rule.is_inclusive ? " < " : " <= ") + amount_text(rule.limit);
}

// If the question allows lost lights, methods that can lose lights are allowed.
bool takes_sound_methods_only(const Question& question) {
  return std::ranges::none_of(question.constraints, [](const Constraint& constraint) {
    return constraint.is_given && constraint.rule.figure == "unlit";
  });
}

bool rests_on_samples(const Figure& objective) {
  return objective.is_modelled_cost || objective.is_at_samples();
}

// Methods that draw lights have no lists whose size, time or reads could be compared: only costs of pixels rank them.
bool takes_what_draws(const Question& question) {
  return rests_on_samples(*question.objective) && question.objective->name != "read_bytes";
}

// The question's constraints; then four fixed ones.
std::vector<std::string> constraint_texts(const Question& question) {
  std::vector<std::string> texts;
  for (const Constraint& constraint : question.constraints) texts.push_back(rule_text_of(constraint.rule));
  texts.emplace_back("a run of it does not fail");
  texts.emplace_back("conservative or exact (--unlit allows others)");
  texts.emplace_back("has lists (methods that draw lights are ranked by cost alone)");
  texts.emplace_back("a known " + std::string(question.objective->name) + " on these frames");
  return texts;
}

// A finalist with the figures that rank it.
struct Ranked {
  std::size_t candidate = 0;
  std::vector<Case> cases;
  double objective = 0.0, bytes = 0.0;
  std::uint64_t cells = 0;
  std::vector<std::size_t> broken;
  bool is_apart = false;

  bool is_feasible() const { return broken.empty() && std::isfinite(objective); }
  // Among equal candidates the smallest is chosen; those that light only opaque surfaces come last.
  auto smaller() const {
    const bool is_limited = is_at_surfaces(cases[0].assigner.name);
    return std::tuple(is_limited, bytes, cells, candidate);
  }
};

// Frame times of all cameras as one: round by round their mean, weighted by frames.
run::Contender pooled(const std::vector<Case>& cases, RankBy by) {
  run::Contender all = contender_of(cases[0], by);
  std::vector<double> sum(all.rounds_ns.size(), 0.0);
  double frames = 0.0;
  for (const Case& result_case : cases) {
    const run::Contender contender = contender_of(result_case, by);
    if (contender.rounds_ns.size() != sum.size()) return {};
    const auto weight = static_cast<double>(result_case.frames);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * contender.rounds_ns[i];
    frames += weight;
  }
  for (double& ns : sum) ns /= frames;
  all.rounds_ns = std::move(sum);
  all.grid = result::to_json(cases[0].grid).dump();
  return all;
}

// The modelled cost of a frame: mean over all cameras, weighted by frames.
measure::FrameCost cost_over(const std::vector<Case>& cases) {
  const auto mean = [&](std::optional<double> (*figure)(const Case&)) {
    double sum = 0.0, frames = 0.0;
    for (const Case& result_case : cases) {
      const auto weight = static_cast<double>(result_case.frames);
      sum += weight * figure(result_case).value_or(0.0);
      frames += weight;
    }
    return sum / frames;
  };
  return {mean(result::number<&Case::cost, &Cost::assign_ns>), mean(result::number<&Case::cost, &Cost::upload_ns>),
          mean(result::number<&Case::cost, &Cost::traffic_ns>), mean(result::number<&Case::cost, &Cost::read_ns>),
          mean(result::number<&Case::cost, &Cost::shade_ns>)};
}

// The ratio of two times, if the objective is a time with rounds.
std::optional<measure::Ratio> ratio_of(const Ranked& a, const Ranked& b, const Question& question, std::uint64_t seed) {
  const std::string_view figure = question.objective->name;
  if ((figure != "frame_us" && figure != "frame_cost_us") || a.candidate == b.candidate) return {};
  const RankBy by = figure == "frame_us" ? RankBy::frame_time : RankBy::frame_cost;
  return run::ratio_between(pooled(a.cases, by), pooled(b.cases, by), seed);
}

// Candidates with is_apart come last.
std::vector<Ranked> ranked(const config::Config& config, const search::View& view, const search::Found& found) {
  const Json resolved = config.resolved;
  std::vector<Ranked> all;
  for (const search::Finalist& finalist : found.finalists) {
    const search::Verdict& verdict = found.records[finalist.candidate].verdict;
    all.push_back({finalist.candidate, records_of(finalist.cases, resolved), verdict.objective, verdict.bytes,
                   view.candidates[finalist.candidate].cells, verdict.broken,
                   view.candidates[finalist.candidate].is_apart});
  }
  std::ranges::stable_sort(all, [](const Ranked& a, const Ranked& b) {
    if (a.is_apart != b.is_apart) return b.is_apart;
    if (a.is_feasible() != b.is_feasible()) return a.is_feasible();
    if (a.objective != b.objective && a.is_feasible()) return a.objective < b.objective;
    return a.smaller() < b.smaller();
  });
  return all;
}

// Whether `a` is worse than `b` for certain: by more than the precision of the model for a cost; by the interval for
// times, or without one by more than their usual variation.
bool is_known_worse(const Ranked& a, const Ranked& b, const Question& question, std::uint64_t seed) {
  const std::optional<measure::Ratio> ratio = ratio_of(a, b, question, seed);
  const bool has_interval = ratio && std::isfinite(ratio->ci95.low) && std::isfinite(ratio->ci95.high);
  const double times_as_much = ratio ? ratio->ratio : a.objective / b.objective;
  const bool is_by_ratio =
      question.objective->is_modelled_cost || (question.objective->rests_on_times() && !has_interval);
  if (is_by_ratio && times_as_much <= measure::k_alike_ratio) return false;
  return has_interval ? measure::takes_longer(ratio) : a.objective > b.objective;
}

// Moves the smallest candidate that no other beats for certain to the front, so that neither noise nor imprecision of
// the model decides.
void choose(std::vector<Ranked>& all, const Question& question, std::uint64_t seed) {
  const auto end = std::ranges::find_if_not(all, &Ranked::is_feasible);
  const auto is_beaten = [&](const Ranked& one) {
    return std::any_of(all.begin(), end, [&](const Ranked& other) {
      return &other != &one && is_known_worse(one, other, question, seed);
    });
  };
  auto choice = end;
  for (auto one = all.begin(); one != end; ++one)
    if (!is_beaten(*one) && (choice == end || one->smaller() < choice->smaller())) choice = one;
  if (choice != end) std::rotate(all.begin(), choice, choice + 1);
}

Json method_json(const config::MethodRequest& request) {
  Json out{{"name", request.name}};
  for (const auto& [name, value] : request.params.values())
    out[name] = std::visit([](const auto& number) { return Json(number); }, value);
  return out;
}

// Whether it differs from another in cells only, which its method then does not use.
bool is_repeated(const Json& record, const Json& other) {
  return record["assigner"] == other["assigner"] && record["storage"] == other["storage"] &&
         record["precision"] == other["precision"] &&
         std::ranges::all_of(objective_figures(), [&](const Figure* figure) {
           const std::string name(figure->name);
           return figure->rests_on_times() ||
                  record["figures"].value(name, Json()) == other["figures"].value(name, Json());
         });
}

// What a configuration needs of a candidate.
Json parts_json(const config::Config& config, const search::View& view, const search::Candidate& candidate) {
  const run::CasePlan& plan = *candidate.cases.front();
  const config::PrecisionRequest& precision = config.precisions[plan.precision];
  Json packing{{"packing", view::packing_name(precision.packing)}};
  if (precision.is_lossy()) packing["inflate"] = precision.inflate;
  Json ids = Json::array();
  for (std::size_t i = 0; i < view.cameras.size(); ++i) ids.push_back(candidate.cases[i]->id);
  return {{"name", candidate.name},
          {"ids", ids},
          {"grid", config::grid_request(config.grids[plan.grid])},
          {"cells", candidate.cells},
          {"assigner", method_json(config.assigners[plan.assigner])},
          {"storage", plan.storage ? method_json(config.storages[*plan.storage]) : Json()},
          {"precision", packing}};
}

Json interval_json(const measure::Interval& interval) {
  return {number_or_null(interval.low), number_or_null(interval.high)};
}

Json ranked_json(const config::Config& config, const search::View& view, const Ranked& ranked, const Ranked& choice,
                 const Question& question) {
  Json out = parts_json(config, view, view.candidates[ranked.candidate]);
  out["objective"] = number_or_null(ranked.objective);
  out["by_choice"] = number_or_null(ranked.objective / choice.objective);
  if (const std::optional<measure::Ratio> ratio = ratio_of(ranked, choice, question, config.seed)) {
    out["by_choice"] = six_digits(ratio->ratio);
    out["ci95"] = {six_digits(ratio->ci95.low), six_digits(ratio->ci95.high)};
  }
  if (question.objective->is_modelled_cost && ranked.objective > choice.objective)
    out["by_prices"] =
        interval_json(measure::around(out["by_choice"].get<double>(), ranked.objective / choice.objective,
                                      measure::ratio_by_prices(cost_over(ranked.cases), cost_over(choice.cases))));
  Json figures = Json::object();
  for (const Figure* figure : objective_figures()) {
    const std::string name(figure->name);
    if (const std::optional<double> value = result::figure_over(ranked.cases, name))
      figures[name] = figure->rests_on_times() ? six_digits(*value) : number_or_null(*value);
  }
  out["figures"] = figures;
  const std::optional<double> overshade = result::figure_over(ranked.cases, "overshade");
  out["overshade"] = overshade ? number_or_null(*overshade) : Json();
  return out;
}

// Lights that reach the samples of the cost, over all cameras.
double needed_over(const std::vector<Case>& cases) {
  double needed = 0.0;
  for (const Case& result_case : cases) needed += sum_at_samples(result_case, result::number<&SampleSet::needed>);
  return needed;
}

// Reasons to doubt the times of all ranked candidates.
std::vector<std::string> doubts_of(const std::vector<Ranked>& all) {
  std::vector<Case> cases;
  for (const Ranked& ranked : all)
    if (ranked.is_feasible()) cases.insert(cases.end(), ranked.cases.begin(), ranked.cases.end());
  return timing_doubts(cases, "leave times out (--no-timing)");
}

// Over all cameras: a light that one of them sees is a basis for a choice. A scene of dark lights alone is reported
// before candidates are rejected because of it.
std::string why_nothing_is_seen(const search::Found& found, const config::Config& config, const scene::Scene& scene,
                                const Question& question) {
  const auto lights = static_cast<int>(std::ranges::count_if(scene.lights, [](const scene::Light& light) {
    return light.type == scene::LightType::point || light.type == scene::LightType::spot;
  }));
  if (lights > 0 && scene.boxes.empty() && scene::count_dark_lights(scene).all == lights) return k_all_lights_dark;
  std::vector<Case> all;
  for (const search::Finalist& finalist : found.finalists)
    std::ranges::move(records_of(finalist.cases, config.resolved), std::back_inserter(all));
  std::vector<const Case*> cases;
  for (const Case& one : all) cases.push_back(&one);
  return why_nothing_is_seen(cases, rests_on_samples(*question.objective) ? RankedBy::samples : RankedBy::no_samples);
}

// The best behind the choice. Of those that differ in cells only, which their method then does not use, the first.
Json runners_up_json(const config::Config& config, const search::View& view, const std::vector<Ranked>& all,
                     const Question& question) {
  Json told = Json::array({ranked_json(config, view, all[0], all[0], question)});
  for (std::size_t i = 1; i < all.size() && all[i].is_feasible(); ++i) {
    if (told.size() > static_cast<std::size_t>(question.runners_up)) break;
    const Json record = ranked_json(config, view, all[i], all[0], question);
    if (std::ranges::none_of(told, [&](const Json& other) { return is_repeated(record, other); }))
      told.push_back(record);
  }
  told.erase(0);
  return told;
}

// The candidates that one constraint excludes.
struct Excluded {
  std::size_t count = 0, alone = 0;    // alone: by this constraint only
  std::optional<std::size_t> best;     // by the objective, compared with the best on the same frames
  std::optional<std::size_t> nearest;  // closest to satisfying it
  double nearest_figure = 0.0;
};

Excluded excluded_by(std::size_t constraint, const search::View& view, const search::Found& found) {
  // Candidates not measured on the frames of the best accepted one come last. Those whose samples search a structure
  // are never compared with lists.
  const auto by_best = [&](std::size_t index) {
    const double by = found.records[index].by_best;
    return std::tuple(view.candidates[index].is_apart, std::isnan(by), std::isnan(by) ? 0.0 : by);
  };
  Excluded excluded;
  for (std::size_t i = 0; i < found.records.size(); ++i) {
    const search::Verdict& verdict = found.records[i].verdict;
    const auto at = std::ranges::find(verdict.broken, constraint);
    if (at == verdict.broken.end()) continue;
    ++excluded.count;
    excluded.alone += verdict.broken.size() == 1 ? 1 : 0;
    if (!excluded.best || by_best(i) < by_best(*excluded.best)) excluded.best = i;
    const double figure = verdict.broken_by[static_cast<std::size_t>(at - verdict.broken.begin())];
    if (std::isnan(figure) || (excluded.nearest && excluded.nearest_figure <= figure)) continue;
    excluded.nearest = i;
    excluded.nearest_figure = figure;
  }
  return excluded;
}

Json excluded_json(const search::View& view, const search::Found& found, const Question& question) {
  const std::vector<std::string> texts = constraint_texts(question);
  Json out = Json::array();
  for (std::size_t constraint = 0; constraint < texts.size(); ++constraint) {
    const Excluded excluded = excluded_by(constraint, view, found);
    const bool is_given = constraint < question.constraints.size() && question.constraints[constraint].is_given;
    Json row{{"constraint", texts[constraint]}, {"given", is_given},  {"excluded", excluded.count},
             {"alone", excluded.alone},         {"nearest", nullptr}, {"best", nullptr}};
    if (excluded.nearest)
      row["nearest"] = {{"name", view.candidates[*excluded.nearest].name},
                        {"figure", number_or_null(excluded.nearest_figure)},
                        {"frames", found.records[*excluded.nearest].frames}};
    if (excluded.best) {
      const search::Record& best = found.records[*excluded.best];
      const bool is_comparable = !view.candidates[*excluded.best].is_apart ||
                                 std::ranges::all_of(view.candidates, &search::Candidate::is_apart);
      row["best"] = {{"name", view.candidates[*excluded.best].name},
                     {"objective", number_or_null(best.verdict.objective)},
                     {"by_best", is_comparable ? number_or_null(best.by_best) : Json()},
                     {"frames", best.frames}};
    }
    out.push_back(row);
  }
  return out;
}

Json work_json(const search::Work& work) {
  const auto share = [](double some, double all) { return number_or_null(all > 0.0 ? some / all : 0.0); };
  return {
      {"measurements", work.measurements},
      {"evaluations", work.evaluations},
      {"all_evaluations", work.all_evaluations},
      {"evaluations_share", share(static_cast<double>(work.evaluations), static_cast<double>(work.all_evaluations))},
      {"tests", number_or_null(work.tests)},
      {"all_tests", number_or_null(work.all_tests)},
      {"tests_share", share(work.tests, work.all_tests)}};
}

Json rungs_json(const std::vector<search::Rung>& rungs) {
  Json out = Json::array();
  for (const search::Rung& rung : rungs)
    out.push_back(
        {{"frames", rung.frames}, {"candidates", rung.candidates}, {"excluded", rung.out}, {"kept", rung.kept}});
  return out;
}

// The configuration's entry of a scene, which can stand for several.
Json scene_json(const config::Config& config, std::size_t scene, const std::string& file) {
  namespace fs = std::filesystem;
  const config::SceneRequest& request = config.scenes[scene];
  const Json resolved = config.resolved["scenes"];
  std::size_t first = 0;
  Json entry;
  for (const Json& candidate : resolved) {
    std::size_t count = candidate.contains("paths") ? candidate["paths"].size() : 1;
    if (candidate.contains("rig"))
      for (const auto& [key, value] : candidate["rig"].items())
        if (value.is_array() && !(key == "size" && value[0].is_number())) count *= value.size();
    if (scene < first + count) {
      entry = candidate;
      break;
    }
    first += count;
  }
  entry.erase("paths");
  if (request.rig) {
    const scene::RigSpec& rig = *request.rig;
    entry["rig"] = {{"lights", rig.lights},
                    {"spots", rig.spots},
                    {"range", rig.range_m},
                    {"size", {rig.size_m.x, rig.size_m.y, rig.size_m.z}},
                    {"seed", rig.seed}};
    return entry;
  }
  const fs::path folder = fs::absolute(file).parent_path();
  entry["path"] = fs::absolute(request.path).lexically_normal().lexically_proximate(folder.lexically_normal()).string();
  return entry;
}

void add_once(Json& list, const Json& entry) {
  if (!entry.is_null() && std::ranges::find(list, entry) == list.end()) list.push_back(entry);
}

}  // namespace

std::vector<const Figure*> objective_figures() {
  std::vector<const Figure*> all;
  for (const Figure& figure : result::figures())
    if (figure.is_choosable) all.push_back(&figure);
  return all;
}

std::vector<Constraint> constraints_of(const std::vector<config::LimitRule>& given) {
  std::vector<Constraint> all;
  for (const config::LimitRule& rule : given) all.push_back({rule, true});
  const auto is_given = [&](const std::string& figure) {
    return std::ranges::find(given, figure, &config::LimitRule::figure) != given.end();
  };
  for (const char* figure : {"missed", "dropped", "unlit"})
    if (!is_given(figure)) all.push_back({{figure, false, 0.0}, false});
  if (!is_given("unlit") && !is_given(k_unlit_in_view)) all.push_back({{k_unlit_in_view, false, 0.0}, false});
  return all;
}

bool needs_times(const Figure& objective, const std::vector<Constraint>& constraints) {
  return objective.rests_on_times() || std::ranges::any_of(constraints, [](const Constraint& constraint) {
           return result::figure_named(constraint.rule.figure)->rests_on_times();
         });
}

search::Evaluate judge_of(const Question& question, const nlohmann::json& config) {
  return [question, resolved = Json(config)](std::span<const run::CaseResult> results) {
    const std::vector<Case> cases = records_of(results, resolved);
    search::Verdict verdict;
    verdict.objective = result::figure_over(cases, std::string(question.objective->name))
                            .value_or(std::numeric_limits<double>::quiet_NaN());
    verdict.bytes = result::figure_over(cases, "bytes").value_or(0.0);
    for (std::size_t i = 0; i < question.constraints.size(); ++i) {
      const config::LimitRule& rule = question.constraints[i].rule;
      const std::optional<double> by = breaking_figure(cases, question.constraints[i]);
      if (!by) continue;
      verdict.broken.push_back(i);
      verdict.broken_by.push_back(*by);
      verdict.is_final = verdict.is_final || stays_broken(rule);
    }
    const auto break_by_no_figure = [&](std::size_t constraint) {
      verdict.broken.push_back(constraint);
      verdict.broken_by.push_back(std::numeric_limits<double>::quiet_NaN());
    };
    if (verdict.broken.empty() && fails(cases, question.objective->is_modelled_cost))
      break_by_no_figure(question.constraints.size());
    if (takes_sound_methods_only(question) && !std::ranges::all_of(results, run::is_sound)) {
      break_by_no_figure(question.constraints.size() + 1);
      verdict.is_final = true;
    }
    if (!takes_what_draws(question) && std::ranges::any_of(cases, draws_lights)) {
      break_by_no_figure(question.constraints.size() + 2);
      verdict.is_final = true;
    }
    if (verdict.broken.empty() && !std::isfinite(verdict.objective))
      break_by_no_figure(question.constraints.size() + 3);
    return verdict;
  };
}

Json answer_to_json(const config::Config& config, const run::Plan& plan, const search::View& view,
                    const search::Found& found, const Question& question) {
  std::vector<Ranked> all = ranked(config, view, found);
  const std::vector<Ranked> apart(std::ranges::find(all, true, &Ranked::is_apart), all.end());
  all.resize(all.size() - apart.size());
  choose(all, question, config.seed);
  const run::SceneData& data = plan.scenes[view.scene];
  const std::string unseen = why_nothing_is_seen(found, config, data.scene, question);
  const bool has_choice = unseen.empty() && !all.empty() && all.front().is_feasible();
  const Vec2i viewport = config.viewports[view.viewport];
  Json cameras = Json::array();
  for (const std::size_t camera : view.cameras) cameras.push_back(data.paths[camera].camera);
  Json blind = Json::array();
  for (const std::size_t camera : view.blind) blind.push_back(data.paths[camera].camera);
  Json out{{"scene", data.scene.name},
           {"sha256", data.scene.sha256},
           {"cameras", cameras},
           {"blind_cameras", blind},
           {"viewport", {viewport.x, viewport.y}},
           {"frames", view.frames},
           {"lights", data.scene.lights.size()},
           {"candidates", view.candidates.size()},
           {"incomplete", view.incomplete},
           {"samples", Json::array()},
           {"random_depths", false},
           {"ground_m", nullptr},
           {"needed_at_samples", nullptr},
           {"no_reader", nullptr},
           {"nothing_seen", unseen.empty() ? Json() : Json(unseen)},
           {"timing_doubts", doubts_of(all)},
           {"choice", nullptr},
           {"runners_up", Json::array()},
           {"searched", Json::array()},
           {"within", question.within},
           {"coarsest", nullptr}};
  if (has_choice) {
    out["choice"] = ranked_json(config, view, all[0], all[0], question);
    double best = all[0].objective;
    const Ranked* coarsest = &all[0];
    for (const Ranked& ranked : all)
      if (ranked.is_feasible()) best = std::min(best, ranked.objective);
    for (const Ranked& ranked : all)
      if (ranked.is_feasible() && ranked.objective <= best * (1.0 + question.within) && ranked.cells < coarsest->cells)
        coarsest = &ranked;
    if (coarsest != &all[0]) out["coarsest"] = ranked_json(config, view, *coarsest, all[0], question);
    out["runners_up"] = runners_up_json(config, view, all, question);
    if (const auto height = result::number<&Case::samples, &SampleSets::opaque, &SampleSet::ground_m>(all[0].cases[0]))
      out["ground_m"] = result::number_json(*height, false);
    if (const std::string why = why_no_reader(all[0].cases); !why.empty()) out["no_reader"] = why;
    if (question.objective->is_modelled_cost) out["needed_at_samples"] = needed_over(all[0].cases);
    out["samples"] = ranking_set_names(all[0].cases[0]);
    out["random_depths"] = rests_on_samples(*question.objective) && ranks_at_random_depths(all[0].cases[0]);
  }
  const Ranked* best = has_choice ? &all[0] : nullptr;
  for (const Ranked& ranked : apart) {
    if (!unseen.empty() || !ranked.is_feasible()) continue;
    if (best == nullptr) best = &ranked;
    if (!has_choice) out["samples"] = ranking_set_names(ranked.cases[0]);
    out["searched"].push_back(ranked_json(config, view, ranked, *best, question));
  }
  out["constraints"] = excluded_json(view, found, question);
  out["rungs"] = rungs_json(found.rungs);
  out["finalists"] = found.finalists.size();
  out["challengers"] = found.challengers;
  out["work"] = work_json(found.work);
  return out;
}

Json recommendation_to_json(const config::Config& config, const Question& question, const Json& answers) {
  const Figure& objective = *question.objective;
  return {{"recommendation_version", k_recommendation_version},
          {"name", config.name},
          {"tool", result::to_json(run::record_of(run::tool_facts()))},
          {"machine", result::to_json(run::record_of(run::machine_facts()))},
          {"config", config.resolved},
          {"objective",
           {{"figure", objective.name}, {"meaning", objective.meaning}, {"timed", objective.rests_on_times()}}},
          {"answers", answers}};
}

bool all_satisfied(const Json& recommendation) {
  return std::ranges::none_of(recommendation["answers"], [](const Json& answer) { return answer["choice"].is_null(); });
}

Json recommended_config(const config::Config& config, const search::View& view, const Json& answer,
                        const Question& question, int runners_up, const std::string& file) {
  if (answer["choice"].is_null())
    throw Error(file, "", "is not written: no candidate satisfies all constraints", ExitCode::gate_failed);
  Json out = config.resolved;
  out["scenes"] = Json::array({scene_json(config, view.scene, file)});
  out["viewports"] = Json::array({answer["viewport"]});
  for (const char* key : {"presets", "as_shipped"}) out.erase(key);
  for (const char* key : {"grids", "assigners", "storages", "precision"}) out[key] = Json::array();
  for (int i = 0; i <= runners_up && i <= static_cast<int>(answer["runners_up"].size()); ++i) {
    const Json& record = i == 0 ? answer["choice"] : answer["runners_up"][static_cast<std::size_t>(i) - 1];
    add_once(out["grids"], record["grid"]);
    add_once(out["assigners"], record["assigner"]);
    add_once(out["storages"], record["storage"]);
    add_once(out["precision"], record["precision"]);
  }
  if (out["storages"].empty()) out["storages"].push_back("packed");  // of lists, which it may have besides
  // Of a method that leaves lists and a structure of its own only the choice has to hold.
  const assign::AssignerDescriptor& method =
      *assign::find_assigner(answer["choice"]["assigner"]["name"].get<std::string>());
  const bool has_others = method.answers(assign::Answer::lists) && method.answers(assign::Answer::structure);
  const std::string only_choice = has_others ? answer["choice"]["name"].get<std::string>() + ": " : "";
  Json budgets = Json::array();
  for (const Constraint& constraint : question.constraints)
    if (constraint.is_given)
      budgets.push_back(only_choice + constraint.rule.figure + (constraint.rule.is_inclusive ? " >= " : " > ") +
                        Json(constraint.rule.limit).dump());
  out["limits"]["fail_if"] = budgets;
  return out;
}

}  // namespace clusterbench::report
