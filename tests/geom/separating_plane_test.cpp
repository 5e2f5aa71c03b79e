// Planes between spots and cells, as guessed.

#include "geom/search/separating_plane.h"

#include <gtest/gtest.h>

#include "geom/random_pairs.h"

namespace clusterbench::geom {
namespace {

TEST(Separator, guesses_the_widest_tangent_of_nearly_all_cells_beside_cones) {
  SplitMix64 random(17);
  int apart = 0, widest = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto volume = volume_of<double>(random_spot(random));
    const auto cell = polytope_of<double>(random_piece(random));
    Separator<double> likely(volume, cell), all(volume, cell);
    likely.try_likely_tangents();
    all.try_tangents();
    EXPECT_LE(likely.best().gap, all.best().gap + 1e-12);
    if (all.best().gap < 1e-9) continue;
    ++apart;
    if (likely.best().gap > all.best().gap - 1e-12) ++widest;
  }
  EXPECT_GT(apart, 5000);
  EXPECT_GT(100 * widest, 97 * apart) << widest << " of " << apart;
}

}  // namespace
}  // namespace clusterbench::geom
