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
#include "report/cases/case_samples.h"
#include "report/cases/columns.h"
#include "report/cases/contender.h"
#include "report/cases/nothing_seen.h"
#include "report/cases/timing_warnings.h"
#include "report/choosing/answer_conclusion.h"
#include "report/shader_code/list_code.h"
#include "result/at.h"
#include "result/figures/case_figure.h"
#include "result/rounding.h"
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
bool is_repeated(const result::Candidate& record, const result::Candidate& other) {
  return record.assigner == other.assigner && record.storage == other.storage && record.precision == other.precision &&
         std::ranges::all_of(objective_figures(), [&](const Figure* figure) {
           const std::string name(figure->name);
           return figure->rests_on_times() || candidate_figure(record, name) == candidate_figure(other, name);
         });
}

// The settings of a candidate that a configuration needs.
result::Candidate configured_parts(const config::Config& config, const search::View& view,
                                   const search::Candidate& candidate) {
  const run::CasePlan& plan = *candidate.cases.front();
  const config::PrecisionRequest& precision = config.precisions[plan.precision];
  Json packing{{"packing", view::packing_name(precision.packing)}};
  if (precision.is_lossy()) packing["inflate"] = precision.inflate;
  result::Candidate out{.name = candidate.name,
                        .grid = config::grid_request(config.grids[plan.grid]),
                        .cells = candidate.cells,
                        .assigner = method_json(config.assigners[plan.assigner]),
                        .storage = plan.storage ? method_json(config.storages[*plan.storage]) : Json(),
                        .precision = packing};
  for (std::size_t i = 0; i < view.cameras.size(); ++i) out.ids.push_back(candidate.cases[i]->id);
  return out;
}

