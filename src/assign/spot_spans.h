#pragma once
// The columns that spots touch in each row of some slices: the rows of their bounding balls, shortened. First to ends
// that are guessed and proven, which nearly all are. What is left is shortened by halves, quarters and so on that are
// as a whole not touched; then its ends are looked at a few cells at a time, until a cell at either end is touched.
// Those of all slices go together. In orthographic grids cell by cell.

#include "assign/exact_frame.h"
#include "assign/exact_rows.h"
#include "assign/simd/spot_rows.h"

namespace clusterbench::assign {

class SpotSpans {
 public:
  // Those of slices first .. last - 1.
  void find(const ExactFrame& frame, int first, int last);
  // Adds a slice's spans; slices in ascending order.
  void add_to(int slice, SpanLists& spans);

  std::uint64_t tests() const { return tests_; }
  std::uint64_t fallbacks() const { return fallbacks_; }
  std::size_t capacity_bytes() const;

 private:
  // A spot's columns in a row, as far as they are known: those that are not touched go from both ends.
  struct Lit {
    std::uint32_t light;
    int slice, row;
    grid::IndexRange columns;
    bool left_is_open, right_is_open;  // the end may yet not be touched

    bool is_open() const { return !columns.empty() && (left_is_open || right_is_open); }
  };
  // An end of a Lit that is to be shortened, and how many columns there are looked at as one.
  struct Long {
    std::uint32_t lit;
    int columns;
    bool from_left;
  };
  static constexpr int k_least_piece = 3;
  // Cells at one or both ends of a Lit that are asked for, from cells_[place] on.
  struct Ends {
    std::uint32_t lit, place;
    grid::IndexRange columns;
    bool from_left, from_right;
  };

  void add_rows(int slice);  // to cells_
  void decide_ends();        // in orthographic grids, whose cells no look knows
  void drop_missed_rows(const SpotsAndPlanes& from);
  Lit lit_of(const SpotCell& row) const;
  void guess(const SpotsAndPlanes& from);
  void shorten(const SpotsAndPlanes& from);
  bool ask_for_ends();
  void add_cell(const Lit& lit, const grid::IndexRange& columns);  // to cells_
  void ask(std::uint32_t i, const grid::IndexRange& columns, bool from_left, bool from_right);
  void ask_more_closely();
  void add_closer(std::uint32_t place);
  void settle(const Ends& ends);
  bool decide(const Lit& lit, int column);

  const ExactFrame* frame_ = nullptr;
  RowBatches rows_;
  std::vector<Lit> lit_;             // slice by slice
  std::size_t next_lit_ = 0;         // to be added
  std::vector<std::uint32_t> open_;  // among them
  std::vector<Long> long_;
  std::vector<Ends> ends_;
  std::vector<std::uint32_t> waiting_;  // those of them that may have cells without an answer
  SpotRowEnds guesses_;
  SpotCells cells_, closer_;  // of all ends; those of them to look at closely
  std::vector<std::uint32_t> closer_places_;
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
