// Budgets and gates on random levels, of which the test itself counts all figures: a job is green where it should be,
// and never where lights that shone are gone.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <tuple>

#include "core/random.h"
#include "report/gates/baseline_cases.h"
#include "report/gates/light_gate.h"
#include "report/gates/limits.h"
#include "report/results/result_record.h"
#include "run/walk.h"

namespace clusterbench::report {
namespace {

using result::Result;

// The camera looks along -z in the first frame and along +z in the second; what stands aside is in neither.
enum class Place : std::uint8_t { ahead, behind, aside };
enum class Shine : std::uint8_t { lit, without_intensity, black, hidden };  // what is hidden has no range

struct Lamp {
  int number = 0;  // none has the position of another
  Place place = Place::ahead;
  Shine shine = Shine::lit;

  bool is_in_view() const { return place != Place::aside && shine != Shine::hidden; }
  bool is_dark() const { return shine != Shine::lit; }
  // What the digest of lights tells apart.
  auto key() const { return std::tuple(number, place, shine == Shine::lit ? 0 : shine == Shine::hidden ? 1 : 2); }
};
using Lamps = std::vector<Lamp>;

// One cell holds all that a frame sees, so the longest list and the entries are the lights in view.
struct Figures {
  std::int64_t lights = 0, lit = 0, seen = 0, in_view = 0;

  std::int64_t of(const std::string& name) const {
    return name == "lights" ? lights : name == "lights_lit" ? lit : name == "lights_seen" ? seen : in_view;
  }
  bool has_nothing_to_see() const { return seen == 0; }
};
constexpr const char* k_names[] = {"lights", "lights_lit", "lights_seen", "lights_in_view", "longest", "index_entries"};

Figures counted(const Lamps& lamps) {
  const auto count = [&](auto&& is_meant) { return std::int64_t{std::ranges::count_if(lamps, is_meant)}; };
  const auto in_frame = [&](Place place) {
    return count([&](const Lamp& lamp) { return lamp.is_in_view() && lamp.place == place; });
  };
  return {static_cast<std::int64_t>(lamps.size()), count([](const Lamp& lamp) { return !lamp.is_dark(); }),
          count([](const Lamp& lamp) { return !lamp.is_dark() && lamp.is_in_view(); }),
          std::max(in_frame(Place::ahead), in_frame(Place::behind))};
}

Result measured(const Lamps& lamps) {
  run::testing::Walk walk(R"("grids": [{"kind": "frustum", "tiles": {"count": [1, 1]},
      "slices": {"scheme": "list", "boundaries": [0.5, 64]}}], "assigners": ["brute-force"],
      "shading": {"samples": 0}, "accuracy": {"check": false})",
                          2);
  std::vector<scene::Shot>& shots = walk.plan.scenes[0].paths[0].shots;
  for (scene::Shot& shot : shots) shot.pose.eye = Vec3d(0.0);
  shots[1].pose.view_from_world = Mat3d(Vec3d(-1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, -1));
  for (const Lamp& lamp : lamps) {
    const double along_m = 5.0 + lamp.number;
    const Vec3d where = lamp.place == Place::ahead    ? Vec3d(0, 0, -along_m)
                        : lamp.place == Place::behind ? Vec3d(0, 0, along_m)
                                                      : Vec3d(1000, 0, along_m);
    scene::Light& light = walk.add_light(where, 3.0);
    if (lamp.shine == Shine::without_intensity) light.intensity = 0.0;
    if (lamp.shine == Shine::black) light.color = Vec3d(0.0);
    if (lamp.shine == Shine::hidden) walk.plan.scenes[0].scene.nodes.back().visible = false;
  }
  return record_of(walk.run(), {});
}

class RandomLevels {
 public:
  explicit RandomLevels(std::uint64_t seed) : random_(seed) {}

  Lamps level() {
    Lamps lamps;
    for (std::uint64_t i = 0, count = random_.below(13); i < count; ++i) lamps.push_back(lamp());
    if (random_.below(4) == 0)
      for (Lamp& dark : lamps) dark.shine = Shine::black;
    return lamps;
  }

  // A level after a change: some lamps less, more, moved or switched.
  Lamps changed(Lamps lamps) {
    for (std::uint64_t edits = random_.below(4); edits > 0; --edits) {
      if (lamps.empty() || random_.below(4) == 0) {
        lamps.push_back(lamp());
        continue;
      }
      const auto at = lamps.begin() + static_cast<std::ptrdiff_t>(random_.below(lamps.size()));
      const std::uint64_t way = random_.below(3);
      if (way == 0) lamps.erase(at);
      if (way == 1) at->place = place();
      if (way == 2) at->shine = shine();
    }
    return lamps;
  }

 private:
  Place place() { return static_cast<Place>(random_.below(3)); }
  Shine shine() { return random_.below(2) == 0 ? Shine::lit : static_cast<Shine>(random_.below(4)); }
  Lamp lamp() { return {next_++ % 40, place(), shine()}; }

  SplitMix64 random_;
  int next_ = 0;
};

