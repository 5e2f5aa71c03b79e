#pragma once
// The columns that spots touch in each row of some slices, all slices at once so that vectors are full: rows and ends
// that are guessed and proven (spot_rows.h), which nearly all are. Of what is left, ends that are touched in a single
// point come first (nearest_points.h), as most are on lattices. The rest is shortened by halves, quarters and so on
// that are as a whole not touched, and to what the spots' balls have; then its ends are looked at a few cells at a
// time, until a cell at either end is touched.

#include <optional>

#include "assign/cone/spot_rows.h"
#include "assign/exact/exact_frame.h"
#include "assign/exact/exact_rows.h"
#include "assign/exact/nearest_points.h"

namespace clusterbench::assign {

class SpotSpans {
 public:
  // Those of slices first .. last - 1.
  void find(const ExactFrame& frame, int first, int last);
  // Adds a slice's spans; slices in ascending order.
  void add_to(int slice, ListBuilder& spans);

  std::uint64_t tests() const { return tests_; }
  std::uint64_t fallbacks() const { return fallbacks_; }
  std::size_t capacity_bytes() const;

 private:
  // A row that is not settled: its columns as far as they are known; those that are not touched go from both ends.
  struct Span {
    std::uint32_t row;  // in rows_
    grid::IndexRange columns;
    bool left_is_uncertain, right_is_uncertain;  // the end may yet not be touched
    bool is_narrowed;                            // by narrow()

    bool is_uncertain() const { return !columns.empty() && (left_is_uncertain || right_is_uncertain); }
  };
  // An end of a span that is to be shortened, and how many columns there are looked at as one.
  struct Long {
    std::uint32_t span;
    int columns;
    bool from_left;
  };
  static constexpr int k_least_columns = 3;
  // A run of cells of a span that may just be touched: its row, what is before or behind the columns guessed, the first
  // or the last of these.
  enum class Part : std::uint8_t { whole, before, first, behind, last };
  struct Run {
    std::uint32_t span;
    Part part;
  };
  // Cells at one or both ends of a span that are asked for, from cells_[first_cell] on.
  struct Ends {
    std::uint32_t span, first_cell;
    grid::IndexRange columns;
    bool from_left, from_right;
  };

  void settle_uncertain_rows();
  void take_uncertain_rows();
  void settle_touches();
  void ask_for_touches(std::uint32_t i);
  void take_touch(const Run& run, std::uint32_t index);
  void shorten();
  void narrow();
  bool is_missed(const Span& span, const grid::IndexRange& columns);
  bool is_to_be_narrowed(const Span& span) const;
  template <class IsWanted>
  bool ask_for_ends(int at_once, IsWanted&& is_wanted);
  void settle_ends(bool to_be_decided);
  SpotCell cells_of(const Span& span, const grid::IndexRange& columns) const;
  void ask(std::uint32_t i, const grid::IndexRange& columns, bool from_left, bool from_right);
  void settle(const Ends& ends, bool to_be_decided);
  bool decide(std::uint32_t row, int column);
  bool is_plain(std::uint32_t light) const;
  bool vectors_tell(std::uint32_t light, const geom::FrustumCell& cell) const;
  std::uint32_t light_of(const Span& span) const;
  const SpotBalls& balls_of(std::uint32_t light);
  Row row_at(std::uint32_t row) const;

  const ExactFrame* frame_ = nullptr;
  SpotSlices slices_;
  SpotRows rows_;               // slice by slice
  std::uint32_t next_row_ = 0;  // to be added
  std::vector<Span> spans_;
  std::vector<Run> runs_;
  SpotTouches touches_;                   // of these
  std::vector<std::uint32_t> uncertain_;  // among them
  std::vector<Long> long_;
  std::vector<Ends> ends_;
  SpotCells cells_;                 // of all ends
  std::optional<SpotJudge> judge_;  // of the spot that was asked for last
  std::optional<SpotBalls> balls_;  // the same
  std::uint64_t tests_ = 0, fallbacks_ = 0;
};

}  // namespace clusterbench::assign
