// What lists say, and that they depend on a frame and its grid alone.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "acceptance/acceptance_test.h"
#include "measure/truth/list_errors.h"

namespace clusterbench::acceptance {
namespace {

// Compares with the exact truth what the method promises.
void compare_with_truth(const Subject& subject, const SubjectFrame& frame, const assign::Lists& lists,
                        Findings& findings) {
  const stress::StressMethod method = subject.with_defaults();
  if (!method.conservative) return;
  measure::ErrorCounts counts;
  measure::add_frame(counts, frame.frame, frame.grid, measure::find_truth(frame.frame, frame.grid, 1), lists);
  if (counts.false_negatives > 0)
    findings.fault(frame.label + ": says that it is conservative, and " + std::to_string(counts.false_negatives) +
                   " of " + std::to_string(counts.true_pairs) + " true pairs are missing; light " +
                   std::to_string(counts.deepest ? counts.deepest->light : 0) + " in cell " +
                   std::to_string(counts.deepest ? counts.deepest->cell : 0) + " deepest");
  if (method.assigner->exact && counts.false_positives > 0)
    findings.fault(frame.label + ": says that it is exact, and lists " + std::to_string(counts.false_positives) +
                   " pairs that are not true");
}

void list_every_kind(const Subject& subject, Findings& findings) {
  std::vector<SubjectFrame> frames = ordinary_frames(subject);
  std::ranges::move(frames_for(subject, 8), std::back_inserter(frames));
  for (const grid::Kind kind : subject.method->descriptor.kinds)
    if (std::ranges::none_of(frames, [&](const SubjectFrame& frame) { return frame.grid.kind() == kind; }))
      findings.skipped = std::string("no setting was found on a grid of kind ") + grid::kind_name(kind);
  for (const SubjectFrame& frame : frames) compare_with_truth(subject, frame, lists_of(subject, frame), findings);
  findings.detail = frames_text(frames.size());
}

void list_no_lights(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 4);
  for (const SubjectFrame& frame : frames) {
    const SubjectFrame dark = with_lights(frame, [](std::size_t) { return false; });
    if (const assign::Lists lists = lists_of(subject, dark); lists.pair_count() > 0)
      findings.fault(frame.label + ": lists " + std::to_string(lists.pair_count()) + " pairs of no lights");
  }
  findings.detail = frames_text(frames.size());
}

void list_one_light(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 4);
  std::size_t count = 0;
  for (const SubjectFrame& frame : frames)
    for (std::size_t light = 0; light < frame.frame.lights.size() && light < 8; ++light, ++count) {
      const SubjectFrame one = with_lights(frame, [&](std::size_t i) { return i == light; });
      compare_with_truth(subject, one, lists_of(subject, one), findings);
    }
  findings.detail = frames_text(count);
}

// Moves each light to a place behind the eye, or makes its range 0 or endless.
void list_odd_lights(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 4);
  for (const SubjectFrame& frame : frames)
    for (const double range : {0.0, std::numeric_limits<double>::infinity(), 1e-30}) {
      SubjectFrame odd = with_lights(frame, [](std::size_t i) { return i < 16; });
      for (scene::WorldLight& light : odd.frame.lights)
        if (light.type != scene::LightType::box) light.range_m = range;
      odd.lights = view::lights_in(odd.frame, grid::space_of(odd.grid, odd.frame));
      odd.label += ", ranges of " + std::to_string(range);
      compare_with_truth(subject, odd, lists_of(subject, odd), findings);
    }
  findings.detail = frames_text(3 * frames.size());
}

// Each frame again on the same instance, after another frame, and on a new instance.
void list_the_same(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 4);
  const stress::StressMethod method = subject.with_defaults();
  for (const SubjectFrame& frame : frames) {
    const SubjectFrame half = with_lights(frame, [](std::size_t i) { return i % 2 == 0; });
    assign::AssignerRun run = method.start();
    run.build(frame.grid, frame.kinds());
    run.assign(frame.input());
    const assign::Lists first = run.cell_lists();
    run.assign(frame.input());
    if (run.cell_lists() != first) findings.fault(frame.label + ": the same frame again gives other lists");
    run.assign(half.input());
    run.assign(frame.input());
    if (run.cell_lists() != first) findings.fault(frame.label + ": the lists depend on the frame before");
    if (lists_of(subject, frame) != first) findings.fault(frame.label + ": a new instance gives other lists");
  }
  findings.detail = frames_text(frames.size());
}

void follow_grids(const Subject& subject, Findings& findings) {
  const std::vector<SubjectFrame> frames = frames_for(subject, 8);
  assign::AssignerRun run = subject.with_defaults().start();
  for (int round = 0; round < 2; ++round)
    for (const SubjectFrame& frame : frames) {
      run.build(frame.grid, frame.kinds());
      run.build(frame.grid, frame.kinds());
      run.assign(frame.input());
      if (run.cell_lists() != lists_of(subject, frame))
        findings.fault(frame.label + ": the lists depend on the grids that were built before");
    }
  findings.detail = std::to_string(4 * frames.size()) + " builds";
}

}  // namespace

std::vector<AcceptanceTest> list_tests() {
  return {
      {"grids", "fills lists on every kind of grid that it names, and keeps its promises there", false,
       list_every_kind},
      {"no-lights", "leaves empty lists where there are no lights", false, list_no_lights},
      {"one-light", "keeps its promises for each light alone", false, list_one_light},
      {"odd-lights", "takes lights without range, with a tiny and with an endless one", false, list_odd_lights},
      {"determinism", "gives the same lists for the same frame", false, list_the_same},
      {"builds", "follows grids that change, and may be built twice", false, follow_grids},
  };
}

}  // namespace clusterbench::acceptance