// -1, 0 or 1: where a figure is beside each of a budget's numbers.
struct Budget {
  std::string text;
  std::function<bool(int, int)> is_broken;  // by where it is beside the first and the second number
};
std::vector<Budget> budgets(const std::string& figure, const std::string& low, const std::string& high) {
  const auto compared = [&](const char* sign) { return figure + " " + sign + " " + low; };
  return {{compared(">"), [](int at, int) { return at > 0; }},
          {compared(">="), [](int at, int) { return at >= 0; }},
          {compared("<"), [](int at, int) { return at < 0; }},
          {compared("<="), [](int at, int) { return at <= 0; }},
          {compared("=="), [](int at, int) { return at == 0; }},
          {"eye/grid/0-0-0: " + compared(">"), [](int at, int) { return at > 0; }},
          {figure + " " + low + ".." + high, [](int at, int at_high) { return at < 0 || at_high > 0; }}};
}

int sign_of(std::int64_t value) {
  return value < 0 ? -1 : value > 0 ? 1 : 0;
}

bool is_kept(const Result& result, const std::string& budget, const BaselineCases* baseline = nullptr) {
  const config::LimitRule rules[] = {config::limit_rule(budget, "", "--fail-if")};
  const LimitFindings findings = limit_findings(result, rules, baseline);
  EXPECT_EQ(findings.checked, 1u) << budget;
  return findings.broken.empty();
}

TEST(RandomGates, budgets_break_exactly_where_figures_that_were_counted_by_hand_are) {
  RandomLevels levels(1);
  for (int tries = 0; tries < 60; ++tries) {
    const Lamps lamps = levels.level();
    const Result result = measured(lamps);
    for (const char* name : k_names) {
      const std::int64_t value = counted(lamps).of(name);
      for (const std::int64_t low : {value - 1, value, value + 1})
        for (const Budget& budget : budgets(name, std::to_string(low), std::to_string(low + 1)))
          EXPECT_EQ(!is_kept(result, budget.text), budget.is_broken(sign_of(value - low), sign_of(value - low - 1)))
              << budget.text << ", and it is " << value;
    }
  }
}

// "-12.3 %"
std::string percent_text(std::int64_t tenths) {
  const std::int64_t size = std::abs(tenths);
  return (tenths < 0 ? "-" : "+") + std::to_string(size / 10) + "." + std::to_string(size % 10) + " %";
}

// Of the change beside so many tenths of a percent, in whole numbers.
int beside_percent(std::int64_t then, std::int64_t now, std::int64_t tenths) {
  return then == 0 && now == 0 ? sign_of(-tenths) : sign_of(1000 * (now - then) - tenths * then);
}

TEST(RandomGates, budgets_in_percent_break_exactly_where_changes_that_were_counted_by_hand_are) {
  RandomLevels levels(2);
  for (int tries = 0; tries < 60; ++tries) {
    const Lamps before = levels.level(), after = levels.changed(before);
    const Result base = measured(before), result = measured(after);
    const BaselineCases baseline(base, result, "", "base.json");
    for (const char* name : k_names) {
      const std::int64_t then = counted(before).of(name), now = counted(after).of(name);
      const std::int64_t at = then == 0 ? 0 : 1000 * (now - then) / then;
      for (const std::int64_t low : {at - 1, at, at + 1})
        for (const Budget& budget : budgets(name, percent_text(low), percent_text(low + 1)))
          EXPECT_EQ(!is_kept(result, budget.text, &baseline),
                    budget.is_broken(beside_percent(then, now, low), beside_percent(then, now, low + 1)))
              << budget.text << ", from " << then << " to " << now;
    }
  }
}

struct Verdict {
  bool is_green = false, is_green_without_allowance = false, is_green_of_no_lights = false;
};

// As `run --baseline base.json --allow-changed-lights --fail-if ...` judges, without that flag, and with
// --allow-no-lights, too.
Verdict verdict_of(const Result& base, const Result& result) {
  const BaselineCases baseline(base, result, "", "base.json");
  const bool holds =
      is_kept(result, "lights_lit < -0 %", &baseline) && is_kept(result, "lights_seen < -0 %", &baseline);
  const auto passes = [&](bool allows_changed, bool allows_none) {
    return light_findings(result, {allows_none, allows_changed, &base, "base.json"}).broken.empty();
  };
  return {holds && passes(true, false), passes(false, false), holds && passes(true, true)};
}

bool have_same_lights(const Lamps& a, const Lamps& b) {
  const auto keys = [](const Lamps& lamps) {
    std::vector<decltype(Lamp{}.key())> all;
    for (const Lamp& lamp : lamps) all.push_back(lamp.key());
    std::ranges::sort(all);
    return all;
  };
  return keys(a) == keys(b);
}

TEST(RandomGates, are_never_green_where_lights_that_shone_are_gone) {
  RandomLevels levels(3);
  int green = 0, red = 0;
  for (int tries = 0; tries < 300; ++tries) {
    const Lamps before = levels.level(), after = levels.changed(before);
    const Figures then = counted(before), now = counted(after);
    const Verdict verdict = verdict_of(measured(before), measured(after));
    const bool has_lost = now.lit < then.lit || now.seen < then.seen;
    EXPECT_EQ(verdict.is_green, !has_lost && !now.has_nothing_to_see());
    EXPECT_EQ(verdict.is_green_of_no_lights, !has_lost);
    EXPECT_EQ(verdict.is_green_without_allowance, have_same_lights(before, after) && !now.has_nothing_to_see());
    EXPECT_FALSE(has_lost && (verdict.is_green || verdict.is_green_without_allowance || verdict.is_green_of_no_lights));
    ++(verdict.is_green ? green : red);
  }
  EXPECT_GT(green, 50);
  EXPECT_GT(red, 50);
}

}  // namespace
}  // namespace clusterbench::report
