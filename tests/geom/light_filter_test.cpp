// The filter in double precision against exact decisions: over 200,000 pairs, some at random and some where its
// answer changes, which is where rounding could make it say too much.

#include <gtest/gtest.h>

#include <cmath>

#include "effort.h"
#include "geom/filter/light_filter.h"
#include "geom/light_meets_cell.h"
#include "geom/map_pairs.h"
#include "geom/random_pairs.h"
#include "geom/shapes/verdict.h"

namespace clusterbench::geom {
namespace {

struct Kind {
  const char* name;
  bool is_cone;
  Cell (*make_cell)(SplitMix64&);
};

template <class AnyCell, AnyCell (*make)(SplitMix64&)>
Cell cell_of(SplitMix64& random) {
  return make(random);
}

class FilterOn : public testing::TestWithParam<Kind> {};

void expect_agreement(const LightVolume& light, const Cell& cell, int (&said)[3]) {
  const Verdict filtered = filter_meets(light, cell);
  ++said[static_cast<int>(filtered)];
  if (filtered == Verdict::uncertain) return;
  EXPECT_EQ(prove_meets(light, cell), filtered) << "range " << range_of(light);
}

TEST_P(FilterOn, random_pairs_is_never_contradicted) {
  SplitMix64 random(101);
  int said[3] = {};
  const int pairs = test::tries(25000);
  for (int i = 0; i < pairs; ++i) {
    const LightVolume light = random_light(random, GetParam().is_cone);
    expect_agreement(light, GetParam().make_cell(random), said);
  }
  EXPECT_GT(1000 * said[static_cast<int>(Verdict::yes)], 12 * pairs);
  EXPECT_GT(1000 * said[static_cast<int>(Verdict::no)], 12 * pairs);
  EXPECT_LT(said[static_cast<int>(Verdict::uncertain)], 3);
}

// Neighbouring ranges between which the filter's answer begins to be at least `wanted` (no < uncertain < yes).
double range_of_change(const LightVolume& light, const Cell& cell, Verdict wanted) {
  const auto rank = [](Verdict verdict) { return verdict == Verdict::no ? 0 : verdict == Verdict::uncertain ? 1 : 2; };
  double before = 0.0, after = 200.0;
  for (;;) {
    const double range = 0.5 * (before + after);
    if (range <= before || range >= after) return after;
    (rank(filter_meets(with_range(light, range), cell)) < rank(wanted) ? before : after) = range;
  }
}

TEST_P(FilterOn, pairs_at_which_it_changes_its_mind_is_never_contradicted) {
  SplitMix64 random(103);
  int said[3] = {}, pairs = 0;
  while (pairs < test::tries(17000)) {
    const LightVolume light = random_light(random, GetParam().is_cone);
    const Cell cell = GetParam().make_cell(random);
    for (const Verdict wanted : {Verdict::uncertain, Verdict::yes}) {
      const double change = range_of_change(light, cell, wanted);
      if (change >= 200.0) continue;  // the cone does not meet the cell
      for (const int ulps : {-64, -8, -1, 0, 1, 8, 64}) {
        const double nudged = change + ulps * (std::nextafter(change, 1e9) - change);
        expect_agreement(with_range(light, nudged), cell, said);
        ++pairs;
      }
    }
  }
  EXPECT_GT(said[static_cast<int>(Verdict::yes)], pairs / 4);
  EXPECT_GT(said[static_cast<int>(Verdict::no)], pairs / 5);
  EXPECT_GT(said[static_cast<int>(Verdict::uncertain)], pairs / 4);
}

struct MapKind {
  const char* name;
  bool is_shell, is_cone;
};

class FilterOnMaps : public testing::TestWithParam<MapKind> {};

// Once 0.6 % of the answers for spots and shell cells were wrong here.
TEST_P(FilterOnMaps, lights_that_a_cell_touches_or_misses_are_never_contradicted) {
  SplitMix64 random(107);
  int said[3] = {};
  const int pairs = test::tries(20000);
  for (int i = 0; i < pairs; ++i) {
    const MapPair pair = map_pair(GetParam().is_shell, GetParam().is_cone, random);
    expect_agreement(pair.light, pair.cell, said);
  }
  EXPECT_GT(5 * said[static_cast<int>(Verdict::yes)], pairs);
  EXPECT_GT(5 * said[static_cast<int>(Verdict::no)], pairs);
  EXPECT_LT(5 * said[static_cast<int>(Verdict::uncertain)], 3 * pairs);
}

INSTANTIATE_TEST_SUITE_P(Lights, FilterOnMaps,
                         testing::Values(MapKind{"spots_and_frustum_pieces", false, true},
                                         MapKind{"spots_and_shell_pieces", true, true},
                                         MapKind{"balls_and_frustum_pieces", false, false},
                                         MapKind{"balls_and_shell_pieces", true, false}),
                         [](const testing::TestParamInfo<MapKind>& each) { return each.param.name; });

INSTANTIATE_TEST_SUITE_P(All, FilterOn,
                         testing::Values(Kind{"balls_and_frustum_pieces", false, cell_of<FrustumCell, random_piece>},
                                         Kind{"balls_and_shell_pieces", false, cell_of<ShellCell, random_shell>},
                                         Kind{"balls_and_boxes", false, cell_of<Box, random_box>},
                                         Kind{"spots_and_frustum_pieces", true, cell_of<FrustumCell, random_piece>},
                                         Kind{"spots_and_shell_pieces", true, cell_of<ShellCell, random_shell>},
                                         Kind{"spots_and_boxes", true, cell_of<Box, random_box>}),
                         [](const testing::TestParamInfo<Kind>& each) { return each.param.name; });

}  // namespace
}  // namespace clusterbench::geom
