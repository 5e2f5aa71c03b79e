// One decision whether a ball meets a cell, by geom::BallDecider: anywhere (doubles tell), within an ulp of touching,
// the camera turned (whole numbers must tell), and exact touches on a lattice. `exact`: the share that doubles leave
// uncertain; `worst_ns`: the longest of all decisions, each the shortest of several tries.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "benchmarks.h"
#include "core/random.h"
#include "geom/ball/ball_decider.h"

namespace clusterbench {
namespace {

struct Question {
  geom::Placement center;
  double radius;
  geom::Cell cell;
};

constexpr int k_questions = 2000;

geom::Cell cell_of(const std::string& kind, const geom::FrustumCell& frustum) {
  if (kind == "shell")
    return geom::ShellCell{frustum.x0, frustum.x1, frustum.y0, frustum.y1, frustum.depth0, frustum.depth1};
  if (kind == "box")
    return geom::Box{{8.0f * frustum.x0, 8.0f * frustum.y0, -frustum.depth1},
                     {8.0f * frustum.x1, 8.0f * frustum.y1, -frustum.depth0}};
  return frustum;
}

bool meets(const Question& question) {
  return geom::BallDecider(question.center, question.radius).meets(question.cell);
}

// The least radius that meets the cell, or the double below it.
double nearly_touching(Question question, bool below) {
  double misses = 0.0, touches = 1e4;
  for (;;) {
    question.radius = (misses + touches) / 2.0;
    if (question.radius == misses || question.radius == touches) return below ? misses : touches;
    (meets(question) ? touches : misses) = question.radius;
  }
}

std::vector<Question> random_questions(const std::string& kind, bool nudged) {
  SplitMix64 random(7);
  std::vector<Question> questions;
  const auto f = [&](double lo, double hi) { return static_cast<float>(random.between(lo, hi)); };
  for (int i = 0; i < k_questions; ++i) {
    geom::FrustumCell frustum{f(-1, 0.8), 0.0f, f(-1, 0.8), 0.0f, f(0.1, 50), 0.0f, false};
    frustum.x1 = frustum.x0 + f(0.01, 0.3);
    frustum.y1 = frustum.y0 + f(0.01, 0.3);
    frustum.depth1 = frustum.depth0 + f(0.1, 10);
    Question question{{}, random.between(0.5, 20), cell_of(kind, frustum)};
    question.center.position = {random.between(-20, 20), random.between(-20, 20), random.between(-60, 5)};
    const double turn = random.between(0, 6);
    question.center.rotation[0][0] = question.center.rotation[2][2] = std::cos(turn);
    question.center.rotation[2][0] = std::sin(turn);
    question.center.rotation[0][2] = -std::sin(turn);
    if (nudged) question.radius = nearly_touching(question, i % 2 == 0);
    questions.push_back(question);
  }
  return questions;
}

// Each touches the middle plane, or the near plane, of a cell beside the view axis.
std::vector<Question> lattice_questions(const std::string& kind) {
  std::vector<Question> questions;
  for (int i = 0; i < k_questions; ++i) {
    const auto near = static_cast<float>(1 + i % 7);
    const geom::FrustumCell frustum{0.0f, 0.25f, -0.25f, 0.0f, near, near + 4.0f, false};
    const double radius = 1 + i % 5;
    Question question{{}, radius, cell_of(kind, frustum)};
    question.center.position =
        i % 2 == 0 ? Vec3d(-radius, -0.125 * (near + 2.0), -(near + 2.0)) : Vec3d(0.0, 0.0, radius - near);
    questions.push_back(question);
  }
  return questions;
}

double worst_ns(const std::vector<Question>& questions) {
  double worst = 0.0;
  for (const Question& question : questions) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 5; ++i) {
      const auto before = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(meets(question));
      const auto after = std::chrono::steady_clock::now();
      best = std::min(best, std::chrono::duration<double, std::nano>(after - before).count());
    }
    worst = std::max(worst, best);
  }
  return worst;
}

void decide(benchmark::State& state, const std::vector<Question>& questions) {
  std::uint64_t exact = 0;
  for (const Question& question : questions) {
    const geom::BallDecider decider(question.center, question.radius);
    benchmark::DoNotOptimize(decider.meets(question.cell));
    exact += decider.exact_decisions();
  }
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(meets(questions[i]));
    i = i + 1 == questions.size() ? 0 : i + 1;
  }
  state.counters["exact"] = static_cast<double>(exact) / static_cast<double>(questions.size());
  state.counters["worst_ns"] = worst_ns(questions);
}

}  // namespace

void register_decisions() {
  for (const std::string kind : {"frustum", "box", "shell"}) {
    const auto add = [&](const std::string& what, std::vector<Question> questions) {
      benchmark::RegisterBenchmark(
          ("decide/ball/" + kind + "/" + what).c_str(),
          [questions = std::move(questions)](benchmark::State& state) { decide(state, questions); });
    };
    add("anywhere", random_questions(kind, false));
    add("nudged", random_questions(kind, true));
    add("lattice", lattice_questions(kind));
  }
}

}  // namespace clusterbench
