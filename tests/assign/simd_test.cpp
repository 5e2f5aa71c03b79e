// Fast twins give the same lists on every instruction set that this machine has.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <set>

#include "assign/settings.h"
#include "assign/simd/span_lists.h"
#include "core/random.h"

namespace clusterbench::assign {
namespace {

using testing::Setting;

// Calls check(name) once per instruction set, the scalar one included.
template <class Check>
void on_each_target(Check&& check) {
  const std::int64_t all = hwy::SupportedTargets();
  std::set<std::string> tried;
  for (std::int64_t left = all; left != 0; left &= left - 1) {
    hwy::SetSupportedTargetsForTest(left & -left);
    hwy::GetChosenTarget().DeInit();
    const std::string name = simd_target_name();
    if (tried.insert(name).second) check(name);  // one that is not compiled in falls back to another
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  std::string names;
  for (const std::string& name : tried) names += name + " ";
  ::testing::Test::RecordProperty("targets", names);
  EXPECT_TRUE(tried.contains("SCALAR") || tried.size() > 1) << names;
}

struct RandomSpans {
  std::uint32_t rows, columns;
  struct Span {
    std::uint32_t row, first, last, light;
  };
  std::vector<Span> spans;
};

RandomSpans random_spans(std::uint32_t rows, std::uint32_t columns, std::uint32_t lights, std::uint64_t seed) {
  SplitMix64 random(seed);
  RandomSpans out{rows, columns, {}};
  for (std::uint32_t light = 0; light < lights; ++light)
    for (std::uint32_t row = 0; row < rows; ++row) {
      if (random.below(3) != 0) continue;
      const auto a = static_cast<std::uint32_t>(random.below(columns)),
                 b = static_cast<std::uint32_t>(random.below(columns));
      out.spans.push_back({row, std::min(a, b), std::max(a, b), light});
    }
  return out;
}

Lists by_scattering(const RandomSpans& spans) {
  PairBuffer pairs;
  Lists lists;
  pairs.start(spans.rows * spans.columns);
  for (const auto& s : spans.spans) pairs.add_row(s.row * spans.columns + s.first, s.last - s.first + 1, s.light);
  pairs.finish(lists);
  return lists;
}

// In bands of this many rows.
Lists by_compression(const RandomSpans& spans, std::uint32_t band_rows, SpanLists& compressed) {
  Lists lists;
  const std::uint32_t bands = spans.rows / band_rows;
  compressed.start(bands, band_rows, spans.columns, lists);
  for (std::uint32_t band = 0; band < bands; ++band) {
    for (const auto& s : spans.spans)
      if (s.row / band_rows == band) compressed.add(s.row % band_rows, s.first, s.last, s.light);
    compressed.finish_band();
  }
  compressed.finish();
  return lists;
}

TEST(SpanLists, are_those_of_a_pair_buffer_on_every_target) {
  on_each_target([](const std::string& target) {
    SpanLists compressed;
    for (const auto& [band_rows, rows, columns, lights] : {std::array<std::uint32_t, 4>{1, 1, 1, 1},
                                                           {1, 3, 7, 0},
                                                           {5, 5, 30, 17},
                                                           {8, 40, 12, 64},
                                                           {1, 2, 300, 65},
                                                           {17, 17, 1, 200},
                                                           {4, 12, 130, 5}})
      for (const std::uint64_t seed : {1u, 2u}) {
        const RandomSpans spans = random_spans(rows, columns, lights, seed);
        EXPECT_EQ(by_compression(spans, band_rows, compressed), by_scattering(spans))
            << target << ", " << rows << " x " << columns << ", " << lights;
      }
  });
}

Lists lists_of(const std::string& name, const Setting& setting, const std::map<std::string, ParamValue>& params = {}) {
  const AssignerRow& row = *find_assigner(name);
  const auto assigner = row.make(Params(row.params, params));
  assigner->build(setting.grid);
  Lists lists;
  assigner->assign(view::lights_in(setting.frame, grid::space_of(setting.grid, setting.frame)), lists);
  return lists;
}

// Lights of all sizes, and lights that touch cells by a hair.
TEST(ExactFast, gives_the_lists_of_exact_on_every_target) {
  for (const std::uint64_t seed : {5u, 6u})
    for (const Setting& setting : testing::settings_for(*find_assigner("exact-fast"), seed)) {
      const Lists expected = lists_of("exact", setting);
      EXPECT_GT(expected.pair_count(), 0U);
      on_each_target([&](const std::string& target) {
        EXPECT_EQ(lists_of("exact-fast", setting), expected) << target << ", " << setting.name;
      });
    }
}

// The same lights many times over, so that there is work for threads.
Setting repeated(Setting setting, int times) {
  const std::vector<scene::WorldLight> once = setting.frame.lights;
  const auto spots = once.begin() + setting.frame.points;
  setting.frame.lights.clear();
  for (int i = 0; i < times; ++i) setting.frame.lights.insert(setting.frame.lights.end(), once.begin(), spots);
  setting.frame.points = static_cast<std::uint32_t>(setting.frame.lights.size());
  for (int i = 0; i < times; ++i) setting.frame.lights.insert(setting.frame.lights.end(), spots, once.end());
  return setting;
}

TEST(ExactFast, gives_the_same_lists_on_any_number_of_threads) {
  const std::vector<Setting> settings = testing::settings_for(*find_assigner("exact-fast"), 7);
  for (std::size_t i = 0; i < settings.size(); i += 3) {
    const Setting setting = repeated(settings[i], 10);
    const Lists expected = lists_of("exact-fast", setting);
    EXPECT_GT(expected.pair_count(), 10000U) << setting.name;
    for (const double threads : {2.0, 5.0})
      EXPECT_EQ(lists_of("exact-fast", setting, {{"threads", threads}}), expected) << setting.name << ", " << threads;
  }
}

}  // namespace
}  // namespace clusterbench::assign
