#pragma once
// Runs the spot cascade (cone/spot_rows.h): the columns that spots touch in each row of some slices, for all slices at
// once, so that vectors are full.
//    1. bounds: find_spot_rows(), rows and columns with proofs; this decides nearly all rows.
//    2. filter: filter_contacts(), ends that touch in a single point (exact/nearest_points.h), as most uncertain ends
//               on lattices do; then filter_halves(), which tests half of a span as one cell, then a quarter, and so
//               on.
//    3. refine: refine_long_spans(), bounding balls, and the cone against balls, for long spans of which the filter
//               cannot reject cells.
//    4. exact:  test_end_cells(true), the cells at each end, a few at a time, until one is touched: filtered first, and
//               decided exactly if they are still uncertain.

#include <optional>

#include "assign/cone/spot_rows.h"
#include "assign/exact/exact_frame.h"
#include "assign/exact/exact_rows.h"
#include "assign/exact/nearest_points.h"

namespace clusterbench::assign {

class SpotSpans {
 public:
  // Finds the columns in slices first .. last - 1.
  void find(const ExactFrame& frame, int first, int last);
  // Adds a slice's spans; slices in ascending order.
  void add_to(int slice, ListBuilder& spans);

  std::uint64_t tests() const { return tests_; }
  std::uint64_t fallbacks() const { return fallbacks_; }
  std::size_t capacity_bytes() const;

 private:
  // A row that is not decided yet: the columns that may be touched. Untouched columns are removed from both ends.
  struct Span {
    std::uint32_t row;  // in rows_
    grid::IndexRange columns;
    bool left_is_uncertain, right_is_uncertain;  // the column at that end may be untouched
    bool is_refined;                             // refine_long_spans() applies to it

    bool is_uncertain() const { return !columns.empty() && (left_is_uncertain || right_is_uncertain); }
  };
  // An end of a span, and the number of columns there that filter_halves() tests as one cell.
  struct HalvedEnd {
    std::uint32_t span;
    int columns;
    bool from_left;
  };
  static constexpr int k_least_columns = 3;
  // The cells of a span that are tested for a single common point: the whole row, the columns before or after the
  // guessed ones, or the first or last guessed column.
  enum class Part : std::uint8_t { whole, before, first, after, last };
  struct ContactRun {
    std::uint32_t span;
    Part part;
  };
  // Cells at one or both ends of a span, in cells_ from first_cell on.
  struct EndCells {
    std::uint32_t span, first_cell;
    grid::IndexRange columns;
    bool from_left, from_right;
  };

  void decide_uncertain_rows();
  void collect_uncertain_spans();
  void filter_contacts();
  void add_contact_tests(std::uint32_t i);
  void apply_contact(const ContactRun& run, std::uint32_t index);
  void filter_halves();
  void refine_long_spans();
  bool cone_misses(const Span& span, const grid::IndexRange& columns);
  bool needs_refinement(const Span& span) const;
  template <class IsSelected>
  bool collect_end_cells(int at_once, IsSelected&& is_selected);
  void test_end_cells(bool is_exact);
  SpotCell cells_of(const Span& span, const grid::IndexRange& columns) const;
  void add_end_cells(std::uint32_t i, const grid::IndexRange& columns, bool from_left, bool from_right);
  void shorten(const EndCells& ends, bool is_exact);
  bool decide_exactly(std::uint32_t row, int column);
  bool is_in_filter_range(std::uint32_t light) const;
  bool simd_filter_can_reject(std::uint32_t light, const geom::FrustumCell& cell) const;
  std::uint32_t light_of(const Span& span) const;
  const SpotBalls& balls_of(std::uint32_t light);
  Row row_at(std::uint32_t row) const;

  const ExactFrame* frame_ = nullptr;
  SpotSlices slices_;
  SpotRows rows_;               // slice by slice
  std::uint32_t next_row_ = 0;  // the next row that add_to() adds
  std::vector<Span> spans_;
  std::vector<ContactRun> contact_runs_;
  SpotContacts contacts_;                 // the tests of contact_runs_
  std::vector<std::uint32_t> uncertain_;  // indices in spans_
  std::vector<HalvedEnd> halved_ends_;
  std::vector<EndCells> end_cells_;
  SpotCells cells_;                        // the cells of end_cells_ or halved_ends_
  std::optional<SpotCellTest> cell_test_;  // of the spot that was tested last
  std::optional<SpotBalls> balls_;         // of the spot that was used last
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