result::Candidate candidate_of(const config::Config& config, const search::View& view, const Ranked& ranked,
                               const Ranked& choice, const Question& question) {
  result::Candidate out = configured_parts(config, view, view.candidates[ranked.candidate]);
  out.objective = result::counted(ranked.objective);
  out.by_choice = result::counted(ranked.objective / choice.objective);
  if (const std::optional<measure::Ratio> ratio = ratio_of(ranked, choice, question, config.seed)) {
    out.by_choice = result::measured(ratio->ratio);
    out.ci95 = {result::measured(ratio->ci95.low), result::measured(ratio->ci95.high)};
  }
  if (question.objective->is_modelled_cost && ranked.objective > choice.objective) {
    const measure::Interval by_prices =
        measure::around(out.by_choice, ranked.objective / choice.objective,
                        measure::ratio_by_prices(cost_over(ranked.cases), cost_over(choice.cases)));
    out.by_prices = {result::counted(by_prices.low), result::counted(by_prices.high)};
  }
  for (const Figure* figure : objective_figures()) {
    const std::string name(figure->name);
    if (const std::optional<double> value = result::figure_over(ranked.cases, name))
      out.figures.emplace_back(name, figure->rests_on_times() ? result::measured(*value) : result::counted(*value));
  }
  out.overshade = result::counted(result::figure_over(ranked.cases, "overshade").value_or(result::k_none));
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

// "evaluated is not known, since no pixel sees a surface": a given limit that nothing can satisfy. "" if there is none.
std::string why_a_limit_is_unknown(const std::vector<const Case*>& cases, const Question& question) {
  for (const auto& [rule, is_given] : question.constraints) {
    if (!is_given) continue;
    const std::string why = is_loss(*result::figure_named(rule.figure)) ? why_no_sets(cases, rule.figure)
                                                                        : why_no_samples(cases, rule.figure);
    if (!why.empty()) return rule.figure + " is not known, since " + why;
  }
  return "";
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
  const RankedBy by = rests_on_samples(*question.objective) ? RankedBy::samples : RankedBy::no_samples;
  const std::string why = why_nothing_is_seen(cases, by);
  return why.empty() ? why_a_limit_is_unknown(cases, question) : why;
}

// The best behind the choice. Of those that differ in cells only, which their method then does not use, the first.
std::vector<result::Candidate> runners_up_of(const config::Config& config, const search::View& view,
                                             const std::vector<Ranked>& all, const Question& question) {
  std::vector<result::Candidate> told{candidate_of(config, view, all[0], all[0], question)};
  for (std::size_t i = 1; i < all.size() && all[i].is_feasible(); ++i) {
    if (told.size() > static_cast<std::size_t>(question.runners_up)) break;
    const result::Candidate record = candidate_of(config, view, all[i], all[0], question);
    if (std::ranges::none_of(told, [&](const result::Candidate& other) { return is_repeated(record, other); }))
      told.push_back(record);
  }
  told.erase(told.begin());
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

std::vector<result::ConstraintOfAnswer> constraints_of_answer(const search::View& view, const search::Found& found,
                                                              const Question& question) {
  const std::vector<std::string> texts = constraint_texts(question);
  std::vector<result::ConstraintOfAnswer> out;
  for (std::size_t constraint = 0; constraint < texts.size(); ++constraint) {
    const Excluded excluded = excluded_by(constraint, view, found);
    const bool is_given = constraint < question.constraints.size() && question.constraints[constraint].is_given;
    result::ConstraintOfAnswer row{
        .constraint = texts[constraint], .given = is_given, .excluded = excluded.count, .alone = excluded.alone};
    if (excluded.nearest)
      row.nearest =
          result::NearestRejected{view.candidates[*excluded.nearest].name, result::counted(excluded.nearest_figure),
                                  found.records[*excluded.nearest].frames};
    if (excluded.best) {
      const search::Record& best = found.records[*excluded.best];
      const bool is_comparable = !view.candidates[*excluded.best].is_apart ||
                                 std::ranges::all_of(view.candidates, &search::Candidate::is_apart);
      row.best = result::BestRejected{view.candidates[*excluded.best].name, result::counted(best.verdict.objective),
                                      is_comparable ? result::counted(best.by_best) : result::k_none, best.frames};
    }
    out.push_back(row);
  }
  return out;
}

// Candidates that were measured on some frames only and can satisfy all constraints on more.
std::size_t provisional(const search::View& view, const search::Found& found, const Question& question) {
  return static_cast<std::size_t>(std::ranges::count_if(found.records, [&](const search::Record& record) {
    return record.frames < view.frames && may_hold_on_more_frames(question, record.verdict);
  }));
}

result::SearchWork work_of(const search::Work& work) {
  const auto share = [](double some, double all) { return result::counted(all > 0.0 ? some / all : 0.0); };
  return {.measurements = work.measurements,
          .evaluations = work.evaluations,
          .all_evaluations = work.all_evaluations,
          .evaluations_share = share(static_cast<double>(work.evaluations), static_cast<double>(work.all_evaluations)),
          .tests = result::counted(work.tests),
          .all_tests = result::counted(work.all_tests),
          .tests_share = share(work.tests, work.all_tests)};
}

// An answer's question, and how much was measured for it.
result::Answer asked_of(const config::Config& config, const run::SceneData& data, const search::View& view,
                        const search::Found& found, const Question& question) {
  const Vec2i viewport = config.viewports[view.viewport];
  result::Answer out{.scene = data.scene.name,
                     .sha256 = data.scene.sha256,
                     .viewport = {static_cast<std::uint64_t>(viewport.x), static_cast<std::uint64_t>(viewport.y)},
                     .frames = view.frames,
                     .lights = data.scene.lights.size(),
                     .candidates = view.candidates.size(),
                     .incomplete = view.incomplete,
                     .within = question.within,
                     .constraints = constraints_of_answer(view, found, question),
                     .finalists = found.finalists.size(),
                     .challengers = found.challengers,
                     .work = work_of(found.work)};
  for (const std::size_t camera : view.cameras) out.cameras.push_back(data.paths[camera].camera);
  for (const std::size_t camera : view.blind) out.blind_cameras.push_back(data.paths[camera].camera);
  for (const search::Rung& rung : found.rungs) out.rungs.push_back({rung.frames, rung.candidates, rung.out, rung.kept});
  return out;
}

// The first of all is the choice.
void add_choice(result::Answer& out, const config::Config& config, const search::View& view,
                const std::vector<Ranked>& all, const Question& question) {
  const Ranked& choice = all[0];
  out.choice = candidate_of(config, view, choice, choice, question);
  double best = choice.objective;
  const Ranked* coarsest = &choice;
  for (const Ranked& ranked : all)
    if (ranked.is_feasible()) best = std::min(best, ranked.objective);
  for (const Ranked& ranked : all)
    if (ranked.is_feasible() && ranked.objective <= best * (1.0 + question.within) && ranked.cells < coarsest->cells)
      coarsest = &ranked;
  if (coarsest != &choice) out.coarsest = candidate_of(config, view, *coarsest, choice, question);
  out.runners_up = runners_up_of(config, view, all, question);
  out.ground_m = result::number<&Case::samples, &SampleSets::opaque, &SampleSet::ground_m>(choice.cases[0])
                     .value_or(result::k_none);
  if (const std::string why = why_no_reader(choice.cases); !why.empty()) out.no_reader = why;
  if (question.objective->is_modelled_cost) out.needed_at_samples = needed_over(choice.cases);
  out.samples = ranking_set_names(choice.cases[0]);
  out.random_depths = rests_on_samples(*question.objective) && ranks_at_random_depths(choice.cases[0]);
}

}  // namespace

result::Answer answer_of(const config::Config& config, const run::Plan& plan, const search::View& view,
                         const search::Found& found, const Question& question) {
  std::vector<Ranked> all = ranked(config, view, found);
  const std::vector<Ranked> apart(std::ranges::find(all, true, &Ranked::is_apart), all.end());
  all.resize(all.size() - apart.size());
  choose(all, question, config.seed);
  const run::SceneData& data = plan.scenes[view.scene];
  const std::string unseen = why_nothing_is_seen(found, config, data.scene, question);
  const bool has_choice = unseen.empty() && !all.empty() && all.front().is_feasible();
  result::Answer out = asked_of(config, data, view, found, question);
  if (!unseen.empty()) out.nothing_seen = unseen;
  if (unseen.empty() && !has_choice) out.provisional = provisional(view, found, question);
  out.timing_doubts = doubts_of(all);
  if (has_choice) add_choice(out, config, view, all, question);
  const Ranked* best = has_choice ? &all[0] : nullptr;
  for (const Ranked& ranked : apart) {
    if (!unseen.empty() || !ranked.is_feasible()) continue;
    if (best == nullptr) best = &ranked;
    if (!has_choice) out.samples = ranking_set_names(ranked.cases[0]);
    out.searched.push_back(candidate_of(config, view, ranked, *best, question));
  }
  return out;
}

result::Recommendation recommendation_of(const config::Config& config, const Question& question,
                                         const std::vector<result::Answer>& answers) {
  const Figure& objective = *question.objective;
  return {.recommendation_version = 1,
          .name = config.name,
          .tool = run::record_of(run::tool_facts()),
          .machine = run::record_of(run::machine_facts()),
          .config = config.resolved,
          .objective = {std::string(objective.name), std::string(objective.meaning), objective.rests_on_times()},
          .answers = answers};
}

bool all_satisfied(const result::Recommendation& recommendation) {
  return std::ranges::all_of(recommendation.answers, [](const result::Answer& answer) { return bool(answer.choice); });
}

}  // namespace clusterbench::report
